// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/verify.hpp"

#include <algorithm>
#include <cmath>

#include "layout/base/floating_point_state.hpp"
#include "layout/shape_set/flat_shape.hpp"
#include "layout/shape_set/verify_parts.hpp"

namespace bch::detail::verification {

std::string text_of(const Disc& disc) {
  std::string text = "(";
  text.append(shortest(disc.x)).append(", ").append(shortest(disc.y));
  return text.append(") of radius ").append(shortest(disc.radius)).append(" m");
}

void Verifier::compare(const char* array, std::uint32_t level, const std::string& place, double stored,
                       double expected) const {
  if (stored == expected || std::abs(stored - expected) <= tolerance()) return;
  report(array, level, place + " is " + shortest(stored) + " m, not " + shortest(expected) + " m");
}

namespace {

double extent_of(const Root& root) {
  return std::hypot(static_cast<double>(root.x), static_cast<double>(root.y)) +
         static_cast<double>(root.radius);
}

void verify_shape(const Verifier& verifier) {
  verify_levels(verifier);
  if (verifier.set.roots_only()) return;
  const Outline outline = outline_of(verifier.arrays(), verifier.shape);
  verify_extent(verifier);
  for (std::uint32_t level = 0; level < verifier.levels(); ++level) {
    verify_tree(verifier, level);
    verify_cover(verifier, outline, level);
  }
  verify_contours(verifier, outline);
  if (outline.contours() > 0) verify_segments(verifier);
  if (verifier.arrays().profiles.empty()) return;
  const DeepestBounds bounds = deepest_bounds(verifier, outline);
  verify_supports(verifier, bounds.stored.supports);
  verify_profile(verifier, outline, bounds);
  verify_inside(verifier, outline);
}

}  // namespace
}  // namespace bch::detail::verification

namespace bch::detail {

std::string text_of(const Inconsistency& inconsistency) {
  std::string text = "shape ";
  text += std::to_string(inconsistency.shape);
  if (inconsistency.level != Inconsistency::no_level)
    text.append(", level ").append(std::to_string(inconsistency.level));
  return text.append(": ").append(inconsistency.array).append(": ").append(inconsistency.what);
}

std::vector<Inconsistency> verify(const ShapeSet& set, std::size_t most) {
  const FloatingPointStateGuard floats;
  std::vector<Inconsistency> inconsistencies;
  const ShapeArrays& arrays = set.arrays();
  for (std::uint32_t shape = 0; shape < set.shape_count() && inconsistencies.size() < most; ++shape) {
    const double max_extent =
        set.roots_only() ? verification::extent_of(arrays.roots[std::size_t{shape} * set.level_count()])
                         : static_cast<double>(arrays.max_extent[shape]);
    verification::verify_shape({set, inconsistencies, most, shape, max_extent});
  }
  return inconsistencies;
}

}  // namespace bch::detail
