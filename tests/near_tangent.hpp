// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include "baselines/exact_discs.hpp"
#include "layout/rounding.hpp"
#include "layout/shape_set.hpp"
#include "tests/scenes.hpp"

namespace bch::test {

/// A shape as it stands at a heading, with the exact discs of its cut at a level.
struct PosedShape {
  std::uint32_t shape;
  std::uint8_t level;
  double heading, reach;
  baselines::QuadVector rotation;  ///< by the heading
  std::vector<baselines::ExactDisc> discs;
};

/// Strokes and small trees, a millimetre to some metres, up to 8 m from their origins, at headings of all sizes. Nothing
/// but the bound of layout/rounding.hpp enlarges their discs: they have no grid.
class TangentShapes {
 public:
  TangentShapes(std::uint64_t seed, std::uint32_t shapes, std::uint32_t poses);

  const ShapeSet& set() const { return set_; }
  const PosedShape& pose(std::uint32_t i) const { return poses_[i]; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(poses_.size()); }

 private:
  std::vector<Shape> shapes_;
  ShapeSet set_;
  std::vector<PosedShape> poses_;
};

/// A pair of agents, two of whose discs are within a few units in the last place of touching.
struct NearTangent {
  const PosedShape *a, *b;
  double x, y;  ///< of b's agent; a's stands at (at_x, at_y)
  double at_x, at_y;
  std::uint32_t i, j;  ///< the discs
  bool meet;           ///< exactly
  double gap;          ///< metres, less than zero where they overlap

  double reaches() const { return a->reach + b->reach; }
  /// Whether they have no other discs.
  bool lone() const { return a->discs.size() == 1 && b->discs.size() == 1; }
};

/// Half of the gaps are -64 to 64 units in the last place of a float, a quarter as many of a double, and the rest up to 8 u
/// of the reaches.
NearTangent near_tangent(Random& random, const TangentShapes& shapes);

}  // namespace bch::test
