// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <bch/body_set.hpp>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/base/space_point.hpp"
#include "layout/body/body_record.hpp"
#include "layout/body/cover_rounding.hpp"

namespace bch {

using namespace detail;

namespace {

[[noreturn]] void refuse_capsule(std::size_t capsule, const std::string& what) {
  throw std::invalid_argument("spheres of capsules: capsule " + std::to_string(capsule) + ": " + what);
}

/// Appends spheres in a row from one end of a capsule to the other. A point of the capsule is at most half the spacing away from the nearest
/// centre along the axis, or beyond an end, and at most the radius away from the axis: spheres of the radius
///
///     sqrt(radius^2 + (spacing / 2)^2)
///
/// hold it, and reach out of the capsule by the excess of that over the radius.
void add_row(const BodySet::Capsule& capsule, std::size_t number, float error, std::vector<Sphere>& spheres) {
  const SpacePoint a = space_point(capsule.a), b = space_point(capsule.b), axis = b - a;
  const double radius = capsule.radius, length = std::sqrt(dot(axis, axis)),
               // A NaN at either end makes the length one, where a maximum may drop it.
      max_extent = (length >= 0 ? std::sqrt(std::max(dot(a, a), dot(b, b))) : length) + radius;
  if (!(radius >= 0 && max_extent >= rounding::smallest_extent && max_extent <= rounding::largest_extent))
    refuse_capsule(number,
                   "expected a radius of at least 0 and an extent of 1e-6 to 1e6 m, found a radius of " +
                       shortest(capsule.radius) + " and an extent of " + shortest(max_extent));
  const double spare = cover_rounding * (max_extent + double{error}), tolerance = double{error} - 2 * spare;
  if (!(tolerance > 0))
    refuse_capsule(number, "expected an error above " + shortest(2 * cover_rounding * max_extent) +
                               " m, found " + shortest(error));
  const double parts =
      std::max(1.0, std::ceil(length / (2 * std::sqrt(tolerance * (2 * radius + tolerance)))));
  if (parts + 1 + static_cast<double>(spheres.size()) > max_spheres)
    refuse_capsule(number, "expected an error that " + std::to_string(max_spheres) + " spheres keep, found " +
                               shortest(error) + " m");
  const double half = length / parts / 2;
  const float enclosing_radius = static_cast<float>(std::sqrt(radius * radius + half * half) + spare);
  for (double i = 0; i <= parts; ++i) {
    const auto [x, y, z] = rounded(a + i / parts * axis);
    spheres.push_back({x, y, z, enclosing_radius});
    if (length == 0) return;
  }
}

}  // namespace

std::vector<Sphere> spheres_from_capsules(std::span<const BodySet::Capsule> capsules, float error) {
  const FloatingPointStateGuard floats;
  if (capsules.empty()) throw std::invalid_argument("spheres of capsules: expected at least one, found none");
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < capsules.size(); ++i) add_row(capsules[i], i, error, spheres);
  return spheres;
}

}  // namespace bch
