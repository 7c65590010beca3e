// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/model/model_bytes.hpp"

#include <bit>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <utility>

#include "layout/base/floating_point_state.hpp"
#include "layout/character/character_archive.hpp"

namespace bch::detail {
namespace {

class ModelWriter {
 public:
  void number(std::uint32_t n) {
    for (; n >= 0x80; n >>= 7) bytes_ += static_cast<char>(n | 0x80);
    bytes_ += static_cast<char>(n);
  }
  void number(float x) {
    for (std::uint32_t bits = std::bit_cast<std::uint32_t>(x), i = 0; i < 4; ++i, bits >>= 8)
      bytes_ += static_cast<char>(bits);
  }
  template <class Element>
  void size(const std::vector<Element>& list) {
    number(static_cast<std::uint32_t>(list.size()));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class ModelReader {
 public:
  explicit ModelReader(std::string_view bytes) : left_(bytes) {}

  void number(std::uint32_t& n) {
    std::uint64_t bits = 0, next = 0x80;
    for (int shift = 0; next >= 0x80 && shift < 35; shift += 7) {
      next = byte();
      bits |= (next & 0x7f) << shift;
    }
    if (next >= 0x80 || bits > 0xffffffff) refuse("a number of at most 32 bits", "a larger one");
    n = static_cast<std::uint32_t>(bits);
  }
  void number(float& x) {
    std::uint32_t bits = 0;
    for (int shift = 0; shift < 32; shift += 8) bits |= byte() << shift;
    x = std::bit_cast<float>(bits);
  }
  /// Makes room for elements, each of which takes at least a byte.
  template <class Element>
  void size(std::vector<Element>& list) {
    std::uint32_t size = 0;
    number(size);
    if (size > left_.size())
      refuse("at least " + std::to_string(size) + " more bytes", std::to_string(left_.size()));
    list.resize(size);
  }
  void end() const {
    if (!left_.empty()) refuse("the end", std::to_string(left_.size()) + " more bytes");
  }

 private:
  [[noreturn]] static void refuse(const std::string& expected, const std::string& found) {
    throw std::invalid_argument("bytes of a body model: expected " + expected + ", found " + found);
  }
  std::uint32_t byte() {
    if (left_.empty()) refuse("another byte", "the end");
    const auto first = static_cast<unsigned char>(left_.front());
    left_.remove_prefix(1);
    return first;
  }

  std::string_view left_;
};

/// Passes a number as its difference from another one, small ones of either sign as small numbers. All wraps around.
template <class Archive>
void step(Archive& by, std::uint32_t& n, std::uint32_t from) {
  const std::uint32_t difference = n - from;
  std::uint32_t folded = difference << 1 ^ (0 - (difference >> 31));
  by.number(folded);
  n = from + (folded >> 1 ^ (0 - (folded & 1)));
}

template <class Archive>
void steps(Archive& by, std::vector<std::uint32_t>& ascending) {
  by.size(ascending);
  std::uint32_t last = 0;
  for (std::uint32_t& n : ascending) step(by, n, last), last = n;
}

/// Says once, for both directions, what a model holds.
template <class Archive>
void pass(Archive& by, BodyModel& model) {
  by.number(model.leaf_size);
  for (std::uint32_t& sphere : model.core) by.number(sphere);
  steps(by, model.influence_begin);
  by.size(model.influences);
  for (auto& [bone, weight, centre] : model.influences)
    by.number(bone), by.number(weight), by.number(centre.x), by.number(centre.y), by.number(centre.z);
  by.size(model.midpoints);
  std::uint32_t last = 0;
  for (auto& [a, b] : model.midpoints) step(by, a, last), step(by, b, a), last = a;
  steps(by, model.corner_begin);
  steps(by, model.corners);
  by.size(model.least_radius);
  for (float& radius : model.least_radius) by.number(radius);
}

}  // namespace

std::string bytes_of(const BodyModel& model) {
  BodyModel copy = model;  // which stays as it is: what is read and written goes one way
  ModelWriter writer;
  pass(writer, copy);
  return writer.take();
}

BodyModel model_from(std::string_view bytes, std::shared_ptr<const Character> character) {
  BodyModel model;
  ModelReader reader(bytes);
  pass(reader, model);
  reader.end();
  model.character = std::move(character);
  return model;
}

}  // namespace bch::detail

namespace bch {

using namespace detail;

std::vector<std::byte> to_bytes(const BodyModel& model) {
  validate(model);
  Character character = *model.character;
  std::string own = bytes_of(model);
  ByteWriter writer;
  CharacterFields(writer).all(character, own);
  const std::string all = writer.take();
  const auto bytes = std::as_bytes(std::span(all));
  return {bytes.begin(), bytes.end()};
}

BodyModel body_model(std::span<const std::byte> bytes) {
  const FloatingPointStateGuard floats;
  Character character;
  std::string own;
  ByteReader reader({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  CharacterFields(reader).all(character, own);
  reader.end();
  BodyModel model = model_from(own, std::make_shared<const Character>(std::move(character)));
  validate(model);
  return model;
}

}  // namespace bch
