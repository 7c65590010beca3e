// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_flattener.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/enclosing_disc.hpp"
#include "layout/profile.hpp"
#include "layout/rounding.hpp"

namespace bch {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

}  // namespace

ShapeFlattener::ShapeFlattener(const ShapeSetPlan& plan) : plan_(plan) {
  validate(plan);
}

void ShapeFlattener::flatten(const Shape& shape, std::size_t index, FlatShape& flat) {
  require(shape, index);
  flat.plan = plan_;
  flat.reach = shape.hierarchy.reach;
  add_levels(shape, flat);
  if (plan_.solid) add_outline(shape.outline, flat);
}

void ShapeFlattener::require(const Shape& shape, std::size_t index) const {
  try {
    validate(shape.hierarchy);
    if (plan_.solid || (has_shortcuts() && shape.outline.contours() > 0)) validate(shape.outline);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("shape set: shape " + std::to_string(index) + ": " + error.what());
  }
}

bool ShapeFlattener::has_shortcuts() const {
  return plan_.shortcuts && plan_.depths.back() > 0;
}

void ShapeFlattener::add_levels(const Shape& shape, FlatShape& flat) {
  if (has_shortcuts()) add_interior(shape, flat);
  flat.levels.resize(plan_.depths.size());
  flattener_.begin(shape.hierarchy);
  for (std::size_t k = 0; k < plan_.depths.size(); ++k) {
    flattener_.flatten(plan_.depths[k], flat.levels[k]);
    if (has_shortcuts()) add_shortcuts(k, flat);
  }
}

/// A shape without an outline has no inscribed discs: padding, which overlaps nothing.
void ShapeFlattener::add_interior(const Shape& shape, FlatShape& flat) {
  flat.interior = {};
  flat.interior.x.fill(infinity);
  if (shape.outline.contours() > 0) flat.interior = interiors_.build(shape.outline, shape.hierarchy.reach);
  flat.profile = profile(shape.outline, flat.interior, shape.hierarchy.reach);
  for (Sector& sector : flat.profile.sectors) sector.shallow_outer = 0;
}

/// Of the level that was made flat last. Of single discs nobody asks.
void ShapeFlattener::add_shortcuts(std::size_t level, FlatShape& flat) const {
  const bool deepest = level + 1 == plan_.depths.size();
  if (flat.levels[level].is_single() && !deepest) return;
  const Outer outer = flattener_.outer(flat.profile);
  if (deepest) flat.supports = flattener_.supports();
  for (std::uint32_t k = 0; k < profile_sectors; ++k) {
    Sector& sector = flat.profile.sectors[k];
    float& limit = deepest ? sector.outer : sector.shallow_outer;
    limit = deepest ? outer[k] : std::max(limit, outer[k]);
  }
}

void ShapeFlattener::add_outline(const Outline& outline, FlatShape& flat) {
  flat.outline = outline;
  flat.contour_disc.clear();
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const EnclosingDisc disc = smallest_enclosing_disc(outline.contour(c));
    flat.contour_disc.push_back({disc.centre.x, disc.centre.y, rounding::round_up(disc.radius)});
  }
}

}  // namespace bch
