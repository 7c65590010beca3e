// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_flattener.hpp"

#include <limits>
#include <stdexcept>
#include <string>

#include "layout/enclosing_disc.hpp"
#include "layout/profile.hpp"
#include "layout/rounding.hpp"

namespace bch {

ShapeFlattener::ShapeFlattener(const ShapeSetPlan& plan) : plan_(plan) {
  validate(plan);
}

void ShapeFlattener::flatten(const Shape& shape, std::size_t index, FlatShape& flat) {
  if (shape.hierarchy.nodes.empty())
    throw std::invalid_argument("shape set: shape " + std::to_string(index) + " has no nodes");
  flat.plan = plan_;
  flat.reach = shape.hierarchy.reach;
  add_levels(shape, flat);
  if (plan_.solid) add_outline(shape.outline, flat);
}

void ShapeFlattener::add_levels(const Shape& shape, FlatShape& flat) {
  const bool shortcuts = plan_.shortcuts && plan_.depths.back() > 0;
  flat.levels.resize(plan_.depths.size());
  flat.profiles.resize(shortcuts ? plan_.depths.size() : 0);
  flat.supports.clear();
  const Profile inside = shortcuts ? add_interior(shape, flat) : Profile{};
  flattener_.begin(shape.hierarchy);
  for (std::size_t k = 0; k < plan_.depths.size(); ++k) {
    flattener_.flatten(plan_.depths[k], flat.levels[k]);
    if (!shortcuts) continue;
    if (!flat.levels[k].is_single) flat.supports.push_back(flattener_.supports());
    flat.profiles[k] = inside;
    flattener_.set_outer(flat.profiles[k]);
  }
}

/// A shape without an outline has no inscribed discs: padding, which overlaps nothing.
/// Returns: the profile of what is the same in every cut.
Profile ShapeFlattener::add_interior(const Shape& shape, FlatShape& flat) {
  flat.interior = {};
  flat.interior.x.fill(std::numeric_limits<float>::infinity());
  if (shape.outline.contours() > 0) {
    validate(shape.outline);
    flat.interior = interiors_.build(shape.outline, shape.hierarchy.reach);
  }
  return profile(shape.outline, flat.interior, shape.hierarchy.reach);
}

void ShapeFlattener::add_outline(const Outline& outline, FlatShape& flat) {
  validate(outline);
  flat.outline = outline;
  flat.contour_disc.clear();
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const EnclosingDisc disc = smallest_enclosing_disc(outline.contour(c));
    flat.contour_disc.push_back({disc.centre.x, disc.centre.y, rounding::round_up(disc.radius)});
  }
}

}  // namespace bch
