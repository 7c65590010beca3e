// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "layout/base/mixed_hash.hpp"

namespace bch::detail {

/// Implements splitmix64 (Steele, Lea, Flood 2014). A seed gives the same numbers everywhere; the distributions of
/// the standard library differ between vendors.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() { return mixed(state_ += 0x9e3779b97f4a7c15u); }

  /// Draws a real number from [0, bound).
  double uniform(double bound) { return static_cast<double>(next() >> 11) * 0x1p-53 * bound; }
  /// Draws a real number from [low, high).
  double between(double low, double high) { return low + uniform(high - low); }

  /// Draws an integer from [0, bound).
  std::uint32_t below(std::uint32_t bound) {
    return static_cast<std::uint32_t>(((next() >> 32) * bound) >> 32);
  }

 private:
  std::uint64_t state_;
};

}  // namespace bch::detail
