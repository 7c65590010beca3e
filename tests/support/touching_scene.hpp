// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "baselines/oracle.hpp"
#include "tests/support/scenes.hpp"

namespace bch::test {

/// Returns what is known exactly of the outlines of a pair.
baselines::Oracle oracle(const std::vector<Shape>& shapes, const Agents& agents, Pair pair);

/// Makes outlines of few corners, of sizes from a millimetre to 100 m, up to ten sizes away from their origins: stars, slivers,
/// whiskers and single points, one contour or several. Discs are an eighth of them or much smaller.
std::vector<Shape> simple_shapes(Random& random, std::uint32_t count);

/// What the outlines of a pair do.
struct Truth {
  bool cross;
  double gap;  ///< metres per metre of both extents, beside the steps of the grid
};

struct TouchingScene : PairScene {
  std::vector<Truth> truths;
};

/// Makes pairs of which the second agent is slid up to the first touch of the outlines, and left there, except for a gap of any
/// magnitude, either way.
TouchingScene touching_scene(Random& random, const std::vector<Shape>& shapes, std::uint32_t count);

}  // namespace bch::test
