// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <bch/bch.h>

#include "tests/fuzz/target.hpp"

namespace bch::fuzz {

/// A struct of the C interface with what a caller of another version has: bytes behind its end.
template <class Struct>
struct Versioned {
  Struct known;
  std::uint8_t later[64];
};

/// A caller of the C interface who does as the bytes of an input say, and knows what has to come of it.
class Program {
 public:
  Program(const std::uint8_t* data, std::size_t size) : bytes(data, size) {}
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  Bytes bytes;

  /// Checks what a status and its message are; a fault of the library is one in any case.
  /// Returns: whether the call succeeded.
  static bool succeeded(bch_status status);

  bool chance(std::uint32_t one_of) { return bytes.below(one_of) == one_of - 1; }

  /// A handle: one of the last few that were handed out, which live or were freed; NULL; or what is no such object.
  template <class Object>
  Object* handle() {
    const std::uint32_t kind = bytes.below(64);
    if (kind == 62) return nullptr;
    if (kind == 63) return static_cast<Object*>(stranger());
    return objects<Object>().last[kind % 4];
  }

  /// Takes what a function hands out by its last argument.
  template <class Object, class Make>
  void make(Make call) {
    Object* object = nullptr;
    if (!succeeded(call(&object))) return require(object == nullptr, "nothing is handed out on an error");
    require(object != nullptr, "an object is handed out");
    objects<Object>().living.insert(object);
    keep(object);
  }

  /// The same for what an input begins with, which never fails and is every handle of its kind.
  template <class Object, class Make>
  Object* begin_with(Make call) {
    Object* object = nullptr;
    require(call(&object) == BCH_OK, "what inputs begin with is made");
    objects<Object>().living.insert(object);
    objects<Object>().last.fill(object);
    all_.push_back(object);
    return object;
  }

  /// Frees a handle, which works for living objects and NULL alone.
  template <class Object>
  void free(bch_status (*call)(Object*)) {
    Object* const object = handle<Object>();
    const bool living = objects<Object>().living.erase(object) > 0;
    require(succeeded(call(object)) == (living || object == nullptr), "what lives can be freed, once");
  }

  /// Keeps a handle for later calls, in the place of one before.
  template <class Object>
  void keep(Object* object) {
    objects<Object>().last[bytes.below(4)] = object;
    all_.push_back(object);
  }

  /// How many entries an array has that has room for so many; at times more than memory has.
  std::size_t count(std::uint32_t room) {
    if (chance(128)) return std::numeric_limits<std::size_t>::max() - bytes.below(2);
    return bytes.below(room + 1);
  }

  /// A pointer to an array, mostly.
  template <class Value>
  Value* array(Value* values) {
    return chance(128) ? nullptr : values;
  }

  /// A number about 0, or one that is odd: `smallest` apart from those that are none.
  template <class Real>
  Real number(Real smallest = Real(0x1p-5)) {
    using Limits = std::numeric_limits<Real>;
    constexpr Real odd[] = {Limits::quiet_NaN(), Limits::infinity(),   -Limits::infinity(), Limits::max(),
                            Limits::lowest(),    Limits::denorm_min(), Real(-0.0)};
    if (chance(256)) return odd[bytes.below(std::size(odd))];
    return static_cast<Real>(bytes.take<std::int8_t>()) * smallest;
  }

  /// A small number, or any.
  std::uint32_t index(std::uint32_t most) {
    return chance(256) ? bytes.take<std::uint32_t>() : bytes.below(most);
  }

  /// Where each of `parts` begins in an array with this room: ascending, mostly.
  void fill_offsets(std::uint64_t* offsets, std::uint32_t parts, std::uint32_t room) {
    std::uint64_t at = 0;
    for (std::uint32_t i = 0; i <= parts; ++i) {
      if (chance(64)) at = chance(4) ? ~std::uint64_t{0} - bytes.below(2) : bytes.below(room + 1);
      offsets[i] = at;
      at = std::min<std::uint64_t>(at + bytes.below(6), std::max<std::uint64_t>(at, room));
    }
  }

  /// Gives a struct a size: the right one mostly, one of the past, of the future, absurd, or one that cuts a member.
  template <class Struct>
  Struct* sized(Versioned<Struct>& of) {
    std::memset(of.later, 0, sizeof of.later);
    of.known.size = sizeof of.known;
    if (!chance(32)) return &of.known;
    const std::uint32_t kind = bytes.below(5);
    if (kind == 0) of.known.size = 4 + bytes.below(sizeof of.known - 4);
    if (kind == 1) of.known.size = bytes.below(4);
    if (kind == 2) of.known.size = 4097 + bytes.take<std::uint8_t>();
    if (kind >= 3) of.known.size = sizeof of.known + bytes.below(sizeof of.later + 1);
    if (kind == 4) of.later[bytes.below(sizeof of.later)] = bytes.take<std::uint8_t>();
    return &of.known;
  }

  bch_query_options* options() {
    if (chance(8)) return nullptr;
    options_.known = BCH_QUERY_OPTIONS_INIT;
    const std::uint8_t bits = bytes.take<std::uint8_t>();
    options_.known.semantics = bits & 1, options_.known.leaves = bits >> 1 & 1;
    options_.known.distance_leaves = bits >> 2 & 1, options_.known.overlap = bits >> 3 & 1;
    if (bits >= 0xf0) options_.known.leaves = bytes.take<std::int32_t>();
    options_.known.threads = chance(32) ? 1025 + bytes.take<std::uint8_t>() : 1;
    options_.known.max_distance = chance(4) ? number<double>() : static_cast<double>(INFINITY);
    if (chance(4)) options_.known.implementation = implementation();
    return sized(options_);
  }

 private:
  template <class Object>
  struct Objects {
    std::array<Object*, 4> last{};
    std::set<Object*> living;
  };

  std::tuple<Objects<bch_shape_set>, Objects<bch_pose_shaper>, Objects<bch_shape_set_builder>,
             Objects<bch_dynamic_shape_set>, Objects<bch_broad_phase>, Objects<bch_crowd_collider>,
             Objects<bch_contact_finder>, Objects<bch_obstacles>, Objects<bch_character>,
             Objects<bch_scene_plan>>
      objects_;
  std::vector<void*> all_;
  Versioned<bch_query_options> options_{};
  std::string name_;

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

  const char* implementation() {
    if (const std::uint32_t which = bytes.below(6); which < 4) return bch_implementation_name(which);
    name_ = bytes.text();
    return name_.c_str();
  }

  template <class Object>
  void free_all(bch_status (*call)(Object*)) {
    for (Object* const object : objects<Object>().living)
      require(call(object) == BCH_OK, "what lives can be freed");
  }
};

inline bool Program::succeeded(bch_status status) {
  require(status >= BCH_OK && status < BCH_INTERNAL, "no fault of the library");
  if (status == BCH_OK) return true;
  const std::string message = bch_last_error();
  require(!message.empty(), "errors have a message");
  require(message.find('\n') == std::string::npos, "messages are one line");
  return false;
}

inline Program::~Program() {
  free_all(bch_pose_shaper_free);
  free_all(bch_shape_set_builder_free);
  free_all(bch_dynamic_shape_set_free);
  free_all(bch_shape_set_free);
  free_all(bch_broad_phase_free);
  free_all(bch_crowd_collider_free);
  free_all(bch_contact_finder_free);
  free_all(bch_obstacles_free);
  free_all(bch_character_free);
  free_all(bch_scene_plan_free);
}

}  // namespace bch::fuzz
