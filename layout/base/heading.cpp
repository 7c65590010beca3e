// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/heading.hpp"

#include <cmath>

namespace bch::detail {
namespace {

double round_to_integer(double x) {
  return (x + heading_constants::round_to_integer) - heading_constants::round_to_integer;
}

double square_of(double x, double y) {
  return x * x + y * y;
}

}  // namespace

bool is_unit(double x, double y) noexcept {
  const double square = square_of(x, y);
  return heading_constants::least_square <= square && square <= heading_constants::largest_square;
}

Rotation rotation(double heading) noexcept {
  namespace k = heading_constants;
  const double quarters = round_to_integer(heading * k::two_over_pi);
  double r = heading - quarters * k::half_pi[0];
  r = r - quarters * k::half_pi[1];
  r = r - quarters * k::half_pi[2];
  r = r - quarters * k::half_pi[3];

  const double square = r * r;
  double s = k::sine[0];
  for (int i = 1; i < 5; ++i) s = s * square + k::sine[i];
  s = s * square * r + r;
  double c = k::cosine[0];
  for (int i = 1; i < 5; ++i) c = c * square + k::cosine[i];
  c = c * square + 1.0;

  // Turn by the -2 ... 2 quarters that remain: their cosine and sine are 0 or +-1, so nothing is rounded.
  const double left = quarters - 4 * round_to_integer(quarters * 0.25);
  const double turn_cosine = 1 - std::abs(left);
  const double turn_sine = left * (2 - std::abs(left));
  return {c * turn_cosine - s * turn_sine, s * turn_cosine + c * turn_sine};
}

Rotation rotation(const Headings::Value& heading) noexcept {
  if (!heading.is_direction) return rotation(heading.x);
  Rotation unit{heading.x, heading.y};
  for (int i = 0; i < 2; ++i) {
    const double by =
        heading_constants::newton[0] - heading_constants::newton[1] * square_of(unit.cosine, unit.sine);
    unit = {unit.cosine * by, unit.sine * by};
  }
  return unit;
}

UnitVector unit_vector(double heading) noexcept {
  return unit_vector(Headings::Value{heading});
}

UnitVector unit_vector(const Headings::Value& heading) noexcept {
  const Rotation r = rotation(heading);
  return {static_cast<float>(r.cosine), static_cast<float>(r.sine)};
}

}  // namespace bch::detail
