// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/body/space_frame.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Holds a sphere; a disc, whose z is 0; or a segment of an outline: the disc about it, and half of the way along it.
struct FreeElement {
  float x, y, z, radius;
  float half_x = 0, half_y = 0;
};

/// Holds what an agent is made of, in A's frame.
struct FreeBody {
  std::vector<FreeElement> elements;  ///< whole leaves, so that the last one may be there again
  std::vector<Cylinder> nodes;        ///< one around each leaf, and the last one around all
  std::uint32_t leaf_size = 8;        ///< a multiple of 4
};

/// Holds the places along a direction at which elements of A overlap elements of B, in the lanes where they do so anywhere. An element of
/// B is at m along the direction and at w across it, as seen from that of A.
struct FreeIntervals {
  using Simd = BaseLanes;
  using Float = Simd::Float;

  Float low, high;
  Simd::Mask are_some;

  Simd::Mask holding(Float place) const noexcept { return are_some & (low < place) & (place < high); }
};

/// Holds elements side by side, as FreeSearch has them.
struct FreeLanes {
  FreeIntervals::Float along, across, z, radius, half_along, half_across;
  FreeIntervals::Float
      slope;  ///< of a segment: along by across; 0 where it lies along the direction, to the margin
};

/// Holds where A touches an element of B, as seen from A's position, and a unit vector from B to A. Both are along a direction, across it,
/// and up.
struct FreeTouch {
  struct Vector {
    float along = 0, across = 0, up = 0;
  };
  Vector point, normal = {1, 0, 0};
};

/// Spheres, or discs. Let z be how much higher B's is, and r_A what its radius is with the margin:
///
///     R = r_A + r_B,    s = sqrt(R^2 - (w^2 + z^2)),    the two overlap at t  <=>  m - s < t < m + s
///
/// where s is real.
struct FreeSpheres : FreeIntervals {
  FreeSpheres(const FreeLanes& a, const FreeLanes& b, float margin) noexcept;
  /// Returns where two, each in all lanes, touch at the end of their interval.
  static FreeTouch touch(const FreeLanes& a, const FreeLanes& b, float end, float margin) noexcept;
};

/// Segments: what A's has to move by for the two to meet fills a parallelogram about (m, w), whose sides are the segments. The interval is
/// that of its part within the margin of the line across = 0, and a margin longer at both ends. That part ends where its sides do, or
/// where they leave the strip. A side along the line, to the margin, counts as a whole.
struct FreeSegments : FreeIntervals {
  FreeSegments(const FreeLanes& a, const FreeLanes& b, float margin) noexcept;
  /// Returns where two touch: at the side of the parallelogram by which the line leaves it, or of two at a corner the one that is more
  /// across the line.
  static FreeTouch touch(const FreeLanes& a, const FreeLanes& b, float end, float margin) noexcept;
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
  /// Prepares bound(), by the deepest two elements of leaves that overlap.
  void sample();
  /// Returns a place that the answer along a direction, a unit vector of A's frame, is not before.
  float bound(float x, float y);
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
  static constexpr std::uint32_t max_samples = 64;

  /// Holds elements, or nodes as seen from above, and where they are along a direction and across it.
  struct Rounds {
    std::vector<float> x, y, z, radius, half_x, half_y, along, across, half_along, half_across, slope;
    void resize(std::size_t count);
    void set(std::size_t at, const FreeElement& element);
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
  /// Calls use(slot) for elements of a leaf of B that may overlap some of a leaf of A where A has moved.
  template <class Use>
  void visit_elements(std::uint32_t leaf_a, std::uint32_t leaf_b, float moved, const Use& use);
  /// Calls use(i, j, low, high) for elements of A and B and their interval, of leaves that may_count(m, w, radius): B's is at m along the
  /// direction and at w across it, as seen from A's, and the two overlap within the radius.
  template <class MayCount, class Use>
  void visit_intervals(const MayCount& may_count, const Use& use) const;
  /// Keeps the deepest two elements of two leaves for bound(), if they overlap.
  void keep_sample(std::uint32_t leaf_a, std::uint32_t leaf_b);
  /// Goes from a place to the ends of intervals of two leaves.
  float leave(std::uint32_t leaf_a, std::uint32_t leaf_b, float place);

  Body a_, b_;
  float margin_, node_slack_;
  std::vector<std::uint16_t> leaves_a_, leaves_b_, slots_;
  struct Leaves {
    std::uint32_t of_a, of_b;
  };
  std::vector<Leaves> overlapping_;
  Rounds sample_a_, sample_b_;
  std::uint32_t samples_;
};

}  // namespace bch::detail
