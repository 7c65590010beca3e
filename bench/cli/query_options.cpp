// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/cli/query_options.hpp"

#include <fmt/format.h>

#include <limits>

#include "bench/base/exit_codes.hpp"
#include "bench/base/number.hpp"

namespace bch::cli {
namespace {

/// Returns the numbers before and behind a comma; NaN for other text.
std::pair<double, double> numbers_of(const std::string& text) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return {none, none};
  return {parse_number(text.substr(0, comma)).value_or(none),
          parse_number(text.substr(comma + 1)).value_or(none)};
}

}  // namespace

std::optional<Vec2> QueryCommandOptions::only_direction() const {
  if (direction.empty()) return std::nullopt;
  const auto [to_x, to_y] = numbers_of(direction);
  const auto x = static_cast<float>(to_x), y = static_cast<float>(to_y);
  if (!std::isfinite(x) || !std::isfinite(y) || (x == 0 && y == 0))
    throw UsageError(fmt::format("--direction: '{}' is not X,Y with a length", direction));
  return Vec2{x, y};
}

std::pair<double, double> QueryCommandOptions::heights_of_obstacles() const {
  if (obstacle_heights.empty()) return {-HUGE_VAL, HUGE_VAL};
  const auto heights = numbers_of(obstacle_heights);
  if (!(heights.first <= heights.second))
    throw UsageError(
        fmt::format("--obstacle-heights: '{}' is not BOTTOM,TOP, the lower first", obstacle_heights));
  return heights;
}

}  // namespace bch::cli
