// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_set/shape_set_builder.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace bch {
namespace {

/// So many shapes say how large the others are.
constexpr std::size_t sample = 64;

}  // namespace

ShapeSetBuilder::ShapeSetBuilder(const ShapeSetPlan& plan, std::size_t expected_shapes)
    : plan_(plan), expected_shapes_(expected_shapes) {
  validate(plan);
  storage_.depths.assign(plan.depths.begin(), plan.depths.end());
}

void ShapeSetBuilder::add(const FlatShape& flat) {
  if (shapes_ == sample && expected_shapes_ > sample) reserve();
  const ShapeExtent size = extent_of(flat);
  ShapeExtent at = end_;
  at.nodes = next_line(end_.nodes);
  storage_.resize(plan_, shapes_ + 1);
  storage_.make_room(at, size);
  storage_.put(shapes_++, flat, at);
  for_each_part([](std::size_t& end, std::size_t from, std::size_t length) { end = from + length; }, end_, at,
                size);
}

/// Makes room for all shapes, estimated from those so far, and a quarter. Room that is never written to takes
/// no memory.
void ShapeSetBuilder::reserve() {
  const std::size_t times = (expected_shapes_ * 5 / 4 + sample - 1) / sample;
  ShapeExtent all = end_;
  for_each_part([=](std::size_t& part) { part *= times; }, all);
  storage_.reserve(plan_, expected_shapes_, all);
}

std::span<const float> ShapeSetBuilder::nodes() const noexcept {
  const std::span<const float> all = storage_.nodes;
  return all.empty() ? all : all.first(end_.nodes);
}

ShapeSet ShapeSetBuilder::finish() && {
  // An add() that threw may have left more.
  storage_.resize(plan_, shapes_);
  storage_.make_room(end_, {});
  // Single discs need blocks only to meet those that are not, and never contain what they do not overlap.
  const auto is_single = [](const Root& root) { return root.row == single_disc; };
  if (std::all_of(storage_.roots.begin(), storage_.roots.end(), is_single)) {
    ShapeStorage roots_only;
    roots_only.depths = std::move(storage_.depths), roots_only.roots = std::move(storage_.roots);
    storage_ = std::move(roots_only);
  }
  const auto kept = std::make_shared<const ShapeStorage>(std::move(storage_));
  return ShapeSet(kept->arrays(), kept);
}

}  // namespace bch
