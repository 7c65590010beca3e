// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "baselines/exact_discs.hpp"
#include "layout/base/rounding.hpp"
#include "tests/support/scenes.hpp"

namespace bch::test {

/// A shape as it stands at a heading, with the exact discs of its cut at a level and of all nodes above.
struct PosedShape {
  std::uint32_t shape;
  std::uint8_t level;
  double heading, reach;
  baselines::QuadVector rotation;  ///< by the heading
  baselines::ExactCut cut;
};

/// Strokes and small trees, a millimetre to some metres, up to 8 m from their origins, at headings of all sizes. Nothing
/// but the bound of layout/base/rounding.hpp enlarges their discs: they have no grid.
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

/// A pair of agents at the edge of a hit. A disc of one's cut and one of the other's overlap, with all discs
/// above them, except for two of these discs, which are within a few units in the last place of touching.
/// Those two are the discs of the cuts, or discs above one of them or both.
struct NearTangent {
  const PosedShape *a, *b;
  double x, y;  ///< of b's agent; a's stands at (at_x, at_y)
  double at_x, at_y;
  std::uint32_t i, j;  ///< the two that nearly touch, among PosedShape::cut.discs
  bool above;          ///< whether one of them is above its cut
  bool
      meet;  ///< whether the discs of the cuts overlap with all above, exactly: then the pair has to be a hit
  double gap;  ///< of i and j, metres, less than zero where they overlap

  double reaches() const { return a->reach + b->reach; }
  const baselines::ExactDisc& disc_a() const { return a->cut.discs[i]; }
  const baselines::ExactDisc& disc_b() const { return b->cut.discs[j]; }
  double radii() const { return static_cast<double>(disc_a().radius + disc_b().radius); }
  /// Returns whether the cuts have no other discs.
  bool lone() const { return a->cut.discs.size() == 1 && b->cut.discs.size() == 1; }
};

/// Draws a pair of agents that nearly touch. The discs of the cuts are the outermost along a random line, so
/// that hardly any others hide a miss of theirs. The two that nearly touch are those that separate the
/// agents: the first to do so as b moves away along that line from where the centres of both discs of the
/// cuts coincide. That point is then in all discs above, too, so that all overlap on the way.
///
/// Half of the gaps are -64 to 64 units in the last place of a float, a quarter as many of a double, and the rest up to 8 u
/// of the reaches.
NearTangent near_tangent(Random& random, const TangentShapes& shapes);

}  // namespace bch::test
