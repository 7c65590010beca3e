// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include <bch/shapes.hpp>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/contours.hpp"
#include "layout/format/cut_discs.hpp"
#include "layout/format/shape_arrays.hpp"

namespace bch {

using namespace detail;

namespace {

bool rows_follow_roots(std::span<const Root> roots) {
  bool in_order = true;
  for (std::size_t i = 0; i < roots.size(); ++i) in_order &= roots[i].row == first_row + i;
  return in_order;
}

ShapeSet build(std::span<const Shape> shapes, const ShapeSetPlan& plan) {
  const FloatingPointStateGuard floats;
  BuiltShape prepared(plan);
  ShapeSetBuilder builder(plan, shapes.size());
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    prepared.prepare(shapes[s], s);
    builder.add(prepared);
  }
  return std::move(builder).finish();
}

ShapeSetView view_of(const ShapeArrays& arrays) {
  ShapeSetView view{};
  view.shape_count = static_cast<std::uint32_t>(arrays.shape_count());
  view.level_count = static_cast<std::uint32_t>(arrays.depths.size());
  view.rows_follow_roots = rows_follow_roots(arrays.roots);
  // An empty section of a file has an address as well.
  for_each_array(
      [](const char*, const auto& array, auto& data) { data = array.empty() ? nullptr : array.data(); },
      arrays, view);
  return view;
}

void require(bool is_there, const char* what, std::uint32_t index, std::uint32_t count) {
  if (!is_there)
    throw std::out_of_range(std::string("shape set: ") + what + " " + std::to_string(index) + " of " +
                            std::to_string(count));
}

}  // namespace

void validate(const ShapeSetPlan& plan) {
  if (plan.depths.empty()) throw std::invalid_argument("shape set: expected 1 to 255 depths, found none");
  if (plan.depths.size() > 255)
    throw std::invalid_argument("shape set: expected 1 to 255 depths, found " +
                                std::to_string(plan.depths.size()));
  for (std::size_t i = 1; i < plan.depths.size(); ++i)
    if (plan.depths[i] <= plan.depths[i - 1])
      throw std::invalid_argument("shape set: expected ascending depths, found " +
                                  std::to_string(plan.depths[i]) + " after " +
                                  std::to_string(plan.depths[i - 1]));
}

struct ShapeSet::State {
  ShapeArrays arrays;
  std::shared_ptr<const void> memory;
  ShapeSetView view;
};

ShapeSet::ShapeSet(std::span<const Shape> shapes, const ShapeSetPlan& plan) : ShapeSet(build(shapes, plan)) {}

ShapeSet::ShapeSet(const ShapeArrays& arrays, std::shared_ptr<const void> memory)
    : state_(new State{arrays, std::move(memory), view_of(arrays)}) {}

ShapeSet::ShapeSet(ShapeSet&&) noexcept = default;
ShapeSet& ShapeSet::operator=(ShapeSet&&) noexcept = default;
ShapeSet::~ShapeSet() = default;

void ShapeSet::rebind(const ShapeArrays& arrays) noexcept {
  *state_ = {arrays, nullptr, view_of(arrays)};
}

const ShapeSetView& ShapeSet::view() const noexcept {
  return state_->view;
}

const ShapeArrays& ShapeSet::arrays() const noexcept {
  return state_->arrays;
}

std::uint32_t ShapeSet::shape_count() const noexcept {
  return state_->view.shape_count;
}

std::span<const std::uint32_t> ShapeSet::depths() const noexcept {
  return state_->arrays.depths;
}

bool ShapeSet::has_heights() const noexcept {
  return !state_->arrays.heights.empty();
}

bool ShapeSet::exact_leaves() const noexcept {
  return !state_->arrays.leaf_segments.empty();
}

bool ShapeSet::roots_only() const noexcept {
  return state_->arrays.trees.empty();
}

ShapeSetPlan ShapeSet::plan() const {
  return {.depths = {depths().begin(), depths().end()},
          .outlines = !arrays().shape_contours.empty(),
          .culling = !arrays().support.empty(),
          .heights = has_heights()};
}

std::size_t ShapeSet::bytes() const noexcept {
  std::size_t all = 0;
  for_each_array([&](const char*, const auto& span) { all += span.size_bytes(); }, arrays());
  return all - depths().size_bytes();
}

std::vector<Disc> ShapeSet::discs(std::uint32_t shape, std::uint32_t level) const {
  require(shape < shape_count(), "shape", shape, shape_count());
  require(level < level_count(), "level", level, level_count());
  std::vector<Disc> discs;
  const CutDiscs cut = cut_discs(view(), shape * level_count() + level);
  for (std::uint32_t i = 0; i < cut.count; ++i) discs.push_back({cut.x[i], cut.y[i], cut.radius[i]});
  return discs;
}

float ShapeSet::bounding_radius(std::uint32_t shape) const {
  const FloatingPointStateGuard floats;
  require(shape < shape_count(), "shape", shape, shape_count());
  double farthest = 0;
  for (std::uint32_t level = 0; level < level_count(); ++level) {
    const CutDiscs cut = cut_discs(view(), shape * level_count() + level);
    for (std::uint32_t i = 0; i < cut.count; ++i)
      farthest = std::max(farthest, std::hypot(double{cut.x[i]}, double{cut.y[i]}) + double{cut.radius[i]});
  }
  return rounding::round_up(farthest * (1 + 0x1p-50));
}

}  // namespace bch
