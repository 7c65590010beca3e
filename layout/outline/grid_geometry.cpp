// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/grid_geometry.hpp"

namespace bch::detail {
namespace {

int compare_coordinate(std::int64_t from, std::int64_t direction, const Fraction& at, std::int64_t limit) {
  const Wide along = Wide{direction} * at.numerator, needed = Wide{limit - from} * at.denominator;
  return (along > needed) - (along < needed);
}

/// floor(from + direction * at + 1/2). In double the sum is off by less than 2^-27, which matters only where it
/// is about half-way between two steps.
std::int32_t rounded_coordinate(std::int32_t from, std::int64_t direction, const Fraction& at) {
  const double place = static_cast<double>(from) + static_cast<double>(direction) * at.value + 0.5;
  auto floor = static_cast<std::int64_t>(place);
  if (static_cast<double>(floor) > place) --floor;
  const double above = place - static_cast<double>(floor);
  if (above > 0x1p-20 && above < 1 - 0x1p-20) return static_cast<std::int32_t>(floor);

  const Wide numerator = 2 * (Wide{from} * at.denominator + Wide{direction} * at.numerator) + at.denominator;
  const Wide denominator = 2 * Wide{at.denominator};
  const Wide quotient = numerator / denominator;
  return static_cast<std::int32_t>(quotient - (quotient * denominator > numerator));
}

}  // namespace

int compare_x(const Place& place, std::int32_t x) {
  return compare_coordinate(place.from.x, place.direction().x, place.at, x);
}

int compare_y(const Place& place, std::int32_t y) {
  return compare_coordinate(place.from.y, place.direction().y, place.at, y);
}

GridPoint rounded(const Place& place) {
  if (place.at.numerator == 0) return place.from;
  return {rounded_coordinate(place.from.x, place.direction().x, place.at),
          rounded_coordinate(place.from.y, place.direction().y, place.at)};
}

}  // namespace bch::detail
