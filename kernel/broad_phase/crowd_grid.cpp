// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/broad_phase/crowd_grid.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/distance/clearance_terms.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"

namespace bch::detail {
namespace {

constexpr std::uint32_t cell_bits = 29;  ///< a cell of class 0 is 2^29 units wide
constexpr std::uint32_t class_bits = 2;  ///< each class has cells 2^2 times narrower

/// The least width of a cell divided by the crowd's extent, so that numbers of cells stay below 2^62.
constexpr double least_cell = 0x1p-30;
/// The largest radius in a cell divided by its width.
constexpr double radius_of_cell = 0.5 * (1 - 0x1p-10);
/// The rounding error of a centre relative to the crowd's corner, divided by the crowd's extent.
constexpr double centre_rounding = 0x1p-50;

/// By how much clearance() may be too small, with D up to the margin plus twice both extents: a fraction of
/// the margin plus a fraction of both extents. Each of two agents contributes half of it.
constexpr double fraction_of_margin = 0x1p-18, fraction_of_extent = 128 * rounding::unit_roundoff;
static_assert(2 * fraction_of_margin >= clearance_terms::short_of_distance * rounding::unit_roundoff);
static_assert(fraction_of_extent >=
              (clearance_terms::short_of_extent + 2 * clearance_terms::short_of_distance) *
                  rounding::unit_roundoff);
static_assert(fraction_of_extent >= rounding::terms::query_error * rounding::unit_roundoff,
              "what collide() may accept");

/// Returns the radius of a root disc, enlarged by half the margin and by more than clearance() may be too
/// small, which also covers the rounding of collide(). A shape's extent is at most that of its root disc. With
/// a margin, the disc contains all other discs, which may protrude from the smallest one.
double pruning_radius(const ShapeSetView& shapes, std::size_t root, double margin) {
  const auto [x, y, r, row] = shapes.roots[root];
  const bool has_outer = margin > 0 && shapes.trees != nullptr;
  const double radius = has_outer ? shapes.trees[root].outer_radius : r;
  const double max_extent = std::abs(static_cast<double>(x)) + std::abs(static_cast<double>(y)) + radius;
  return radius + fraction_of_extent * max_extent + (0.5 + fraction_of_margin) * margin;
}

struct PruningDisc {
  double x, y, radius;  ///< metres, in the shape's frame
};

/// Returns the enlarged root disc of an agent.
PruningDisc pruning_disc(const ShapeSetView& shapes, const Agents& agents, std::size_t agent, double margin) {
  const std::size_t root = agents.root(agent, shapes.level_count);
  return {static_cast<double>(shapes.roots[root].x), static_cast<double>(shapes.roots[root].y),
          pruning_radius(shapes, root, margin)};
}

}  // namespace

void CrowdBounds::add(const CrowdBounds& other) noexcept {
  min_x = std::min(min_x, other.min_x);
  max_x = std::max(max_x, other.max_x);
  min_y = std::min(min_y, other.min_y);
  max_y = std::max(max_y, other.max_y);
  offset = std::max(offset, other.offset);
  least_radius = std::min(least_radius, other.least_radius);
  max_radius = std::max(max_radius, other.max_radius);
}

CrowdBounds bounds(const ShapeSetView& shapes, const Agents& agents, double margin, std::size_t begin,
                   std::size_t end) noexcept {
  CrowdBounds all;
  for (std::size_t i = begin; i < end; ++i) {
    const auto [x, y, radius] = pruning_disc(shapes, agents, i, margin);
    const double offset = std::abs(x) + std::abs(y);
    all.add({agents.x[i], agents.x[i], agents.y[i], agents.y[i], offset, radius, radius});
  }
  return all;
}

CrowdGrid::CrowdGrid(const CrowdBounds& crowd) noexcept {
  // Rotation lengthens an offset by rounding; far from the origin, the rounding of the corner counts.
  const double margin =
      crowd.offset * (1 + 0x1p-20) + 0x1p-50 * std::max(std::abs(crowd.min_x), std::abs(crowd.min_y));
  corner_x_ = crowd.min_x - margin;
  corner_y_ = crowd.min_y - margin;
  const double width = crowd.max_x - corner_x_ + margin, height = crowd.max_y - corner_y_ + margin;
  const double extent = std::max(width, height), off_by = centre_rounding * extent;
  double cell = std::max((crowd.max_radius + off_by) / radius_of_cell, least_cell * extent);
  units_ = static_cast<double>(1u << cell_bits) / cell;
  slack_ = off_by + 2 / units_;

  const auto units_wide = static_cast<std::uint64_t>(width * units_);
  const auto units_high = static_cast<std::uint64_t>(height * units_);
  std::uint64_t end = 0;
  double max_radius = crowd.max_radius;
  do {
    const std::uint32_t shift = cell_bits - class_bits * class_count_;
    const std::uint64_t columns = (units_wide >> shift) + 2, rows = (units_high >> shift) + 2;
    const std::uint64_t stride = columns + 1, first = end + stride + 1;
    end = first + (rows + 1) * stride;
    classes_[class_count_++] = {max_radius, first, stride, end};
    cell /= 1u << class_bits;
    max_radius = cell * radius_of_cell - off_by;
  } while (class_count_ < max_classes && cell >= least_cell * extent && max_radius >= crowd.least_radius);
}

void CrowdGrid::place(const ShapeSetView& shapes, const Agents& agents, double margin, std::size_t begin,
                      std::size_t end, GridDisc* discs) const noexcept {
  for (std::size_t i = begin; i < end; ++i) {
    const auto [x, y, radius] = pruning_disc(shapes, agents, i, margin);
    const Rotation turn = rotation(agents.heading[i]);
    const double offset_x = turn.cosine * x - turn.sine * y, offset_y = turn.sine * x + turn.cosine * y;
    // The corner is subtracted first: far from the origin, position + offset would lose the offset.
    const auto at_x = static_cast<std::uint64_t>(((agents.x[i] - corner_x_) + offset_x) * units_);
    const auto at_y = static_cast<std::uint64_t>(((agents.y[i] - corner_y_) + offset_y) * units_);
    std::uint32_t c = class_count_ - 1;
    while (radius > classes_[c].max_radius) --c;
    const std::uint32_t shift = cell_bits - class_bits * c;
    // No rounding up, which takes an unpredictable branch: 2^-20 includes the rounding to float.
    discs[i] = {classes_[c].first + (at_y >> shift) * classes_[c].stride + (at_x >> shift),
                static_cast<std::uint32_t>(at_x), static_cast<std::uint32_t>(at_y),
                static_cast<float>((radius + slack_) * units_ * (1 + 0x1p-20)),
                static_cast<std::uint32_t>(i)};
  }
}

std::uint64_t CrowdGrid::coarser(std::uint64_t cell, std::uint32_t from, std::uint32_t to) const noexcept {
  const std::uint64_t at = cell - classes_[from].first;
  const std::uint32_t shift = class_bits * (from - to);
  const std::uint64_t row = (at / classes_[from].stride) >> shift;
  const std::uint64_t column = (at % classes_[from].stride) >> shift;
  return classes_[to].first + row * classes_[to].stride + column;
}

}  // namespace bch::detail
