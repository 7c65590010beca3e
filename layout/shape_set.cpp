// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "layout/enclosing_disc.hpp"
#include "layout/enclosure.hpp"
#include "layout/interior.hpp"
#include "layout/rounding.hpp"
#include "layout/shape_set_builder.hpp"

namespace bch {
namespace {

void require(const ShapeSetPlan& plan) {
  if (plan.depths.empty()) throw std::invalid_argument("shape set: the plan names no depths");
  if (plan.depths.size() > 255) throw std::invalid_argument("shape set: more than 255 levels");
  for (std::size_t i = 1; i < plan.depths.size(); ++i)
    if (plan.depths[i] <= plan.depths[i - 1])
      throw std::invalid_argument("shape set: depth " + std::to_string(plan.depths[i]) + " does not ascend");
}

bool is_single(const Root& root) {
  return root.is_single == 1;
}

ShapeSet build(std::span<const Shape> shapes, const ShapeSetPlan& plan) {
  ShapeFlattener flattener(plan);
  ShapeSetBuilder builder(plan);
  FlatShape flat;
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    flattener.flatten(shapes[s], s, flat);
    builder.add(flat);
  }
  return std::move(builder).finish();
}

}  // namespace

ShapeFlattener::ShapeFlattener(const ShapeSetPlan& plan) : plan_(plan) {
  require(plan);
}

void ShapeFlattener::flatten(const Shape& shape, std::size_t index, FlatShape& flat) {
  if (shape.hierarchy.nodes.empty())
    throw std::invalid_argument("shape set: shape " + std::to_string(index) + " has no nodes");
  flat.reach = shape.hierarchy.reach;
  flat.levels.resize(plan_.depths.size());
  flat.supports.resize(plan_.shortcuts ? plan_.depths.size() : 0);
  flattener_.begin(shape.hierarchy);
  for (std::size_t k = 0; k < plan_.depths.size(); ++k) {
    flattener_.flatten(plan_.depths[k], flat.levels[k]);
    if (plan_.shortcuts) flat.supports[k] = flattener_.supports();
  }
  if (plan_.solid) add_outline(shape.outline, flat);
  if (plan_.shortcuts && plan_.depths.back() > 0) add_interior(shape, flat);
}

/// A shape without an outline has no inscribed discs: padding, which overlaps nothing.
void ShapeFlattener::add_interior(const Shape& shape, FlatShape& flat) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  flat.interior = {};
  flat.enclosure = {0, 0, infinity, -infinity};
  flat.interior.x.fill(infinity);
  if (shape.outline.contours() == 0) return;
  validate(shape.outline);
  flat.interior = interiors_.build(shape.outline, shape.hierarchy.reach);
  flat.enclosure = enclosure(shape.outline, shape.hierarchy.reach);
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

ShapeSetBuilder::ShapeSetBuilder(const ShapeSetPlan& plan)
    : plan_(plan), depths_(plan.depths.begin(), plan.depths.end()) {
  require(plan);
  if (plan.solid) shape_contours_.push_back(0), contour_points_.push_back(0);
}

void ShapeSetBuilder::add(const FlatShape& flat) {
  if (roots_.size() + plan_.depths.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("shape set: more than 2^32 roots");
  reach_.push_back(rounding::round_up(flat.reach));
  for (const WideTree& tree : flat.levels) add_level(tree);
  for (const Supports& heights : flat.supports)
    support_.insert(support_.end(), heights.begin(), heights.end());
  if (plan_.solid) add_outline(flat);
  if (plan_.shortcuts && plan_.depths.back() > 0) add_interior(flat);
}

void ShapeSetBuilder::add_level(const WideTree& tree) {
  const std::size_t first_block = (nodes_.size() + 15) / 16 * 16, count = tree.x.size();
  const std::size_t first_disc = first_block + tree.blocks.size() * block_floats;
  if (first_disc + 3 * count + block_floats >= leaf_window)
    throw std::length_error("shape set: more than 2^31 numbers in nodes");
  const auto name = [&](std::uint32_t local) {
    return static_cast<std::uint32_t>(local & leaf_window ? local + first_disc
                                                          : first_block + local * block_floats);
  };
  roots_.push_back({tree.root.x, tree.root.y, tree.root.radius, tree.is_single});
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

void ShapeSetBuilder::add_interior(const FlatShape& flat) {
  const Interior& inside = flat.interior;
  enclosures_.push_back(flat.enclosure);
  DiscBlock& discs = inscribed_.emplace_back();
  std::copy(inside.x.begin(), inside.x.end(), discs.x);
  std::copy(inside.y.begin(), inside.y.end(), discs.y);
  std::copy(inside.radius.begin(), inside.radius.end(), discs.radius);
  Extremes& extremes = extremes_.emplace_back();
  std::copy(inside.extreme_x.begin(), inside.extreme_x.end(), extremes.x);
  std::copy(inside.extreme_y.begin(), inside.extreme_y.end(), extremes.y);
}

void ShapeSetBuilder::add_outline(const FlatShape& flat) {
  const Outline& outline = flat.outline;
  const auto before = static_cast<std::uint32_t>(points_.size());
  points_.insert(points_.end(), outline.points.begin(), outline.points.end());
  for (std::size_t c = 0; c < outline.contours(); ++c)
    contour_points_.push_back(before + outline.contour_begin[c + 1]);
  contour_disc_.insert(contour_disc_.end(), flat.contour_disc.begin(), flat.contour_disc.end());
  shape_contours_.push_back(static_cast<std::uint32_t>(contour_disc_.size()));
}

ShapeArrays ShapeSetBuilder::arrays() const {
  return {.depths = depths_,
          .roots = roots_,
          .trees = trees_,
          .nodes = nodes_,
          .reach = reach_,
          .support = support_,
          .inscribed = inscribed_,
          .extremes = extremes_,
          .enclosures = enclosures_,
          .shape_contours = shape_contours_,
          .contour_points = contour_points_,
          .contour_disc = contour_disc_,
          .points = points_};
}

ShapeSet ShapeSetBuilder::finish() && {
  // Single discs need blocks only to meet those that are not.
  if (std::all_of(roots_.begin(), roots_.end(), is_single)) {
    trees_ = {}, nodes_ = {}, support_ = {}, inscribed_ = {}, extremes_ = {}, enclosures_ = {};
  } else {
    nodes_.resize(nodes_.size() + block_floats);  // kernels read a window's "children", and forget them
  }
  const auto kept = std::make_shared<const ShapeSetBuilder>(std::move(*this));
  return ShapeSet(kept->arrays(), kept);
}

ShapeSet::ShapeSet(std::span<const Shape> shapes, const ShapeSetPlan& plan) : ShapeSet(build(shapes, plan)) {}

ShapeSet::ShapeSet(const ShapeArrays& arrays, std::shared_ptr<const void> memory)
    : arrays_(arrays),
      memory_(std::move(memory)),
      has_single_discs_(std::any_of(arrays.roots.begin(), arrays.roots.end(), is_single)) {}

ShapeSetView ShapeSet::view() const noexcept {
  return {.shape_count = shape_count(),
          .level_count = level_count(),
          .has_single_discs = has_single_discs_,
          .roots = arrays_.roots.data(),
          .trees = arrays_.trees.data(),
          .nodes = arrays_.nodes.data(),
          .reach = arrays_.reach.data(),
          .support = arrays_.support.empty() ? nullptr : arrays_.support.data(),
          .inscribed = arrays_.inscribed.empty() ? nullptr : arrays_.inscribed.data(),
          .extremes = arrays_.extremes.data(),
          .enclosures = arrays_.enclosures.data(),
          .shape_contours = arrays_.shape_contours.data(),
          .contour_points = arrays_.contour_points.data(),
          .contour_disc = arrays_.contour_disc.data(),
          .points = arrays_.points.data()};
}

std::size_t ShapeSet::bytes() const noexcept {
  const auto total = [](const auto&... spans) { return (spans.size_bytes() + ...); };
  return total(arrays_.roots, arrays_.trees, arrays_.nodes, arrays_.reach, arrays_.support, arrays_.inscribed,
               arrays_.extremes, arrays_.enclosures, arrays_.shape_contours, arrays_.contour_points,
               arrays_.contour_disc, arrays_.points);
}

}  // namespace bch
