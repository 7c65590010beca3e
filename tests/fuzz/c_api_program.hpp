// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <bch/bch.h>

#include "tests/fuzz/target.hpp"

namespace bch::fuzz {

constexpr std::uint32_t most = 8;             // agents, pairs, points, parts
constexpr std::uint32_t room = 3 * most + 1;  // of every array: corners of triangles, offsets
constexpr std::uint8_t untouched = 77;        // in the outputs

/// A caller of the C interface who does as the bytes of an input say, and knows what has to come of it.
class Program {
 public:
  Program(const std::uint8_t* data, std::size_t size) : bytes(data, size) {}
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  Bytes bytes;

  bool chance(std::uint32_t one_of) { return bytes.below(one_of) == one_of - 1; }

  /// Checks what a status and its message are, and what was to be looked at after the call; a fault of the library is one in any case.
  /// Returns: whether the call succeeded.
  bool finish(bch_status status) {
    require(status >= BCH_OK && status < BCH_INTERNAL, "no fault of the library");
    if (status != BCH_OK) {
      const std::string message = bch_last_error();
      require(!message.empty(), "errors have a message");
      require(message.find('\n') == std::string::npos, "messages are one line");
    }
    for (const auto& look : after_) look(status == BCH_OK);
    after_.clear(), memory_.clear(), lent_.clear();
    return status == BCH_OK;
  }
  /// What is looked at after the call, which succeeded or did not.
  void after(std::function<void(bool)> look) { after_.push_back(std::move(look)); }

  /// Memory until the end of the call.
  template <class Value>
  Value* fresh(std::size_t count = 1) {
    const auto values = std::make_shared<std::vector<Value>>(count);
    memory_.push_back(values);
    return values->data();
  }

  /// A handle: one of the last few that were handed out, which live or were freed; NULL; or what is no such object.
  template <class Object>
  Object* handle() {
    const std::uint32_t kind = bytes.below(64);
    if (kind == 62) return nullptr;
    if (kind == 63) return static_cast<Object*>(stranger());
    return objects<Object>().last[kind % 4];
  }

  /// Keeps a handle for later calls, in the place of one before.
  template <class Object>
  void keep(Object* object, bool lives) {
    objects<Object>().last[bytes.below(4)] = object;
    all_.push_back(object);
    if (lives) objects<Object>().living.insert(object);
  }

  /// Makes what an input begins with, which never fails and is every handle of its kind.
  template <class Object, class Make>
  Object* begin_with(Make call) {
    Object* object = nullptr;
    require(call(&object) == BCH_OK, "what inputs begin with is made");
    keep(object, true);
    objects<Object>().last.fill(object);
    return object;
  }

  /// Frees a handle, which works for living objects and NULL alone.
  template <class Object>
  void free(bch_status (*call)(Object*)) {
    Object* const object = handle<Object>();
    const bool living = objects<Object>().living.erase(object) > 0;
    require(finish(call(object)) == (living || object == nullptr), "what lives can be freed, once");
  }

  /// How many entries an array has: mostly all that there are, at times more than memory has.
  std::size_t count() {
    if (chance(128)) return std::numeric_limits<std::size_t>::max() - bytes.below(2);
    return chance(4) ? bytes.below(most + 1) : most;
  }

  /// A number about 0, or one that is odd.
  template <class Real>
  Real number() {
    using Limits = std::numeric_limits<Real>;
    constexpr Real odd[] = {Limits::quiet_NaN(), Limits::infinity(),   -Limits::infinity(), Limits::max(),
                            Limits::lowest(),    Limits::denorm_min(), Real(-0.0)};
    if (chance(256)) return odd[bytes.below(std::size(odd))];
    return static_cast<Real>(bytes.take<std::int8_t>()) * Real(0x1p-5);
  }

  /// A small number, or any.
  std::uint32_t index(std::uint32_t bound = 3) {
    return chance(256) ? bytes.take<std::uint32_t>() : bytes.below(bound);
  }

  /// Remembers an array that was lent, whose length comes later; reads those that wait for a length.
  template <class Value>
  void lend(const Value* const* values) {
    lent_.push_back([values](std::size_t count) {
      std::vector<std::uint8_t> copy(count * sizeof(Value));
      if (count > 0) std::memcpy(copy.data(), *values, copy.size());
    });
  }
  void read_lent(std::size_t count) const {
    for (const auto& read : lent_) read(count);
  }

 private:
  template <class Object>
  struct Objects {
    std::array<Object*, 4> last{};
    std::set<Object*> living;
  };

  std::tuple<Objects<bch_shape_set>, Objects<bch_shape_builder>, Objects<bch_shape_set_builder>,
             Objects<bch_dynamic_shape_set>, Objects<bch_crowd>, Objects<bch_obstacles>,
             Objects<bch_character>, Objects<bch_scene_plan>, Objects<bch_animated_shape>,
             Objects<bch_body_set>>
      objects_;
  std::vector<void*> all_;
  std::vector<std::function<void(bool)>> after_;
  std::vector<std::function<void(std::size_t)>> lent_;
  std::vector<std::shared_ptr<void>> memory_;

  template <class Object>
  Objects<Object>& objects() {
    return std::get<Objects<Object>>(objects_);
  }

  /// Any handle that ever was one, of any kind, or no such thing.
  void* stranger() {
    const std::uint32_t which = bytes.below(16);
    if (which < 12 && !all_.empty()) return all_[which % all_.size()];
    return reinterpret_cast<void*>(std::uintptr_t{1} << which);
  }

  template <class Object>
  void free_all(bch_status (*call)(Object*)) {
    for (Object* const object : objects<Object>().living)
      require(call(object) == BCH_OK, "what lives can be freed");
  }
};

inline Program::~Program() {
  free_all(bch_shape_builder_free), free_all(bch_shape_set_builder_free);
  free_all(bch_dynamic_shape_set_free), free_all(bch_shape_set_free);
  free_all(bch_crowd_free);
  free_all(bch_obstacles_free), free_all(bch_character_free), free_all(bch_scene_plan_free);
  free_all(bch_animated_shape_free);
}

}  // namespace bch::fuzz
