// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/enclosing_disc.hpp"
#include "layout/interior.hpp"
#include "layout/rounding.hpp"
#include "layout/supports.hpp"
#include "layout/wide_tree.hpp"

namespace bch {
namespace {

void require(const ShapeSetPlan& plan) {
  if (plan.depths.empty()) throw std::invalid_argument("shape set: the plan names no depths");
  if (plan.depths.size() > 255) throw std::invalid_argument("shape set: more than 255 levels");
  for (std::size_t i = 1; i < plan.depths.size(); ++i)
    if (plan.depths[i] <= plan.depths[i - 1])
      throw std::invalid_argument("shape set: depth " + std::to_string(plan.depths[i]) + " does not ascend");
}

template <class Vector>
std::size_t bytes_of(const Vector& vector) {
  return vector.size() * sizeof(typename Vector::value_type);
}

}  // namespace

ShapeSet::ShapeSet(std::span<const Shape> shapes, const ShapeSetPlan& plan) : depths_(plan.depths) {
  require(plan);
  if (shapes.size() * plan.depths.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("shape set: more than 2^32 roots");
  if (plan.solid) shape_contours_.push_back(0), contour_points_.push_back(0);
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    const auto& [outline, hierarchy] = shapes[s];
    if (hierarchy.nodes.empty())
      throw std::invalid_argument("shape set: shape " + std::to_string(s) + " has no nodes");
    reach_.push_back(rounding::round_up(hierarchy.reach));
    for (const std::uint32_t depth : plan.depths) add_level(hierarchy, depth, plan.shortcuts);
    if (plan.solid) add_outline(outline);
    if (plan.shortcuts && plan.depths.back() > 0) add_interior(outline, hierarchy.reach);
  }
  // Single discs need blocks only to meet those that are not.
  if (std::all_of(root_is_single_.begin(), root_is_single_.end(),
                  [](std::uint8_t single) { return single != 0; })) {
    x_ = {}, y_ = {}, radius_ = {}, first_child_ = {}, inner_count_ = {}, support_ = {};
    inscribed_x_ = {}, inscribed_y_ = {}, inscribed_radius_ = {}, extreme_x_ = {}, extreme_y_ = {};
    std::fill(root_block_.begin(), root_block_.end(), 0);
  }
}

void ShapeSet::add_level(const Hierarchy& hierarchy, std::uint32_t depth, bool shortcuts) {
  const WideTree tree = wide_tree(hierarchy, depth);
  const std::size_t base = inner_count_.size();
  if (base + tree.blocks.size() > std::numeric_limits<std::uint32_t>::max() / block_width)
    throw std::length_error("shape set: more than 2^29 blocks");
  root_x_.push_back(tree.root.x);
  root_y_.push_back(tree.root.y);
  root_radius_.push_back(tree.root.radius);
  root_block_.push_back(static_cast<std::uint32_t>(base));
  root_is_single_.push_back(tree.is_single ? 1 : 0);
  if (shortcuts) {
    std::vector<Disc> discs;
    for (const std::uint32_t node : cut(hierarchy, depth)) discs.push_back(hierarchy.nodes[node].disc);
    const Supports heights = supports(discs, hierarchy.reach);
    support_.insert(support_.end(), heights.begin(), heights.end());
  }
  for (const WideBlock& block : tree.blocks) {
    x_.insert(x_.end(), block.x.begin(), block.x.end());
    y_.insert(y_.end(), block.y.begin(), block.y.end());
    radius_.insert(radius_.end(), block.radius.begin(), block.radius.end());
    first_child_.push_back(static_cast<std::uint32_t>(base) + block.first_child);
    inner_count_.push_back(block.inner_count);
  }
}

/// A shape without an outline has no inscribed discs: padding, which overlaps nothing.
void ShapeSet::add_interior(const Outline& outline, double reach) {
  Interior inside{};
  inside.x.fill(std::numeric_limits<float>::infinity());
  if (outline.contours() > 0) {
    validate(outline);
    inside = interior(outline, reach);
  }
  inscribed_x_.insert(inscribed_x_.end(), inside.x.begin(), inside.x.end());
  inscribed_y_.insert(inscribed_y_.end(), inside.y.begin(), inside.y.end());
  inscribed_radius_.insert(inscribed_radius_.end(), inside.radius.begin(), inside.radius.end());
  extreme_x_.insert(extreme_x_.end(), inside.extreme_x.begin(), inside.extreme_x.end());
  extreme_y_.insert(extreme_y_.end(), inside.extreme_y.begin(), inside.extreme_y.end());
}

void ShapeSet::add_outline(const Outline& outline) {
  validate(outline);
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto contour = outline.contour(c);
    const EnclosingDisc disc = smallest_enclosing_disc(contour);
    contour_disc_.push_back({disc.centre.x, disc.centre.y, rounding::round_up(disc.radius)});
    points_.insert(points_.end(), contour.begin(), contour.end());
    contour_points_.push_back(static_cast<std::uint32_t>(points_.size()));
  }
  shape_contours_.push_back(static_cast<std::uint32_t>(contour_disc_.size()));
}

ShapeSetView ShapeSet::view() const noexcept {
  return {.shape_count = shape_count(),
          .level_count = level_count(),
          .root_x = root_x_.data(),
          .root_y = root_y_.data(),
          .root_radius = root_radius_.data(),
          .root_block = root_block_.data(),
          .root_is_single = root_is_single_.data(),
          .support = support_.empty() ? nullptr : support_.data(),
          .x = x_.data(),
          .y = y_.data(),
          .radius = radius_.data(),
          .first_child = first_child_.data(),
          .inner_count = inner_count_.data(),
          .reach = reach_.data(),
          .inscribed_x = inscribed_x_.empty() ? nullptr : inscribed_x_.data(),
          .inscribed_y = inscribed_y_.data(),
          .inscribed_radius = inscribed_radius_.data(),
          .extreme_x = extreme_x_.data(),
          .extreme_y = extreme_y_.data(),
          .shape_contours = shape_contours_.data(),
          .contour_points = contour_points_.data(),
          .contour_disc = contour_disc_.data(),
          .points = points_.data()};
}

std::size_t ShapeSet::bytes() const noexcept {
  const auto total = [](const auto&... vectors) { return (bytes_of(vectors) + ...); };
  return total(root_x_, root_y_, root_radius_, root_block_, root_is_single_, support_, x_, y_, radius_,
               first_child_, inner_count_, reach_, inscribed_x_, inscribed_y_, inscribed_radius_, extreme_x_,
               extreme_y_, shape_contours_, contour_points_, contour_disc_, points_);
}

}  // namespace bch
