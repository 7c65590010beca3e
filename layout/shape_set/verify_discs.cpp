// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>

#include "layout/culling/profile.hpp"
#include "layout/culling/supports.hpp"
#include "layout/shape_set/verify_parts.hpp"

// What follows from a shape's discs alone.

namespace bch::detail::verification {
namespace {

void verify_parts(const Look& look, std::uint32_t level) {
  const CutDiscs parts = look.cut(level), wholes = look.cut(level - 1);
  for (std::uint32_t i = 0; i < parts.count; ++i) {
    const Disc part{parts.x[i], parts.y[i], parts.radius[i]};
    bool found = false;
    for (std::uint32_t j = 0; j < wholes.count && !found; ++j)
      found = may_be_part(part, {wholes.x[j], wholes.y[j], wholes.radius[j]}, look.tolerance());
    if (!found)
      look.say(look.set.roots_only() ? "roots" : "nodes", level,
               "disc " + std::to_string(i) + " at " + text_of(part) + " belongs to none of level " +
                   std::to_string(level - 1));
  }
}

}  // namespace

void verify_levels(const Look& look) {
  for (std::uint32_t level = 0; level < look.levels(); ++level) {
    const std::uint32_t depth = look.set.depths()[level], count = look.cut(level).count;
    if (depth < 32 && count > std::uint64_t{1} << depth)
      look.say("depths", level, std::to_string(count) + " discs at depth " + std::to_string(depth));
    if (level == 0) continue;
    if (count < look.cut(level - 1).count)
      look.say("depths", level, std::to_string(count) + " discs, fewer than at the level before");
    verify_parts(look, level);
  }
}

/// A smallest disc's centre is within the reach, and a shape reaches no farther than its discs do.
void verify_reach(const Look& look) {
  double least = 0, most = 0;
  for (std::uint32_t level = 0; level < look.levels(); ++level) {
    const CutDiscs discs = look.cut(level);
    double extent = 0;
    for (std::uint32_t i = 0; i < discs.count; ++i) {
      const double radius = discs.radius[i], away = distance({discs.x[i], discs.y[i], 0}, {0, 0, 0});
      least = std::max(least, away);
      extent = std::max(extent, away + radius);
    }
    most = level == 0 ? extent : std::min(most, extent);
  }
  if (look.reach < least - look.tolerance() || look.reach > most + look.tolerance())
    look.say(
        "reach", Finding::no_level,
        shortest(look.reach) + " m, and its discs say " + shortest(least) + " to " + shortest(most) + " m");
}

void verify_supports(const Look& look) {
  const std::uint32_t deepest = look.levels() - 1, row = look.arrays().roots[look.root(deepest)].row;
  if (row < first_row) return;
  const CutDiscs discs = look.cut(deepest);
  const Supports expected = supports(discs.x, discs.y, discs.radius, discs.count, look.reach);
  const float* stored = look.arrays().support.data() + std::size_t{row} * support_stride;
  for (std::uint32_t k = 0; k < support_stride; ++k)
    look.compare("support", deepest, "number " + std::to_string(k), static_cast<double>(stored[k]),
                 static_cast<double>(expected[k]));
}

}  // namespace bch::detail::verification
