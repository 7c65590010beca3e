// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/base/random.hpp"
#include "tests/support/standard.hpp"

namespace bch::test {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// The same numbers everywhere for a seed.
class Random : public detail::Random {
 public:
  using detail::Random::Random;
  double uniform(double low, double high) { return between(low, high); }
};

/// Returns how many cases of the same kind a test of `cases` looks at: an eighth with sanitizers, a tenth in an
/// emulator. These check the code, which is the same for all cases, and take ten times as long; the other builds
/// count answers.
constexpr std::uint32_t samples(std::uint32_t cases) {
#ifdef BCH_SANITIZED
  return (cases + 7) / 8;
#elif defined(BCH_EMULATED)
  return (cases + 9) / 10;
#else
  return cases;
#endif
}

/// Returns an outline of one contour.
Outline polygon(std::vector<Vec2> points);

/// Returns a star-shaped polygon on the outline grid, counter-clockwise around (x, y).
Outline star(Random& random, std::uint32_t corners, double inner, double outer, double x = 0, double y = 0);

/// Returns a sliver from x = -0.4 to a tip at x = 0.4: ahead of the tip its leaf discs reach as far as it
/// does itself.
Outline needle();

/// Returns the outline with every clockwise contour reversed, as validate() requires it.
Outline counter_clockwise(Outline outline);

/// Appends the contours of one outline to another.
void append(Outline& outline, const Outline& more);

Shape contour_shape(const Outline& outline, float threshold = 0.01f);

/// Makes shapes of many kinds: people-sized stars of few and of many corners, slender ones, several contours,
/// whiskers, triangles, and sizes from 1 cm to 4 m.
std::vector<Shape> synthetic_shapes(std::uint64_t seed, std::uint32_t count);

/// Makes a body of so many discs in no order, of any size from a millimetre to 10 m: its nodes hold them.
Shape body_of_discs(Random& random, std::uint32_t count);

/// Repeats the shapes until there are so many that kernels prefetch them.
std::vector<Shape> repeated(std::span<const Shape> shapes);

/// Agents in vectors of their own.
struct Crowd {
  std::vector<std::uint32_t> shape;
  std::vector<double> x, y, heading;
  std::vector<std::uint8_t> level;
  std::vector<double> z;  ///< or none

  Agents agents() const { return {shape, x, y, heading, level, z}; }
  struct Agent {
    std::uint32_t shape;
    double x, y, heading;
    std::uint8_t level;
  };
  /// Adds an agent. Braces evaluate random numbers in the order of the fields; the order of arguments depends
  /// on the compiler.
  void add(const Agent& agent);
};

/// Pairs (2 i, 2 i + 1) of agents of their own, with random shapes and levels, close enough for their root
/// discs to overlap in most.
struct PairScene {
  Crowd crowd;
  std::vector<Pair> pairs;
};
/// Draws a scene of `pairs` pairs; of 5 000 pairs and more only samples().
PairScene random_scene(Random& random, const ShapeSet& shapes, std::uint32_t pairs);

/// Slides the second agent of every pair along a line until `hit` changes within the last bits of the
/// placement, and leaves it a few of those bits on either side.
void make_tangent(Random& random, PairScene& scene, const std::function<bool(const Agents&, Pair)>& hit);

/// Moves the second agents of a random scene about the first ones' positions plus (x, y), with differences
/// that are exact: every coordinate is a multiple of 2^-20 m.
void move_away(PairScene& scene, double x, double y);

}  // namespace bch::test
