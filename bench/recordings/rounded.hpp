// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>
#include <limits>

namespace bch::cli {

/// Returns the nearest value of an integer type of at most 32 bits: its least or largest beyond its range, 0 for what
/// is not a number.
template <class Integer>
Integer rounded(double value) {
  using Limits = std::numeric_limits<Integer>;
  static_assert(sizeof(Integer) <= 4);
  if (std::isnan(value)) return 0;
  const double whole = std::round(value);
  if (whole <= static_cast<double>(Limits::min())) return Limits::min();
  if (whole >= static_cast<double>(Limits::max())) return Limits::max();
  return static_cast<Integer>(whole);
}

}  // namespace bch::cli
