// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/shape_set.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include "layout/shape_set/shape_set_builder.hpp"

namespace bch {
namespace {

bool rows_in_order(std::span<const Root> roots) {
  bool in_order = true;
  for (std::size_t i = 0; i < roots.size(); ++i) in_order &= roots[i].row == first_row + i;
  return in_order;
}

/// Single discs need no outlines: those that do not overlap cannot hold each other's.
bool is_solid(const ShapeArrays& arrays) {
  if (arrays.trees.empty()) return true;
  bool all = !arrays.shape_contours.empty();
  for (const ContourRange& contours : arrays.shape_contours) all &= contours.begin < contours.end;
  return all;
}

ShapeSet build(std::span<const Shape> shapes, const ShapeSetPlan& plan) {
  ShapeFlattener flattener(plan);
  ShapeSetBuilder builder(plan, shapes.size());
  FlatShape flat;
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    flattener.flatten(shapes[s], s, flat);
    builder.add(flat);
  }
  return std::move(builder).finish();
}

ShapeSetView view_of(const ShapeArrays& arrays) {
  // An empty section of a file has an address as well.
  const auto or_null = [](const auto& array) { return array.empty() ? nullptr : array.data(); };
  return {.shape_count = static_cast<std::uint32_t>(arrays.shape_count()),
          .level_count = static_cast<std::uint32_t>(arrays.depths.size()),
          .rows_in_order = rows_in_order(arrays.roots),
          .roots = or_null(arrays.roots),
          .trees = or_null(arrays.trees),
          .nodes = or_null(arrays.nodes),
          .reach = or_null(arrays.reach),
          .support = or_null(arrays.support),
          .inscribed = or_null(arrays.inscribed),
          .extremes = or_null(arrays.extremes),
          .profiles = or_null(arrays.profiles),
          .shape_contours = or_null(arrays.shape_contours),
          .contours = or_null(arrays.contours),
          .points = or_null(arrays.points),
          .leaf_segments = or_null(arrays.leaf_segments),
          .segment_margin = or_null(arrays.segment_margin)};
}

}  // namespace

void validate(const ShapeSetPlan& plan) {
  if (plan.depths.empty()) throw std::invalid_argument("shape set: the plan names no depths");
  if (plan.depths.size() > 255) throw std::invalid_argument("shape set: more than 255 levels");
  for (std::size_t i = 1; i < plan.depths.size(); ++i)
    if (plan.depths[i] <= plan.depths[i - 1])
      throw std::invalid_argument("shape set: depth " + std::to_string(plan.depths[i]) + " does not ascend");
}

ShapeSet::ShapeSet(std::span<const Shape> shapes, const ShapeSetPlan& plan) : ShapeSet(build(shapes, plan)) {}

ShapeSet::ShapeSet(const ShapeArrays& arrays, std::shared_ptr<const void> memory)
    : arrays_(arrays), memory_(std::move(memory)), view_(view_of(arrays)), solid_(is_solid(arrays)) {}

ShapeSetPlan ShapeSet::plan() const {
  return {.depths = {arrays_.depths.begin(), arrays_.depths.end()},
          .outlines = !arrays_.shape_contours.empty(),
          .culling = !arrays_.support.empty()};
}

std::size_t ShapeSet::bytes() const noexcept {
  std::size_t all = 0;
  for_each_array([&](const char*, const auto& span) { all += span.size_bytes(); }, arrays_);
  return all - arrays_.depths.size_bytes();
}

}  // namespace bch
