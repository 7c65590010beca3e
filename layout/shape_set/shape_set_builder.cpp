// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/shape_set_builder.hpp>

#include <algorithm>
#include <utility>

#include "layout/shape_set/shape_flattener.hpp"
#include "layout/shape_set/shape_storage.hpp"

namespace bch {

using namespace detail;

namespace {

/// So many shapes say how large the others are.
constexpr std::size_t sample = 64;

}  // namespace

struct PreparedShape::State {
  ShapeFlattener flattener;
  FlatBody flat;
};

PreparedShape::PreparedShape(const ShapeSetPlan& plan) : state_(new State{ShapeFlattener(plan), {}}) {}
PreparedShape::PreparedShape(PreparedShape&&) noexcept = default;
PreparedShape& PreparedShape::operator=(PreparedShape&&) noexcept = default;
PreparedShape::~PreparedShape() = default;

void PreparedShape::prepare(const Shape& shape, std::size_t index) {
  state_->flattener.flatten(shape, index, state_->flat);
}

FlatBody& PreparedShape::flat() noexcept {
  return state_->flat;
}

const FlatBody& PreparedShape::flat() const noexcept {
  return state_->flat;
}

struct ShapeSetBuilder::State {
  ShapeSetPlan plan;
  std::size_t expected_shapes;
  ShapeStorage storage;
  std::size_t shapes = 0, parts = 0;
  ShapeExtent end{.rows = first_row};

  void add(const FlatBody& flat);
  void reserve();
  ShapeSet finish();
};

ShapeSetBuilder::ShapeSetBuilder(const ShapeSetPlan& plan, std::size_t expected_shapes)
    : state_(new State{plan, expected_shapes, {}}) {
  validate(plan);
  state_->storage.depths.assign(plan.depths.begin(), plan.depths.end());
  state_->storage.slices.assign(plan.slices.begin(), plan.slices.end());
}
ShapeSetBuilder::ShapeSetBuilder(ShapeSetBuilder&&) noexcept = default;
ShapeSetBuilder& ShapeSetBuilder::operator=(ShapeSetBuilder&&) noexcept = default;
ShapeSetBuilder::~ShapeSetBuilder() = default;

void ShapeSetBuilder::add(const PreparedShape& shape) {
  state_->add(shape.flat());
}

ShapeSet ShapeSetBuilder::finish() && {
  return state_->finish();
}

std::span<const float> ShapeSetBuilder::nodes() const noexcept {
  const std::span<const float> all = state_->storage.nodes;
  return all.empty() ? all : all.first(state_->end.nodes);
}

/// What throws leaves the counts and the end as they were.
void ShapeSetBuilder::State::add(const FlatBody& flat) {
  if (shapes == sample && expected_shapes > sample) reserve();
  storage.resize(plan, shapes + 1, parts + flat.part_count);
  ShapeExtent behind_all = end;
  for (std::size_t k = 0; k < flat.part_count; ++k) {
    const ShapeExtent size = extent_of(flat.parts[k]);
    ShapeExtent at = behind_all;
    at.nodes = next_line(at.nodes);
    storage.make_room(at, size);
    storage.put(parts + k, flat.parts[k], at);
    for_each_part([](std::size_t& behind, std::size_t from, std::size_t length) { behind = from + length; },
                  behind_all, at, size);
  }
  storage.put_slabs(shapes, parts, flat);
  end = behind_all;
  ++shapes, parts += flat.part_count;
}

/// Makes room for all shapes, estimated from those so far, and a quarter. Room that is never written to takes
/// no memory.
void ShapeSetBuilder::State::reserve() {
  const std::size_t times = (expected_shapes * 5 / 4 + sample - 1) / sample;
  ShapeExtent all = end;
  for_each_part([=](std::size_t& part) { part *= times; }, all);
  storage.reserve(plan, expected_shapes * parts / sample, all);
}

ShapeSet ShapeSetBuilder::State::finish() {
  // An add() that threw may have left more.
  storage.resize(plan, shapes, parts);
  storage.make_room(end, {});
  // Single discs need blocks only to meet those that are not, and never contain what they do not overlap.
  const auto is_single = [](const Root& root) { return root.row == single_disc; };
  if (std::all_of(storage.roots.begin(), storage.roots.end(), is_single)) {
    ShapeStorage roots_only;
    roots_only.depths = std::move(storage.depths), roots_only.roots = std::move(storage.roots);
    roots_only.slices = std::move(storage.slices), roots_only.slab_parts = std::move(storage.slab_parts);
    roots_only.heights = std::move(storage.heights);
    storage = std::move(roots_only);
  }
  const auto kept = std::make_shared<const ShapeStorage>(std::move(storage));
  return ShapeSet(kept->arrays(), kept);
}

}  // namespace bch
