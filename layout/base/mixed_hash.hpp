// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace bch::detail {

/// Mixes the bits of a number, so that each bit of the result depends on all: the end of splitmix64 (Steele, Lea,
/// Flood 2014).
constexpr std::uint64_t mixed(std::uint64_t z) noexcept {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// Hashes integers that come from input, such as people's ids. std::hash returns the number itself, so a file could
/// put all of its numbers into one bucket. Here each container adds the time of its construction, which no file can
/// know: nothing may depend on the order of the container.
class MixedHash {
 public:
  std::size_t operator()(std::uint64_t number) const noexcept {
    return static_cast<std::size_t>(mixed(number + seed_));
  }

 private:
  std::uint64_t seed_ =
      static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
};

}  // namespace bch::detail
