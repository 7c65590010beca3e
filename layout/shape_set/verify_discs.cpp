// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>

#include "layout/culling/profile.hpp"
#include "layout/culling/supports.hpp"
#include "layout/shape_set/verify_parts.hpp"

// What follows from a shape's discs alone.

namespace bch::detail::verification {
namespace {

void verify_parts(const Verifier& verifier, std::uint32_t level) {
  const CutDiscs parts = verifier.cut(level), wholes = verifier.cut(level - 1);
  for (std::uint32_t i = 0; i < parts.count; ++i) {
    const Disc part{parts.x[i], parts.y[i], parts.radius[i]};
    bool found = false;
    for (std::uint32_t j = 0; j < wholes.count && !found; ++j)
      found = may_be_part(part, {wholes.x[j], wholes.y[j], wholes.radius[j]}, verifier.tolerance());
    if (!found)
      verifier.report(verifier.set.roots_only() ? "roots" : "nodes", level,
                      "disc " + std::to_string(i) + " at " + text_of(part) + " belongs to none of level " +
                          std::to_string(level - 1));
  }
}

}  // namespace

void verify_levels(const Verifier& verifier) {
  for (std::uint32_t level = 0; level < verifier.levels(); ++level) {
    const std::uint32_t depth = verifier.set.depths()[level], count = verifier.cut(level).count;
    if (depth < 32 && count > std::uint64_t{1} << depth)
      verifier.report("depths", level, std::to_string(count) + " discs at depth " + std::to_string(depth));
    if (level == 0) continue;
    if (count < verifier.cut(level - 1).count)
      verifier.report("depths", level, std::to_string(count) + " discs, fewer than at the level before");
    verify_parts(verifier, level);
  }
}

/// A smallest disc's centre is within the extent, and a shape reaches no farther than its discs do.
void verify_extent(const Verifier& verifier) {
  double least = 0, most = 0;
  for (std::uint32_t level = 0; level < verifier.levels(); ++level) {
    const CutDiscs discs = verifier.cut(level);
    double extent = 0;
    for (std::uint32_t i = 0; i < discs.count; ++i) {
      const double radius = discs.radius[i], away = distance({discs.x[i], discs.y[i], 0}, {0, 0, 0});
      least = std::max(least, away);
      extent = std::max(extent, away + radius);
    }
    most = level == 0 ? extent : std::min(most, extent);
  }
  if (verifier.max_extent < least - verifier.tolerance() || verifier.max_extent > most + verifier.tolerance())
    verifier.report("max_extent", Inconsistency::no_level,
                    shortest(verifier.max_extent) + " m, and its discs say " + shortest(least) + " to " +
                        shortest(most) + " m");
}

DeepestBounds deepest_bounds(const Verifier& verifier, const Outline& outline) {
  const std::uint32_t deepest = verifier.levels() - 1;
  const CutDiscs cut = verifier.cut(deepest);
  const Profile& profile = verifier.arrays().profiles[verifier.shape];
  const Bounds discs{supports(cut.x, cut.y, cut.radius, cut.count, verifier.max_extent),
                     outer(profile, cut.x, cut.y, cut.radius, cut.count, verifier.max_extent)};
  const bool has_segments = verifier.arrays().trees[verifier.root(deepest)].segments != no_segments;
  PointDiscs points;
  points.assign(outline);
  return {discs, has_segments ? outline_bounds(profile, points, verifier.max_extent) : discs};
}

void verify_supports(const Verifier& verifier, const Supports& expected) {
  const std::uint32_t deepest = verifier.levels() - 1,
                      row = verifier.arrays().roots[verifier.root(deepest)].row;
  if (row < first_row) return;
  const float* stored = verifier.arrays().support.data() + std::size_t{row} * support_stride;
  for (std::uint32_t k = 0; k < support_stride; ++k)
    verifier.compare("support", deepest, "number " + std::to_string(k), static_cast<double>(stored[k]),
                     static_cast<double>(expected[k]));
}

}  // namespace bch::detail::verification
