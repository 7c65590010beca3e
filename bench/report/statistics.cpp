// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/statistics.hpp"
#include "layout/base/random.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bch::report {
namespace {

constexpr std::size_t resamples = 1000;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double quantile(const std::vector<double>& sorted, double at) {
  const double place = at * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double mean_of(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

Quartiles quartiles(std::vector<double> values) {
  if (values.empty()) return {nan, nan, nan};
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.25), quantile(values, 0.5), quantile(values, 0.75)};
}

Estimate estimate(std::span<const double> values, std::uint64_t seed) {
  if (values.empty()) return {nan, nan, nan, nan};
  const double mean = mean_of(values);
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const auto count = static_cast<std::uint32_t>(values.size());
  const double deviation = count > 1 ? std::sqrt(squares / (count - 1)) : 0;

  detail::Random random(seed);
  std::vector<double> means(resamples), sample(count);
  for (double& of_sample : means) {
    for (double& value : sample) value = values[random.below(count)];
    of_sample = mean_of(sample);
  }
  std::sort(means.begin(), means.end());
  return {mean, deviation, quantile(means, 0.025), quantile(means, 0.975)};
}

Estimate share(std::size_t of_these, std::size_t all) {
  if (all == 0) return {nan, nan, nan, nan};
  constexpr double z = 1.959963984540054;  // of the normal distribution, 97.5 %
  const auto n = static_cast<double>(all);
  const double p = static_cast<double>(of_these) / n;
  const double centre = (p + z * z / (2 * n)) / (1 + z * z / n);
  const double half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  return {p, std::sqrt(p * (1 - p)), std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

}  // namespace bch::report
