// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/body/space_frame.hpp"
#include "kernel/penetration/free_intervals.hpp"

namespace bch::detail {

/// Holds what an agent is made of, in A's frame.
struct FreeBody {
  std::vector<FreeElement> elements;  ///< whole leaves, so that the last one may be there again
  std::vector<Cylinder> nodes;        ///< one around each leaf, and the last one around all
  std::uint32_t leaf_size = 8;        ///< a multiple of 4
};

/// Bounds places by the intervals of some spheres, or discs.
class FreeBound {
 public:
  static constexpr std::uint32_t capacity = 64;

  void clear() noexcept { count_ = 0; }
  void add(const FreeElement& a, const FreeElement& b) noexcept;
  /// Returns the first place along a direction, a unit vector of A's frame, that is in none of the intervals.
  float place(float x, float y) const noexcept;

 private:
  using Simd = FreeIntervals::Simd;
  using Float = FreeIntervals::Float;
  static constexpr std::uint32_t registers = capacity / Simd::width;

  std::uint32_t count_ = 0;
  alignas(64) float x_[capacity + Simd::width], y_[capacity + Simd::width], left_[capacity + Simd::width];
};

/// Finds how far A has to move along directions until no element of it overlaps one of B: for one pair after the other, in memory of its own.
///
/// The answer is the least t >= 0 in no interval. It is an interval's end or 0, and does not depend on how intervals are found: from a
/// place in an interval the search goes to its end, as long as there is one. All is done in float, along and across a direction by the
/// products of each element with it.
template <class Intervals>
class FreeSearch {
 public:
  /// Takes a pair. Nodes come within the slack of each other where elements come within the margin.
  void begin(const FreeBody& a, const FreeBody& b, float margin, float slack);
  /// Adds the deepest two elements of leaves that overlap, of some.
  void sample(FreeBound& to);
  /// Takes a direction.
  void turn(float x, float y);
  /// Returns a later place that the answer is not before; or the same, which is the answer then.
  float next(float place);
  /// Returns the end of the interval that begins next from a place in none on; or the same, where no more begins.
  float after_gap(float place) const;
  /// Returns where the elements touch whose interval is the last one to end on the way to a place in none.
  FreeTouch touch(float place) const;

 private:
  using Simd = FreeIntervals::Simd;
  using Float = FreeIntervals::Float;
  static constexpr std::uint32_t padding = 16;  ///< floats, at least a register

  /// Holds elements, or nodes as seen from above, and where they are along a direction and across it.
  struct Rounds {
    float *x, *y, *z, *radius, *half_x, *half_y, *half_z, *along, *across, *half_along, *half_across, *slope;
    std::vector<float> memory;
    Rounds() = default;
    Rounds(Rounds&&) noexcept = default;
    Rounds& operator=(Rounds&&) noexcept = default;
    void resize(std::size_t count);
    void set(std::size_t at, const FreeElement& element);
    FreeElement element(std::uint32_t i) const;
    void turn(float to_x, float to_y, std::uint32_t count, float margin);
    FreeLanes load(std::uint32_t i) const noexcept;
    FreeLanes one(std::uint32_t i) const noexcept;  ///< in all lanes
  };

  struct Body {
    std::uint32_t leaves, leaf_size;
    Rounds elements;
    Rounds nodes;  ///< of the leaves, and behind them that of the whole; z is their bottom
    std::vector<float> top;

    void take(const FreeBody& body, float grown);
    std::uint32_t first(std::uint32_t leaf) const { return leaf * leaf_size; }
    void turn(float x, float y, float margin);
  };

  /// Lists the leaves of a body whose nodes come within the slack of a node of another one. `moved` is how far the other has moved.
  std::uint32_t list(const Body& of, const Body& other, std::uint32_t node, float moved,
                     std::uint16_t* leaves) const;
  /// Calls use(leaf of A, leaf of B) for leaves that may overlap where A has moved.
  template <class Use>
  void visit(float moved, const Use& use);
  /// Lists elements of a leaf of B that may overlap some of a leaf of A where A has moved, in slots_. Returns: their number.
  std::uint32_t list_elements(std::uint32_t leaf_a, std::uint32_t leaf_b, float moved);
  /// Calls use(i, j, low, high) for elements of A and B and their interval, of leaves that may_count(m, w, radius): B's is at m along the
  /// direction and at w across it, as seen from A's, and the two overlap within the radius.
  template <class MayCount, class Use>
  void visit_intervals(const MayCount& may_count, const Use& use) const;
  /// Adds the deepest two elements of two leaves, if they overlap.
  void add_sample(std::uint32_t leaf_a, std::uint32_t leaf_b, FreeBound& to);
  /// Goes from a place to the ends of intervals of two leaves.
  float leave(std::uint32_t leaf_a, std::uint32_t leaf_b, float place);
  /// Goes from a place to the ends of intervals of elements of A, from i on, and one of B.
  float leave_lanes(std::uint32_t i, std::uint32_t j, float place) const;

  Body a_, b_;
  float margin_, node_slack_;
  std::vector<std::uint16_t> leaves_a_, leaves_b_, slots_;
  struct Leaves {
    std::uint32_t of_a, of_b;
  };
  std::vector<Leaves> overlapping_;
};

}  // namespace bch::detail
