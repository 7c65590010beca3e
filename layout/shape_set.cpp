// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/enclosing_disc.hpp"
#include "layout/enclosure.hpp"
#include "layout/interior.hpp"
#include "layout/rounding.hpp"
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
  Flattener flattener;
  WideTree tree;
  InteriorBuilder interiors;
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    const auto& [outline, hierarchy] = shapes[s];
    if (hierarchy.nodes.empty())
      throw std::invalid_argument("shape set: shape " + std::to_string(s) + " has no nodes");
    reach_.push_back(rounding::round_up(hierarchy.reach));
    flattener.begin(hierarchy);
    for (const std::uint32_t depth : plan.depths) {
      flattener.flatten(depth, tree);
      add_level(tree);
      if (!plan.shortcuts) continue;
      const Supports heights = flattener.supports();
      support_.insert(support_.end(), heights.begin(), heights.end());
    }
    if (plan.solid) add_outline(outline);
    if (plan.shortcuts && plan.depths.back() > 0) add_interior(outline, hierarchy.reach, interiors);
  }
  // Single discs need blocks only to meet those that are not.
  if (std::all_of(roots_.begin(), roots_.end(), [](const Root& root) { return root.is_single == 1; })) {
    trees_ = {}, nodes_ = {}, support_ = {}, inscribed_ = {}, extremes_ = {}, enclosures_ = {};
  } else {
    nodes_.resize(nodes_.size() + block_floats);  // kernels read a window's "children", and forget them
  }
}

void ShapeSet::add_level(const WideTree& tree) {
  const std::size_t first_block = (nodes_.size() + 15) / 16 * 16, count = tree.x.size();
  const std::size_t first_disc = first_block + tree.blocks.size() * block_floats;
  if (first_disc + 3 * count + block_floats >= leaf_window)
    throw std::length_error("shape set: more than 2^31 numbers in nodes");
  const auto name = [&](std::uint32_t local) {
    return static_cast<std::uint32_t>(local & leaf_window ? local + first_disc
                                                          : first_block + local * block_floats);
  };
  roots_.push_back({tree.root.x, tree.root.y, tree.root.radius, tree.is_single});
  has_single_discs_ |= tree.is_single;
  trees_.push_back({name(tree.top), static_cast<std::uint32_t>(count)});

  nodes_.resize(first_block);
  for (const WideTree::Block& block : tree.blocks) {
    for (const float* field : {block.discs.x, block.discs.y, block.discs.radius})
      nodes_.insert(nodes_.end(), field, field + block_width);
    for (const std::uint32_t child : block.child) nodes_.push_back(std::bit_cast<float>(name(child)));
  }
  for (const std::vector<float>* field : {&tree.x, &tree.y, &tree.radius})
    nodes_.insert(nodes_.end(), field->begin(), field->end());
}

/// A shape without an outline has no inscribed discs: padding, which overlaps nothing.
void ShapeSet::add_interior(const Outline& outline, double reach, InteriorBuilder& builder) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Interior inside{};
  Enclosure around{0, 0, infinity, -infinity};
  inside.x.fill(infinity);
  if (outline.contours() > 0) {
    validate(outline);
    inside = builder.build(outline, reach);
    around = enclosure(outline, reach);
  }
  enclosures_.push_back(around);
  DiscBlock& discs = inscribed_.emplace_back();
  std::copy(inside.x.begin(), inside.x.end(), discs.x);
  std::copy(inside.y.begin(), inside.y.end(), discs.y);
  std::copy(inside.radius.begin(), inside.radius.end(), discs.radius);
  Extremes& extremes = extremes_.emplace_back();
  std::copy(inside.extreme_x.begin(), inside.extreme_x.end(), extremes.x);
  std::copy(inside.extreme_y.begin(), inside.extreme_y.end(), extremes.y);
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
          .has_single_discs = has_single_discs_,
          .roots = roots_.data(),
          .trees = trees_.data(),
          .nodes = nodes_.data(),
          .reach = reach_.data(),
          .support = support_.empty() ? nullptr : support_.data(),
          .inscribed = inscribed_.empty() ? nullptr : inscribed_.data(),
          .extremes = extremes_.data(),
          .enclosures = enclosures_.data(),
          .shape_contours = shape_contours_.data(),
          .contour_points = contour_points_.data(),
          .contour_disc = contour_disc_.data(),
          .points = points_.data()};
}

std::size_t ShapeSet::bytes() const noexcept {
  const auto total = [](const auto&... vectors) { return (bytes_of(vectors) + ...); };
  return total(roots_, trees_, nodes_, reach_, support_, inscribed_, extremes_, enclosures_, shape_contours_,
               contour_points_, contour_disc_, points_);
}

}  // namespace bch
