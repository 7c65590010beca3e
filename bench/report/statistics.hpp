// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bch::report {

/// Holds the quartiles of times, and of other values whose distribution is skewed.
struct Quartiles {
  double low, median, high;
};

/// Returns quartiles, interpolated between the two values next to a quarter, a half, three quarters of the
/// way; NaN of no values.
Quartiles quartiles(std::vector<double> values);

/// Holds a mean, the standard deviation of the values, and the mean's 95 % confidence interval.
struct Estimate {
  double mean, deviation, low, high;
};

/// Estimates a mean by the percentile bootstrap: 1 000 samples with replacement, the same for a seed
/// everywhere. NaN of no values.
/// Source: B. Efron, R. Tibshirani, "An Introduction to the Bootstrap", 1993, chapter 13.
Estimate estimate(std::span<const double> values, std::uint64_t seed);

/// Estimates a share by Wilson's score interval, which holds near 0 and 1 as well.
/// Source: E. B. Wilson, "Probable inference, the law of succession, and statistical inference", JASA 22, 1927.
Estimate share(std::size_t of_these, std::size_t all);

}  // namespace bch::report
