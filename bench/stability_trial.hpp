// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>

#include "bench/stability_shapes.hpp"

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

  /// Moves b along the direction (x, y), a unit vector, to where the discs touch last, and from there along the line of those
  /// two discs' centres by the gap for the sum of their radii. Correct to the rounding of b's position.
  void put_discs_in_contact(double x, double y, const std::function<double(double radii)>& gap);
  /// Moves b along the direction to where the outlines touch last, and by `gap` further.
  void put_outlines_in_contact(double x, double y, double gap);

  /// The least gap between tight discs, metres, negative where two overlap. Its sign is exact.
  double gap() const;
  bool outlines_meet() const;

  bool plain_float_hit() const;
  bool plain_double_hit() const;

  double reaches() const { return a.specimen->reach() + b.specimen->reach(); }

 private:
  std::vector<baselines::ExactDisc> discs_a_, discs_b_;  ///< in the world's axes about their agents
};

}  // namespace bch::bench
