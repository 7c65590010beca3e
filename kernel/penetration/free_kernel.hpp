// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include <bch/geometry.hpp>

#include "kernel/penetration/free_intervals.hpp"
#include "kernel/penetration/free_task.hpp"
#include "kernel/simd/transform.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Finds how far A has to move along directions until no element of it overlaps one of B.
///
/// The answer is the least t >= 0 in no interval. It is an interval's end or 0, and does not depend on how intervals are found: from a
/// place in an interval the search goes to its end, as long as there is one. All is done in float, along and across a direction by the
/// products of each element with it.
template <class Simd>
class FreeKernel {
 public:
  /// Places the segments between consecutive points in A's frame; up to a register behind them may be written.
  static void place(const Vec2* points, std::uint32_t count, const Transform& to_a, const FreeColumns& to,
                    std::uint32_t first) noexcept {
    const auto in_a = to_a.in_lanes<Float>();
    const Float half(0.5f), none(0.0f);
    for (std::uint32_t i = 0; i < count; i += Simd::width) {
      std::uint32_t index[Simd::width];
      for (std::uint32_t lane = 0; lane < Simd::width; ++lane)
        index[lane] = i + lane < count ? i + lane : count - 1;
      Float ends[4];
      Simd::template load_records<2>(&points->x, index, ends);
      const auto from = in_a.apply(ends[0], ends[1]), end = in_a.apply(ends[2], ends[3]);
      const Float x = (end.x - from.x) * half, y = (end.y - from.y) * half;
      const std::uint32_t at = first + i;
      Simd::store(&to.x[at], (from.x + end.x) * half), Simd::store(&to.y[at], (from.y + end.y) * half);
      Simd::store(&to.half_x[at], x), Simd::store(&to.half_y[at], y);
      Simd::store(&to.radius[at], xsimd::sqrt(x * x + y * y));
      Simd::store(&to.z[at], none), Simd::store(&to.half_z[at], none);
    }
  }

  /// Makes nodes of any height around leaves, which are whole registers, and around all.
  static void make_nodes(const FreeLeaves& of) noexcept {
    constexpr float everywhere = 1e30f;
    const FreeColumns& nodes = of.nodes;
    for (std::uint32_t leaf = 0; leaf < of.leaves; ++leaf)
      make_node(of.elements, of.first(leaf), of.first(leaf + 1), nodes, leaf);
    for (std::uint32_t i = of.leaves, last = i - 1; i % Simd::width != 0; ++i)
      nodes.x[i] = nodes.x[last], nodes.y[i] = nodes.y[last], nodes.radius[i] = nodes.radius[last];
    make_node(nodes, 0, of.leaves, nodes, of.leaves);
    for (std::uint32_t i = 0; i <= of.leaves; ++i) nodes.z[i] = -everywhere, of.top[i] = everywhere;
  }

  /// Takes a direction, a unit vector of A's frame.
  static void turn(const FreeTask& task, float x, float y) noexcept {
    turn_body(task.a, task, x, y);
    turn_body(task.b, task, x, y);
  }

  /// Returns a later place that the answer is not before; or the same, which is the answer then.
  static float next(const FreeTask& task, float place) noexcept {
    if (task.kind == FreeKind::segments) return search<FreeSegments<Simd>>(task, place);
    if (task.kind == FreeKind::walls) return search<FreeWalls<Simd>>(task, place);
    return search<FreeSpheres<Simd>>(task, place);
  }

  /// Calls use(leaf of A, leaf of B) for leaves that may overlap where A has moved.
  template <class Use>
  [[gnu::always_inline]] static void visit(const FreeTask& task, float moved, const Use& use) noexcept {
    const FreeLeaves &a = task.a, &b = task.b;
    const std::uint32_t rows = list(a, b, b.leaves, -moved, task.node_slack, task.leaves_a);
    for (std::uint32_t i = 0; i < rows; ++i) {
      const std::uint32_t columns = list(b, a, task.leaves_a[i], moved, task.node_slack, task.leaves_b);
      for (std::uint32_t j = 0; j < columns; ++j) use(task.leaves_a[i], task.leaves_b[j]);
    }
  }

  /// Lists elements of a leaf of B that may overlap some of a leaf of A where A has moved, in slots. Returns: their number.
  static std::uint32_t list_elements(const FreeTask& task, std::uint32_t leaf_a, std::uint32_t leaf_b,
                                     float moved) noexcept {
    const FreeColumns& b = task.b.elements;
    const Float along(task.a.nodes.along[leaf_a] + moved), across(task.a.nodes.across[leaf_a]),
        radius(task.a.nodes.radius[leaf_a] + task.node_slack);
    const std::uint32_t first = task.b.first(leaf_b), size = task.b.leaf_size;
    std::uint32_t count = 0;
    for (std::uint32_t j = first; j < first + size; j += Simd::width) {
      const Float m = Simd::load(&b.along[j]) - along, w = Simd::load(&b.across[j]) - across,
                  r = Simd::load(&b.radius[j]) + radius;
      count += Simd::compress_indices(Simd::bits(m * m + w * w <= r * r), j - first, task.slots + count);
    }
    return without_beyond(task.slots, count, size);
  }

  static FreeLanes<Simd> load(const FreeColumns& of, std::uint32_t i) noexcept {
    return {Simd::load(&of.along[i]),  Simd::load(&of.across[i]),     Simd::load(&of.z[i]),
            Simd::load(&of.radius[i]), Simd::load(&of.half_along[i]), Simd::load(&of.half_across[i]),
            Simd::load(&of.half_z[i]), Simd::load(&of.slope[i])};
  }
  /// Loads one into all lanes.
  static FreeLanes<Simd> one(const FreeColumns& of, std::uint32_t i) noexcept {
    return {Float(of.along[i]),      Float(of.across[i]),      Float(of.z[i]),      Float(of.radius[i]),
            Float(of.half_along[i]), Float(of.half_across[i]), Float(of.half_z[i]), Float(of.slope[i])};
  }

  /// Writes the first place along a direction, and that along the opposite one, in none of the intervals.
  static void bound(const FreeBound& by, float x, float y, float* places) noexcept {
    constexpr std::uint32_t registers = FreeBound::capacity / Simd::width;
    Float low[registers], high[registers];
    const Float ex(x), ey(y), none(0.0f);
    const std::uint32_t used = (by.count + Simd::width - 1) / Simd::width;
    for (std::uint32_t k = 0; k < used; ++k) {
      const Float dx = Simd::load(by.x + k * Simd::width), dy = Simd::load(by.y + k * Simd::width);
      const Float m = dx * ex + dy * ey, w = dx * ey - dy * ex,
                  left = Simd::load(by.left + k * Simd::width) - w * w;
      const Float s = xsimd::sqrt(xsimd::max(left, none));
      low[k] = Simd::select(left > none, m - s, none), high[k] = Simd::select(left > none, m + s, none);
    }
    places[0] = first_gap(low, high, used);
    for (std::uint32_t k = 0; k < used; ++k) {
      const Float forward = high[k];
      high[k] = none - low[k], low[k] = none - forward;
    }
    places[1] = first_gap(low, high, used);
  }

 private:
  using Float = typename Simd::Float;

  static float largest(Float values) noexcept { return -Simd::least(-values); }

  /// Makes a node around elements, or other nodes, from first to end, in whole registers.
  static void make_node(const FreeColumns& of, std::uint32_t first, std::uint32_t end, const FreeColumns& to,
                        std::uint32_t node) noexcept {
    Float left = Simd::load(&of.x[first]), right = left, low = Simd::load(&of.y[first]), high = low;
    for (std::uint32_t i = first; i < end; i += Simd::width) {
      const Float x = Simd::load(&of.x[i]), y = Simd::load(&of.y[i]);
      left = xsimd::min(left, x), right = xsimd::max(right, x);
      low = xsimd::min(low, y), high = xsimd::max(high, y);
    }
    const float x = (Simd::least(left) + largest(right)) * 0.5f,
                y = (Simd::least(low) + largest(high)) * 0.5f;
    Float radius(0.0f);
    for (std::uint32_t i = first; i < end; i += Simd::width) {
      const Float dx = Simd::load(&of.x[i]) - Float(x), dy = Simd::load(&of.y[i]) - Float(y);
      radius = xsimd::max(radius, xsimd::sqrt(dx * dx + dy * dy) + Simd::load(&of.radius[i]));
    }
    to.x[node] = x, to.y[node] = y, to.radius[node] = largest(radius);
  }

  static float first_gap(const Float* low, const Float* high, std::uint32_t count) noexcept {
    for (float place = 0;;) {
      Float most(place);
      for (std::uint32_t k = 0; k < count; ++k)
        most = Simd::select(low[k] < most, xsimd::max(most, high[k]), most);
      const float next = largest(most);
      if (next == place) return place;
      place = next;
    }
  }

  static void turn_body(const FreeLeaves& body, const FreeTask& task, float x, float y) noexcept {
    turn_columns(body.nodes, body.leaves + 1, false, task.margin, x, y);
    // Registers reach beyond small leaves.
    const std::uint32_t reached = body.leaf_size < Simd::width ? Simd::width : body.leaf_size;
    turn_columns(body.elements, body.first(body.leaves - 1) + reached, task.kind != FreeKind::spheres,
                 task.margin, x, y);
  }
  static void turn_columns(const FreeColumns& of, std::uint32_t count, bool have_halves, float margin,
                           float x, float y) noexcept {
    const Float ex(x), ey(y);
    for (std::uint32_t i = 0; i < count; i += Simd::width) {
      const Float at_x = Simd::load(&of.x[i]), at_y = Simd::load(&of.y[i]);
      Simd::store(&of.along[i], at_x * ex + at_y * ey);
      Simd::store(&of.across[i], at_x * ey - at_y * ex);
      if (!have_halves) continue;
      const Float to_end_x = Simd::load(&of.half_x[i]), to_end_y = Simd::load(&of.half_y[i]);
      const Float a = to_end_x * ex + to_end_y * ey, w = to_end_x * ey - to_end_y * ex;
      Simd::store(&of.half_along[i], a);
      Simd::store(&of.half_across[i], w);
      Simd::store(&of.slope[i], Simd::select(xsimd::abs(w) > Float(margin), a / w, Float(0.0f)));
    }
  }

  /// Leaves out what the last register had beyond the end of a list.
  static std::uint32_t without_beyond(const std::uint16_t* list, std::uint32_t count,
                                      std::uint32_t end) noexcept {
    while (count != 0 && list[count - 1] >= end) --count;
    return count;
  }

  /// Lists the leaves of a body whose nodes come within the slack of a node of another one. `moved` is how far the other has moved.
  static std::uint32_t list(const FreeLeaves& of, const FreeLeaves& other, std::uint32_t node, float moved,
                            float slack, std::uint16_t* leaves) noexcept {
    const Float along(other.nodes.along[node] + moved), across(other.nodes.across[node]),
        radius(other.nodes.radius[node] + slack), bottom(other.nodes.z[node] - slack),
        top(other.top[node] + slack);
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < of.leaves; i += Simd::width) {
      const Float m = Simd::load(&of.nodes.along[i]) - along, w = Simd::load(&of.nodes.across[i]) - across,
                  r = Simd::load(&of.nodes.radius[i]) + radius;
      const auto near =
          (m * m + w * w <= r * r) & (Simd::load(&of.nodes.z[i]) <= top) & (bottom <= Simd::load(&of.top[i]));
      count += Simd::compress_indices(Simd::bits(near), i, leaves + count);
    }
    return without_beyond(leaves, count, of.leaves);
  }

  template <class Intervals>
  static float search(const FreeTask& task, float place) noexcept {
    visit(task, place, [&](std::uint32_t leaf_a, std::uint32_t leaf_b) {
      place = leave<Intervals>(task, leaf_a, leaf_b, place);
    });
    return place;
  }

  /// Goes from a place to the ends of intervals of two leaves.
  template <class Intervals>
  static float leave(const FreeTask& task, std::uint32_t leaf_a, std::uint32_t leaf_b, float place) noexcept {
    const FreeColumns &a = task.a.elements, &b = task.b.elements;
    const std::uint32_t first = task.a.first(leaf_a), end = task.a.first(leaf_a + 1),
                        count = list_elements(task, leaf_a, leaf_b, place);
    for (std::uint32_t slot = 0; slot < count; ++slot) {
      const FreeLanes<Simd> of_b = one(b, task.b.first(leaf_b) + task.slots[slot]);
      for (std::uint32_t i = first; i < end; i += Simd::width) {
        const FreeLanes<Simd> of_a = load(a, i);
        // Most are apart there, which is told sooner.
        if (Simd::bits(Intervals::may_hold(of_a, of_b, place, task.margin, task.node_slack)) == 0) continue;
        const Intervals of(of_a, of_b, task.margin);
        place = largest(Simd::select(of.holding(Float(place)), of.high, Float(place)));
      }
    }
    return place;
  }
};

}  // namespace bch::detail
