// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>

#include "bench/stability/shapes.hpp"

namespace bch::bench {

struct PlacedSpecimen {
  const Specimen* specimen;
  double x, y, heading;
  double z = 0;
};

/// Represents two agents with the exact answers about them, and the answers of simple tests.
class Trial {
 public:
  Trial(const PlacedSpecimen& a, const PlacedSpecimen& b);

  PlacedSpecimen a, b;

  /// Moves b along the direction (x, y), a unit vector, to where the two collide last by their discs. From there it moves b along the line of the centres of the two discs that separate the agents
  /// there, which may be discs above the cuts, by the gap for the sum of their radii. Correct to the rounding
  /// of b's position.
  void put_discs_in_contact(double x, double y, const std::function<double(double radii)>& gap);
  /// Moves b along the direction to where the outlines touch last, and by `gap` further.
  void put_outlines_in_contact(double x, double y, double gap);
  /// Moves b up to where it stands on a's top, and by `gap` further. Both have heights.
  void put_on_top(double gap);

  /// Returns how far the two are from colliding by their tight discs, metres. For a choice of one disc of
  /// each cut, take the largest gap between the first one or a disc above it and the second one or a disc
  /// above it; the result is the least value over all such choices; or how far their heights are
  /// apart, if that is more. Its sign is exact.
  double gap() const;
  bool outlines_meet() const;

  bool plain_float_hit() const;
  bool plain_double_hit() const;

  double reaches() const { return a.specimen->reach() + b.specimen->reach(); }

 private:
  baselines::ExactCut cut_a_, cut_b_;  ///< in the world's axes about their agents
};

}  // namespace bch::bench
