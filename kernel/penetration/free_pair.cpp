// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/penetration/free_pair.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/penetration/free_kernel.hpp"
#include "kernel/runtime/kernels.hpp"
#include "layout/base/rounding.hpp"
#include "layout/body/sphere_rounding.hpp"

namespace bch::detail {
namespace {

using Simd = BaseLanes;
using FreeBase = FreeKernel<BaseLanes>;

/// Adds the deepest two elements of two leaves, if they overlap.
void add_sample(const FreeTask& task, std::uint32_t leaf_a, std::uint32_t leaf_b, FreePair& to) {
  const FreeColumns &a = task.a.elements, &b = task.b.elements;
  float deepest = 0;
  std::uint32_t of_a = 0, of_b = 0;
  const std::uint32_t count = FreeBase::list_elements(task, leaf_a, leaf_b, 0);
  for (std::uint32_t slot = 0; slot < count; ++slot) {
    const std::uint32_t j = task.b.first(leaf_b) + task.slots[slot];
    for (std::uint32_t i = task.a.first(leaf_a); i < task.a.first(leaf_a + 1); ++i) {
      const float x = b.x[j] - a.x[i], y = b.y[j] - a.y[i], z = b.z[j] - a.z[i],
                  radius = a.radius[i] + b.radius[j];
      const float left = radius * radius - (x * x + y * y + z * z);
      if (left > deepest) deepest = left, of_a = i, of_b = j;
    }
  }
  if (deepest > 0) to.bound_by(to.a.element(of_a), to.b.element(of_b));
}

/// Calls use(i, j, low, high) for elements of A and B and their interval, of leaves that may_count(m, w, radius): B's is at m along the
/// direction and at w across it, as seen from A's, and the two overlap within the radius.
template <class Intervals, class MayCount, class Use>
void visit_intervals(const FreeTask& task, const MayCount& may_count, const Use& use) {
  const auto visit_row = [&](std::uint32_t first, std::uint32_t j) {
    const auto b = FreeBase::one(task.b.elements, j);
    for (std::uint32_t i = first; i < first + task.a.leaf_size; i += Simd::width) {
      const Intervals of(FreeBase::load(task.a.elements, i), b, task.margin);
      float low[Simd::width], high[Simd::width];
      Simd::store(low, of.low);
      Simd::store(high, Simd::select(of.are_some, of.high, Simd::Float(-__builtin_inff())));
      for (std::uint32_t lane = 0; lane < Simd::width; ++lane)
        if (low[lane] <= high[lane]) use(i + lane, j, low[lane], high[lane]);
    }
  };
  const FreeColumns &a = task.a.nodes, &b = task.b.nodes;
  for (std::uint32_t i = 0; i < task.a.leaves; ++i)
    for (std::uint32_t k = 0; k < task.b.leaves; ++k) {
      const float radius = a.radius[i] + b.radius[k] + task.node_slack, w = b.across[k] - a.across[i],
                  m = b.along[k] - a.along[i];
      if (w > radius || -w > radius || !may_count(m, w, radius)) continue;
      for (std::uint32_t j = task.b.first(k); j < task.b.first(k + 1); ++j) visit_row(task.a.first(i), j);
    }
}

template <class Intervals>
float find_after_gap(const FreeTask& task, float place) {
  float begin = __builtin_inff(), end = place;
  visit_intervals<Intervals>(
      task, [&](float m, float, float radius) { return m + radius >= place; },
      [&](std::uint32_t, std::uint32_t, float low, float high) {
        if (low >= place && low < begin) begin = low, end = high;
      });
  return end;
}

template <class Intervals>
FreeTouch find_touch(const FreeTask& task, float place) {
  float end = -__builtin_inff();
  std::uint32_t of_a = 0, of_b = 0;
  const auto keep_last = [&](std::uint32_t i, std::uint32_t j, float, float high) {
    if (high <= place && high > end) end = high, of_a = i, of_b = j;
  };
  const auto is_near = [&](float m, float w, float radius) {
    return (m - place) * (m - place) + w * w <= radius * radius;
  };
  visit_intervals<Intervals>(task, is_near, keep_last);
  // Most places are the end of an interval, of elements that are near there.
  if (end != place)
    visit_intervals<Intervals>(
        task, [&](float m, float, float radius) { return m - radius <= place && m + radius >= end; },
        keep_last);
  if (end == -__builtin_inff()) return {};
  return Intervals::touch(FreeBase::one(task.a.elements, of_a), FreeBase::one(task.b.elements, of_b), end,
                          task.margin);
}

}  // namespace

void FreeBody::begin(std::size_t elements, std::uint32_t leaf_size) {
  leaves_.leaf_size = leaf_size;
  leaves_.leaves = static_cast<std::uint32_t>((elements + leaf_size - 1) / leaf_size);
  size_ = nodes_ = 0;
  const std::size_t of_elements = leaves_.first(leaves_.leaves) + most_lanes,
                    of_nodes = leaves_.leaves + 1 + most_lanes;
  FreeColumns &e = leaves_.elements, &n = leaves_.nodes;
  float** const element_columns[] = {&e.x,      &e.y,     &e.z,      &e.radius,     &e.half_x,      &e.half_y,
                                     &e.half_z, &e.along, &e.across, &e.half_along, &e.half_across, &e.slope};
  float** const node_columns[] = {&n.x, &n.y, &n.z, &n.radius, &n.along, &n.across, &leaves_.top};
  memory_.resize(std::size(element_columns) * of_elements + std::size(node_columns) * of_nodes);
  float* at = memory_.data();
  for (float** const column : element_columns) *column = at, at += of_elements;
  for (float** const column : node_columns) *column = at, at += of_nodes;
}

void FreeBody::add(const FreeElement& element) noexcept {
  const FreeColumns& to = leaves_.elements;
  const std::uint32_t i = size_++;
  to.x[i] = element.x, to.y[i] = element.y, to.z[i] = element.z, to.radius[i] = element.radius;
  to.half_x[i] = element.half_x, to.half_y[i] = element.half_y, to.half_z[i] = element.half_z;
}

void FreeBody::add_node(const Cylinder& node) noexcept {
  const FreeColumns& to = leaves_.nodes;
  const std::uint32_t i = nodes_++;
  to.x[i] = static_cast<float>(node.x), to.y[i] = static_cast<float>(node.y);
  to.z[i] = static_cast<float>(node.bottom), leaves_.top[i] = static_cast<float>(node.top);
  to.radius[i] = static_cast<float>(node.radius);
}

void FreeBody::add_segments(const Kernels& kernels, const Vec2* points, std::uint32_t count,
                            const Transform& to_a) noexcept {
  kernels.free_place(points, count, to_a, leaves_.elements, size_);
  size_ += count;
}

void FreeBody::finish() noexcept {
  const FreeElement last = element(size_ - 1);
  // Registers reach beyond small leaves.
  const std::uint32_t end = leaves_.first(leaves_.leaves) + (leaves_.leaf_size < most_lanes ? most_lanes : 0);
  while (size_ < end) add(last);
  if (nodes_ == 0) FreeBase::make_nodes(leaves_);
}

FreeElement FreeBody::element(std::uint32_t i) const noexcept {
  const FreeColumns& of = leaves_.elements;
  return {of.x[i], of.y[i], of.z[i], of.radius[i], of.half_x[i], of.half_y[i], of.half_z[i]};
}

void FreePair::clear_bound() noexcept {
  bound_.count = 0;
  std::fill(std::begin(bound_.left), std::end(bound_.left), -1.0f);
}

void FreePair::bound_by(const FreeElement& of_a, const FreeElement& of_b) noexcept {
  const float z = of_b.z - of_a.z, radius = of_a.radius + of_b.radius;
  const std::uint32_t i = bound_.count++;
  bound_.x[i] = of_b.x - of_a.x, bound_.y[i] = of_b.y - of_a.y, bound_.left[i] = radius * radius - z * z;
}

void FreePair::begin(const Implementation& implementation, FreeKind kind, double margin, double max_extents) {
  // Nodes are floats, too, and their products.
  const double slack = margin + rounding::bound_margin * max_extents;
  kernels_ = implementation.kernels;
  task_.kind = kind, task_.margin = rounding::round_up(margin),
  task_.node_slack = rounding::round_up(slack + margin);
  a.finish(), b.finish();
  task_.a = a.leaves(), task_.b = b.leaves();
  for (std::uint32_t i = 0; i < a.size(); ++i) task_.a.elements.radius[i] += task_.margin;
  const std::size_t of_a = task_.a.leaves + most_lanes, of_b = task_.b.leaves + most_lanes;
  lists_.resize(of_a + of_b + task_.b.leaf_size + most_lanes);
  task_.leaves_a = lists_.data(), task_.leaves_b = task_.leaves_a + of_a, task_.slots = task_.leaves_b + of_b;
}

void FreePair::sample() {
  turn(1, 0);
  overlapping_.clear();
  FreeBase::visit(task_, 0, [&](std::uint32_t leaf_a, std::uint32_t leaf_b) {
    overlapping_.push_back({leaf_a, leaf_b});
  });
  const std::size_t step = overlapping_.size() / FreeBound::capacity + 1;
  for (std::size_t i = 0; i < overlapping_.size(); i += step)
    add_sample(task_, overlapping_[i].of_a, overlapping_[i].of_b, *this);
}

void FreePair::bound(float x, float y, float* places) const noexcept {
  kernels_->free_bound(bound_, x, y, places);
}

void FreePair::turn(float x, float y) noexcept {
  kernels_->free_turn(task_, x, y);
}

float FreePair::next(float place) noexcept {
  return kernels_->free_next(task_, place);
}

float FreePair::after_gap(float place) const {
  if (task_.kind == FreeKind::segments) return find_after_gap<FreeSegments<Simd>>(task_, place);
  if (task_.kind == FreeKind::walls) return find_after_gap<FreeWalls<Simd>>(task_, place);
  return find_after_gap<FreeSpheres<Simd>>(task_, place);
}

FreeTouch FreePair::touch(float place) const {
  if (task_.kind == FreeKind::segments) return find_touch<FreeSegments<Simd>>(task_, place);
  if (task_.kind == FreeKind::walls) return find_touch<FreeWalls<Simd>>(task_, place);
  return find_touch<FreeSpheres<Simd>>(task_, place);
}

}  // namespace bch::detail
