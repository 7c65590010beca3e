// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/shapes.hpp>

#include <algorithm>
#include <utility>

#include "layout/base/floating_point_state.hpp"
#include "layout/shape_set/builder_mark.hpp"
#include "layout/shape_set/shape_flattener.hpp"
#include "layout/shape_set/shape_storage.hpp"

namespace bch {

using namespace detail;

namespace {

/// So many shapes say how large the others are.
constexpr std::size_t measured_shapes = 64;

/// Returns those of a set's arrays that a set of roots alone has.
ShapeArrays roots_of(const ShapeArrays& all) {
  ShapeArrays roots;
  roots.depths = all.depths, roots.roots = all.roots;
  roots.heights = all.heights;
  return roots;
}

}  // namespace

struct BuiltShape::State {
  ShapeFlattener flattener;
  FlatBody flat;
};

BuiltShape::BuiltShape(const ShapeSetPlan& plan) : state_(new State{ShapeFlattener(plan), {}}) {}
BuiltShape::BuiltShape(BuiltShape&&) noexcept = default;
BuiltShape& BuiltShape::operator=(BuiltShape&&) noexcept = default;
BuiltShape::~BuiltShape() = default;

void BuiltShape::prepare(const Shape& shape, std::size_t index) {
  const FloatingPointStateGuard floats;
  state_->flattener.flatten(shape, index, state_->flat);
}

FlatBody& BuiltShape::flat() noexcept {
  return state_->flat;
}

const FlatBody& BuiltShape::flat() const noexcept {
  return state_->flat;
}

struct ShapeSetBuilder::State {
  ShapeSetPlan plan;
  std::size_t expected_shapes;
  ShapeStorage storage;
  BuilderMark end = {};
  ShapeSet set = {ShapeArrays(), nullptr};  ///< stands on storage

  void add(const FlatBody& flat);
  void reserve();
  void rollback(const BuilderMark& to) noexcept;
  void close();
  bool roots_only() const;
  ShapeSet finish();
};

ShapeSetBuilder::ShapeSetBuilder(const ShapeSetPlan& plan, std::size_t expected_shapes)
    : state_(new State{plan, expected_shapes, {}}) {
  validate(plan);
  state_->storage.depths.assign(plan.depths.begin(), plan.depths.end());
}
ShapeSetBuilder::ShapeSetBuilder(ShapeSetBuilder&&) noexcept = default;
ShapeSetBuilder& ShapeSetBuilder::operator=(ShapeSetBuilder&&) noexcept = default;
ShapeSetBuilder::~ShapeSetBuilder() = default;

void ShapeSetBuilder::add(const BuiltShape& shape) {
  state_->add(shape.flat());
}

const ShapeSet& ShapeSetBuilder::set() {
  state_->close();
  const ShapeArrays all = state_->storage.arrays();
  state_->set.rebind(state_->roots_only() ? roots_of(all) : all);
  return state_->set;
}

ShapeSet ShapeSetBuilder::finish() && {
  return state_->finish();
}

std::span<const float> ShapeSetBuilder::nodes() const noexcept {
  const std::span<const float> all = state_->storage.nodes;
  return all.empty() ? all : all.first(state_->end.extent.nodes);
}

BuilderMark ShapeSetBuilder::mark() const noexcept {
  return state_->end;
}

void ShapeSetBuilder::rollback(const BuilderMark& to) noexcept {
  state_->rollback(to);
}

/// What throws leaves the end as it was.
void ShapeSetBuilder::State::add(const FlatBody& flat) {
  if (end.shapes == measured_shapes && expected_shapes > measured_shapes) reserve();
  storage.resize(plan, end.shapes + 1);
  const ShapeExtent size = extent_of(flat.shape);
  ShapeExtent at = end.extent;
  at.nodes = next_line(at.nodes);
  storage.allocate(at, size);
  storage.store(end.shapes, flat, at);
  ++end.shapes;
  for_each_part([](std::size_t& behind, std::size_t from, std::size_t length) { behind = from + length; },
                end.extent, at, size);
}

/// Makes room for all shapes, estimated from those so far, and a quarter. Room that is never written to takes
/// no memory.
void ShapeSetBuilder::State::reserve() {
  const std::size_t times = (expected_shapes * 5 / 4 + measured_shapes - 1) / measured_shapes;
  ShapeExtent all = end.extent;
  for_each_part([=](std::size_t& part) { part *= times; }, all);
  storage.reserve(plan, expected_shapes, all);
}

/// Every array gets shorter, so that what is added next finds zeros between shapes as behind those that stay.
void ShapeSetBuilder::State::rollback(const BuilderMark& to) noexcept {
  end = to;
  storage.shorten(end.extent);
  storage.resize(plan, end.shapes);
}

/// Makes the arrays end where the shapes do. An add() that threw may have left more.
void ShapeSetBuilder::State::close() {
  storage.resize(plan, end.shapes);
  storage.allocate(end.extent, {});
}

/// Single discs need blocks only to meet those that are not, and never contain what they do not overlap.
bool ShapeSetBuilder::State::roots_only() const {
  return std::all_of(storage.roots.begin(), storage.roots.end(),
                     [](const Root& root) { return root.row == single_disc; });
}

/// What throws leaves the shapes as they were: the arrays change hands at the end, and their elements stay where they are.
ShapeSet ShapeSetBuilder::State::finish() {
  close();
  const bool only_roots = roots_only();
  const auto kept = std::make_shared<ShapeStorage>();
  ShapeSet whole(only_roots ? roots_of(storage.arrays()) : storage.arrays(), kept);
  if (!only_roots) {
    *kept = std::move(storage);
    return whole;
  }
  kept->depths = std::move(storage.depths), kept->roots = std::move(storage.roots);
  kept->heights = std::move(storage.heights);
  return whole;
}

}  // namespace bch
