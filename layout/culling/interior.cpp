// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/culling/interior.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/contours.hpp"

namespace bch::detail {
namespace {

/// The dilation in cells of the coverage's raster. The raster holds the contour's longer side with the
/// dilation on either side.
constexpr float dilation = DiscCoverage::cells / 12.0f;
constexpr double longer_side = DiscCoverage::cells - 2 * static_cast<double>(dilation);

/// Discs that the float test accepts are at most 23 u S apart. Inscribed radii are shorter by query_margin, so that areas
/// meet then. (Their centres are floats, and exact.)
static_assert(rounding::query_margin >= rounding::terms::query_error * rounding::unit_roundoff);

/// A candidate with less than this fraction of its estimated radius is not sound.
constexpr double least_fraction = 0.5;

/// Opposite directions have the same line, so half of them suffice.
struct Lines {
  alignas(64) std::array<double, contour_lines> cosine, sine;

  Lines() {
    static_assert(2 * contour_lines == extreme_directions);
    for (std::uint32_t k = 0; k < contour_lines; ++k) {
      const Rotation direction = rotation(2 * std::numbers::pi * k / extreme_directions);
      cosine[k] = direction.cosine, sine[k] = direction.sine;
    }
  }
};

/// Returns whether a winding number means inside, as containment counts: a contour from elsewhere may overlap
/// itself.
bool is_inside(double winding) {
  return static_cast<int>(winding) % 2 != 0;
}

void set_extremes(const InteriorLoops& loops, std::span<const Vec2> contour, Interior& result) {
  static const Lines lines;
  alignas(64) std::array<double, extreme_directions> farthest;
  loops.find_extremes(contour.data(), contour.size(),
                      {lines.cosine.data(), lines.sine.data(), &farthest[contour_lines], &farthest[0]});
  for (std::uint32_t k = 0; k < extreme_directions; ++k) {
    const Vec2 point = contour[static_cast<std::size_t>(farthest[k])];
    result.extreme_x[k] = point.x;
    result.extreme_y[k] = point.y;
  }
}

}  // namespace

InteriorBuilder::InteriorBuilder() : InteriorBuilder(best_build_implementation()) {}

InteriorBuilder::InteriorBuilder(const BuildImplementation& implementation)
    : loops_(&implementation.loops.interior) {}

InteriorBuilder::Frame InteriorBuilder::frame(Contour contour) {
  Vec2 low = contour[0], high = contour[0];
  for (const Vec2 p : contour) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double left = static_cast<double>(low.x), right = static_cast<double>(high.x),
               bottom = static_cast<double>(low.y), top = static_cast<double>(high.y);
  const double cell = std::max(right - left, top - bottom) / longer_side;
  constexpr double half = 0.5 * DiscCoverage::cells;
  return {0.5 * (left + right) - half * cell, 0.5 * (bottom + top) - half * cell, cell};
}

void InteriorBuilder::to_cells(Contour contour) {
  const double over = 1 / frame_.cell;
  x_.resize(contour.size());
  y_.resize(contour.size());
  for (std::size_t i = 0; i < contour.size(); ++i) {
    x_[i] = static_cast<float>((static_cast<double>(contour[i].x) - frame_.x) * over);
    y_[i] = static_cast<float>((static_cast<double>(contour[i].y) - frame_.y) * over);
  }
}

/// Takes the best of the candidates that are left, each moved away from the contour as far as it grows.
/// Returns whether all are about as large as they were taken for.
bool InteriorBuilder::choose(Contour contour, std::uint32_t count) {
  chosen_.count = count;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t disc = coverage_.choose();
    chosen_.x[k] = candidates_.x[disc];
    chosen_.y[k] = candidates_.y[disc];
  }
  nearest_touches(*loops_, corners(), chosen_, nearest_);
  samples_.largest_discs(*loops_, nearest_, corners(), chosen_);
  stored_.count = count;
  for (std::uint32_t k = 0; k < count; ++k) {
    stored_.x[k] = static_cast<float>(frame_.x + static_cast<double>(chosen_.x[k]) * frame_.cell);
    stored_.y[k] = static_cast<float>(frame_.y + static_cast<double>(chosen_.y[k]) * frame_.cell);
  }
  measure_depths(*loops_, contour, stored_, depths_);
  bool all_sound = true;
  for (std::uint32_t k = 0; k < count; ++k) all_sound &= is_sound(chosen_, k, frame_.cell);
  return all_sound;
}

bool InteriorBuilder::is_sound(const CandidateDiscs& discs, std::uint32_t k, double unit) const {
  return is_inside(depths_.winding[k]) &&
         depths_.distance[k] > least_fraction * static_cast<double>(discs.radius[k]) * unit;
}

/// Candidates that are not sound are replaced by points of a grid, and all get the radii that they really have:
/// a contour with whiskers, or with corners closer than the samples, is worth it. Returns how many there are.
std::uint32_t InteriorBuilder::offer_measured() {
  constexpr std::uint32_t row = 8;
  constexpr float spacing = static_cast<float>(longer_side) / row;
  static_assert(row * row == max_touches);
  CandidateDiscs sound, grid;
  const auto keep = [&](const CandidateDiscs& discs, std::uint32_t k) {
    sound.x[sound.count] = discs.x[k], sound.y[sound.count] = discs.y[k];
    sound.radius[sound.count++] = static_cast<float>(depths_.distance[k]);
  };
  estimate_depths(*loops_, corners(), candidates_, depths_);
  for (std::uint32_t k = 0; k < max_touches; ++k) {
    if (is_sound(candidates_, k, 1)) {
      keep(candidates_, k);
      continue;
    }
    const std::uint32_t column = k % row, line = k / row;
    grid.x[grid.count] = dilation + spacing * (static_cast<float>(column) + 0.5f);
    grid.y[grid.count] = dilation + spacing * (static_cast<float>(line) + 0.5f);
    grid.radius[grid.count++] = 0;
  }
  estimate_depths(*loops_, corners(), grid, depths_);
  for (std::uint32_t k = 0; k < grid.count; ++k)
    if (is_sound(grid, k, 1)) keep(grid, k);
  candidates_ = sound;
  coverage_.offer(*loops_, candidates_, dilation);
  return candidates_.count;
}

Interior InteriorBuilder::build(const Outline& outline, double max_extent) {
  const Contour contour = largest_contour(outline);
  Interior result;
  result.x.fill(std::numeric_limits<float>::infinity());
  result.y.fill(0);
  result.radius.fill(0);
  set_extremes(*loops_, contour, result);

  frame_ = frame(contour);
  if (!(frame_.cell > 0)) return result;
  to_cells(contour);
  samples_.take(x_, y_);
  samples_.largest_discs(*loops_, samples_.touches(), {}, candidates_);
  coverage_.offer(*loops_, candidates_, dilation);
  if (!choose(contour, block_width)) choose(contour, std::min(block_width, offer_measured()));

  std::uint32_t discs = 0;
  for (std::uint32_t k = 0; k < chosen_.count; ++k) {
    const double radius = depths_.distance[k] * (1 - 0x1p-23) - rounding::query_margin * max_extent;
    if (!(is_inside(depths_.winding[k]) && radius > 0)) continue;
    result.x[discs] = stored_.x[k], result.y[discs] = stored_.y[k];
    result.radius[discs++] = static_cast<float>(radius);
  }
  return result;
}

Interior interior(const Outline& outline, double max_extent) {
  return InteriorBuilder().build(outline, max_extent);
}

}  // namespace bch::detail
