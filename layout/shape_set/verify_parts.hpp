// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <bch/outline.hpp>
#include <bch/shapes.hpp>

#include "layout/base/shortest.hpp"
#include "layout/culling/profile.hpp"
#include "layout/format/cut_discs.hpp"
#include "layout/format/shape_arrays.hpp"
#include "layout/shape_set/verify.hpp"

/// Contains the parts of verify(), and what the parts share.
namespace bch::detail::verification {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Represents the shape that is being verified, and the list of inconsistencies.
struct Verifier {
  const ShapeSet& set;
  std::vector<Inconsistency>& inconsistencies;
  std::size_t most;  ///< the limit of inconsistencies
  std::uint32_t shape;
  double max_extent;  ///< metres; in a set of roots alone, the extent of the root

  const ShapeArrays& arrays() const { return set.arrays(); }
  std::uint32_t levels() const { return set.level_count(); }
  std::uint32_t root(std::uint32_t level) const { return shape * set.level_count() + level; }
  CutDiscs cut(std::uint32_t level) const { return cut_discs(set.view(), root(level)); }
  /// The tolerance of lengths: for rounding to float, and for recomputing from an extent that was rounded up.
  double tolerance() const { return 0x1p-19 * max_extent; }

  void report(const char* array, std::uint32_t level, const std::string& what) const {
    if (inconsistencies.size() < most) inconsistencies.push_back({shape, level, array, what});
  }
  /// Reports a stored length that differs from the recomputed one.
  void compare(const char* array, std::uint32_t level, const std::string& place, double stored,
               double expected) const;
};

std::string text_of(const Disc& disc);
double distance(const Disc& a, const Disc& b);  ///< of the centres
/// Returns whether one disc may be the smallest disc of a part of the other disc's points.
bool may_be_part(const Disc& part, const Disc& whole, double tolerance);

void verify_tree(const Verifier& verifier, std::uint32_t level);
void verify_levels(const Verifier& verifier);
void verify_extent(const Verifier& verifier);
/// Holds bounds of a shape's deepest cut: of its discs, and the bounds that a set stores, which are those of the
/// outline if the cut has segments.
struct DeepestBounds {
  Bounds discs, stored;
};
DeepestBounds deepest_bounds(const Verifier& verifier, const Outline& outline);
void verify_supports(const Verifier& verifier, const Supports& expected);
void verify_profile(const Verifier& verifier, const Outline& outline, const DeepestBounds& bounds);
void verify_inside(const Verifier& verifier, const Outline& outline);
void verify_contours(const Verifier& verifier, const Outline& outline);
void verify_cover(const Verifier& verifier, const Outline& outline, std::uint32_t level);
void verify_segments(const Verifier& verifier);

}  // namespace bch::detail::verification
