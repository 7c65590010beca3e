// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

// What libFuzzer calls. A fault ends the program: a failed expectation of GoogleTest, too.

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace bch::fuzz {

/// Ends the program, saying what is wrong, where it does not hold.
void require(bool holds, const char* what);

/// An input that is taken apart from its front; zeros follow its last byte.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

  bool empty() const { return left_.empty(); }
  std::span<const std::uint8_t> rest() const { return left_; }

  template <class Value>
  Value take() {
    static_assert(std::is_trivially_copyable_v<Value>);
    Value value{};
    const std::size_t size = std::min(sizeof value, left_.size());
    if (size > 0) std::memcpy(&value, left_.data(), size);
    left_ = left_.subspan(size);
    return value;
  }

  std::uint32_t below(std::uint32_t bound) {
    return bound <= 256 ? take<std::uint8_t>() % bound : take<std::uint32_t>() % bound;
  }

  /// Takes one of 2^16 multiples of `step` about 0.
  float coordinate(float step) { return static_cast<float>(take<std::int16_t>()) * step; }

  /// Takes mostly a coordinate, at times any float there is.
  float number(float step) {
    if (below(16) > 0) return coordinate(step);
    return take<float>();
  }

  /// Takes text up to the next zero byte.
  std::string text() {
    std::string text;
    while (!left_.empty())
      if (const char c = take<char>(); c != '\0')
        text += c;
      else
        break;
    return text;
  }

 private:
  std::span<const std::uint8_t> left_;
};

}  // namespace bch::fuzz
