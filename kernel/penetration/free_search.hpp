// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernel/body/space_frame.hpp"
#include "layout/base/rounding.hpp"
#include "layout/body/body_record.hpp"
#include "layout/body/sphere_rounding.hpp"

namespace bch::detail {

/// Finds how far a body A has to move along directions until it is free of a body B: for one pair after the other, in memory of its own.
///
/// Along a direction e, in A's frame, let m and w be how far B's sphere is from A's along e and across it, z how much higher it is, and
///
///     R = (r_A + slack) + r_B,    s = sqrt(R^2 - (w^2 + z^2)),    the two overlap at t  <=>  m - s < t < m + s
///
/// where s is real, all in float, m and w from the products of each sphere with e. The answer is the least t >= 0 in no interval. It is an
/// interval's end or 0, and does not depend on how intervals are found: from a place in an interval the search goes to its end, as long
/// as there is one.
///
/// Sound, in units of u S: collide() of the displaced agents accepts spheres that are up to 30 apart (sphere_error). Products and their sums put
/// m and w off by 3 each, differences by 1 each, z by 1, so the distance by 7; rounding e to float turns A's way by 1.1 t and makes it shorter by
/// as much, and t <= 2 S, because |m| <= S and s <= R <= S: 4.4; m + s, its rounding and that of moved positions: 6. R^2 - h^2 is off by 3 u
/// R^2, as if R were by 1.5 u.
class FreeSearch {
 public:
  /// Takes a pair.
  void begin(const float* a, const float* b, const SpaceFrame& frame);
  /// Returns a place that the answer along a direction, a unit vector of A's frame, is not before.
  float bound(float x, float y);
  /// Takes a direction.
  void turn(float x, float y);
  /// Returns a later place that the answer is not before; or the same, which is the answer then.
  float next(float place);

 private:
  static constexpr double slack = 56 * rounding::unit_roundoff;
  static_assert(slack >= (rounding::terms::sphere_error + 7 + 4.4 + 6 + 1.5) * rounding::unit_roundoff);

  static constexpr std::uint32_t padding = 16;  ///< floats, at least a register
  static constexpr std::uint32_t max_leaves = max_spheres / 4, max_samples = 64;

  /// Holds spheres, or nodes as seen from above, and where they are along a direction and across it.
  template <std::uint32_t most>
  struct Rounds {
    std::array<float, most + padding> x, y, z, radius, along, across;
    void turn(float to_x, float to_y, std::uint32_t count);
  };

  /// Holds a body in A's frame.
  struct Body {
    std::uint32_t leaves, leaf_size;
    Rounds<max_spheres> spheres;
    Rounds<max_leaves> nodes;  ///< of the leaves, and behind them that of the whole; z is their bottom
    std::array<float, max_leaves + padding> top;

    /// Takes a record. `placed` takes nodes and spheres into the frame; radii of spheres grow by so much.
    template <class Placed>
    void take(const float* record, const Placed& placed, float grown);
    std::uint32_t first(std::uint32_t leaf) const { return leaf * leaf_size; }
    void turn(float x, float y);
  };

  /// Lists the leaves of a body whose nodes come within the slack of a node of another one. `moved` is how far the other has moved.
  std::uint32_t list(const Body& of, const Body& other, std::uint32_t node, float moved,
                     std::uint16_t* leaves) const;
  /// Calls use(leaf of A, leaf of B) for leaves that may overlap where A has moved.
  template <class Use>
  void visit(float moved, const Use& use);
  /// Calls use(slot) for spheres of a leaf of B that may overlap some of a leaf of A where A has moved.
  template <class Use>
  void visit_spheres(std::uint32_t leaf_a, std::uint32_t leaf_b, float moved, const Use& use) const;
  /// Keeps the deepest two spheres of two leaves for bound(), if they overlap.
  void keep_sample(std::uint32_t leaf_a, std::uint32_t leaf_b);
  /// Goes from a place to the ends of intervals of two leaves.
  float leave(std::uint32_t leaf_a, std::uint32_t leaf_b, float place) const;

  Body a_, b_;
  float node_slack_;
  std::array<std::uint16_t, max_leaves + padding> leaves_a_, leaves_b_;
  struct Leaves {
    std::uint32_t of_a, of_b;
  };
  std::vector<Leaves> overlapping_;
  Rounds<max_samples> sample_a_, sample_b_;
  std::uint32_t samples_;
};

}  // namespace bch::detail
