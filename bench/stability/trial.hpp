// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>

#include "bench/stability/shapes.hpp"

namespace bch::bench {

struct PlacedSpecimen {
  const Specimen* specimen;
  double x, y, heading;
};

/// Two agents: what is true of them, and what plain tests say.
class Trial {
 public:
  Trial(const PlacedSpecimen& a, const PlacedSpecimen& b);

  PlacedSpecimen a, b;

  /// Moves b along the direction (x, y), a unit vector, to where the two collide last by their discs, and from there along the
  /// line of the centres of the two that part there, which may be discs above the cuts, by the gap for the sum of their
  /// radii. Correct to the rounding of b's position.
  void put_discs_in_contact(double x, double y, const std::function<double(double radii)>& gap);
  /// Moves b along the direction to where the outlines touch last, and by `gap` further.
  void put_outlines_in_contact(double x, double y, double gap);

  /// How far the two are from colliding by their tight discs, metres: of two discs of the cuts and all discs above them the
  /// largest gap between one of the first agent and one of the second; of all such choices the least. Its sign is exact.
  double gap() const;
  bool outlines_meet() const;

  bool plain_float_hit() const;
  bool plain_double_hit() const;

  double reaches() const { return a.specimen->reach() + b.specimen->reach(); }

 private:
  baselines::ExactCut cut_a_, cut_b_;  ///< in the world's axes about their agents
};

}  // namespace bch::bench
