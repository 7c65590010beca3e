// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/rounding.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kernel/collide.hpp"
#include "layout/enclosing_disc.hpp"
#include "tests/scenes.hpp"

// The bound of layout/rounding.hpp, attacked where it matters: discs that touch, exactly, far from their agents' origins.

namespace bch {
namespace {

/// Strokes of a few millimetres to a metre, up to 8 m from the origin. A stroke's two ends lie on its smallest enclosing disc,
/// and without a grid nothing but the bound enlarges that.
std::vector<Shape> strokes(test::Random& random, int count) {
  std::vector<Shape> shapes;
  for (int i = 0; i < count; ++i) {
    const double far = std::exp2(random.uniform(-6, 3)), size = std::exp2(random.uniform(-8, 0));
    const double at = random.uniform(-4, 4), along = random.uniform(-4, 4);
    Outline outline;
    const double x = far * std::cos(at), y = far * std::sin(at);
    outline.points = {
        {static_cast<float>(x), static_cast<float>(y)},
        {static_cast<float>(x + size * std::cos(along)), static_cast<float>(y + size * std::sin(along))}};
    outline.contour_begin.push_back(2);
    shapes.push_back({outline, contour_hierarchy(outline, 2.0f)});
  }
  return shapes;
}

struct Exact {
  long double x, y, radius;
};

/// The tight disc, in the world's axes about the agent's position.
Exact tight_disc(const Shape& shape, double heading) {
  const EnclosingDisc disc = smallest_enclosing_disc(shape.outline.points);
  const long double c = std::cos(static_cast<long double>(heading)),
                    s = std::sin(static_cast<long double>(heading));
  const long double x = disc.centre.x, y = disc.centre.y;
  return {c * x - s * y, s * x + c * y, disc.radius};
}

/// Agents 2 i and 2 i + 1 stand so that their tight discs overlap by 1e-14 m, which is next to nothing but more than the rounding of
/// positions near the origin; `gap` further apart.
test::PairScene touching(test::Random& random, const std::vector<Shape>& shapes, std::uint32_t pairs,
                         double gap_per_reach) {
  test::PairScene scene;
  for (std::uint32_t i = 0; i < pairs; ++i) {
    const std::uint32_t a = random.below(static_cast<std::uint32_t>(shapes.size())),
                        b = random.below(static_cast<std::uint32_t>(shapes.size()));
    const double heading_a = random.uniform(-4, 4), heading_b = random.uniform(-4, 4);
    const Exact disc_a = tight_disc(shapes[a], heading_a), disc_b = tight_disc(shapes[b], heading_b);
    const long double angle = random.uniform(-4, 4);
    const long double gap = gap_per_reach * (shapes[a].hierarchy.reach + shapes[b].hierarchy.reach);
    const long double distance = disc_a.radius + disc_b.radius - 1e-14L + gap;
    scene.crowd.add(a, 0, 0, heading_a, 0);
    scene.crowd.add(b, static_cast<double>(disc_a.x - disc_b.x + distance * std::cos(angle)),
                    static_cast<double>(disc_a.y - disc_b.y + distance * std::sin(angle)), heading_b, 0);
    scene.pairs.push_back(i % 2 == 0 ? Pair{2 * i, 2 * i + 1} : Pair{2 * i + 1, 2 * i});
  }
  return scene;
}

std::size_t hits_of(const ShapeSet& set, const test::PairScene& scene,
                    const kernel::Implementation& implementation) {
  std::vector<std::uint8_t> hits(scene.pairs.size());
  collide(set, scene.crowd.agents(), scene.pairs, hits, {Semantics::boundary, &implementation});
  return static_cast<std::size_t>(std::count(hits.begin(), hits.end(), 1));
}

TEST(RoundingBound, DiscsThatTouchAreNeverMissed) {
  test::Random random(1968);
  const std::vector<Shape> shapes = strokes(random, 500);
  const ShapeSet set(shapes);
  const test::PairScene scene = touching(random, shapes, 1'000'000, 0);
  for (const auto& implementation : kernel::implementations())
    if (implementation.supported()) {
      EXPECT_EQ(hits_of(set, scene, implementation), scene.pairs.size()) << implementation.name;
    }
}

/// The price is as documented: no false positive beyond a gap of 4 um per metre of reach.
TEST(RoundingBound, DiscsWithAGapAreApart) {
  test::Random random(1969);
  const std::vector<Shape> shapes = strokes(random, 500);
  const ShapeSet set(shapes);
  const test::PairScene scene = touching(random, shapes, 200'000, 4e-6);
  for (const auto& implementation : kernel::implementations())
    if (implementation.supported()) {
      EXPECT_EQ(hits_of(set, scene, implementation), 0u) << implementation.name;
    }
}

}  // namespace
}  // namespace bch
