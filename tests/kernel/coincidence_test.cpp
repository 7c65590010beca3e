// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <vector>

#include <bch/clearance.hpp>
#include <bch/collide.hpp>
#include <bch/contacts.hpp>
#include <bch/time_of_impact.hpp>

#include "baselines/reference.hpp"
#include "layout/format/shape_set_view.hpp"
#include "tests/support/scenes.hpp"

// Agents of which points coincide that a kernel draws lines through: their positions, or the centres of their profiles.

namespace bch {
namespace {

/// Off its origin, all to the left of it, and without an outline.
Shape projection_beside_its_origin(test::Random& random) {
  std::vector<Vec2> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const double x = random.uniform(-1.5, -0.4), y = random.uniform(-0.5, 0.5);
    for (std::uint32_t k = 0; k < 3; ++k)
      vertices.push_back({static_cast<float>(x + random.uniform(-0.1, 0.1)),
                          static_cast<float>(y + random.uniform(-0.1, 0.1))});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {{}, projected_hierarchy(vertices, triangles)};
}

class Coincidence : public testing::TestWithParam<const Implementation*> {
 protected:
  void SetUp() override {
    if (!GetParam()->supported()) GTEST_SKIP() << "this processor has no " << GetParam()->name;
  }

  std::vector<std::uint8_t> collide_in(const ShapeSet& set, const test::PairScene& scene,
                                       Semantics semantics = Semantics::boundary) const {
    std::vector<std::uint8_t> hits(scene.pairs.size());
    collide(set, scene.crowd.agents(), scene.pairs, hits, {semantics, GetParam()});
    return hits;
  }
};

TEST_P(Coincidence, OfPositionsOfShapesWithoutAnOutline) {
  test::Random random(301);
  std::vector<Shape> shapes;
  for (int i = 0; i < 30; ++i) shapes.push_back(projection_beside_its_origin(random));
  const ShapeSet set(shapes);
  test::PairScene scene;
  for (std::uint32_t i = 0; i < test::samples(3'000); ++i) {
    const double heading = random.uniform(-3, 3);
    scene.crowd.add({random.below(30), 5, 7, heading, 0});
    scene.crowd.add({random.below(30), 5, 7, i % 4 == 0 ? heading : random.uniform(-3, 3), 0});
    scene.pairs.push_back({2 * i, 2 * i + (i % 3 != 0)});
  }
  const baselines::Reference discs(shapes, {});
  const Agents agents = scene.crowd.agents();
  const std::size_t count = scene.pairs.size();
  const auto hits = collide_in(set, scene);
  std::vector<float> distances(count), times(count);
  clearance(set, agents, scene.pairs, {distances, {}}, {.implementation = GetParam()});
  const std::vector<double> nothing(count);
  time_of_impact(set, agents, scene.pairs, {nothing, nothing}, times, {.implementation = GetParam()});
  std::size_t colliding = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool hit = discs.boundary(agents, scene.pairs[i], baselines::Method::brute_force);
    ASSERT_EQ(hits[i], hit) << i;
    ASSERT_EQ(times[i] == 0, hit) << i;
    ASSERT_TRUE(!hit || distances[i] <= 0) << i;
    colliding += hit;
  }
  EXPECT_GT(colliding, count / 2);
  EXPECT_LT(colliding, count);
}

/// A wedge points to where its sector is that a direction of zero length has. Inside it lies a smaller one, whose far end
/// sticks out farther behind the common centre than the larger one goes on before it.
TEST_P(Coincidence, OfCentresOfContoursOneInsideTheOther) {
  const Outline wedge = test::polygon({{-1, 0}, {0.25f, -0.5f}, {0.25f, 0.5f}});
  Outline smaller = wedge;
  for (Vec2& p : smaller.points) p = {0.75f * p.x, 0.75f * p.y};
  const std::vector<Shape> shapes = {test::contour_shape(wedge), test::contour_shape(smaller)};
  const ShapeSet set(shapes, {{all_depths}, true});
  const detail::Profile* const profiles = set.view().profiles;
  ASSERT_EQ(profiles[0].y, 0);
  ASSERT_EQ(profiles[1].y, 0);
  test::PairScene scene;
  scene.crowd.add({0, 0, 0, 0, 0});
  scene.crowd.add({1, static_cast<double>(profiles[0].x) - static_cast<double>(profiles[1].x), 0, 0, 0});
  scene.pairs = {{0, 1}};
  EXPECT_EQ(collide_in(set, scene), std::vector<std::uint8_t>{0});
  EXPECT_EQ(collide_in(set, scene, Semantics::solid), std::vector<std::uint8_t>{1});
}

/// Whatever the shapes and semantics, and an agent with itself.
TEST_P(Coincidence, OfPositions) {
  const std::vector<Shape> shapes = test::synthetic_shapes(302, 40);
  const ShapeSet set(shapes, {{2, all_depths}, true});
  const ShapeSet plain(shapes, {{2, all_depths}, true, false});
  test::Random random(303);
  test::PairScene scene;
  for (std::uint32_t i = 0; i < test::samples(4'000); ++i) {
    const auto level = [&] { return static_cast<std::uint8_t>(random.below(2)); };
    const double heading = random.uniform(-3, 3);
    scene.crowd.add({random.below(40), -3, 4, heading, level()});
    scene.crowd.add({random.below(40), -3, 4, i % 4 == 0 ? heading : random.uniform(-3, 3), level()});
    scene.pairs.push_back({2 * i, 2 * i + (i % 3 != 0)});
  }
  for (const Semantics semantics : {Semantics::boundary, Semantics::solid})
    EXPECT_EQ(collide_in(set, scene, semantics), collide_in(plain, scene, semantics));
}

/// Of one shape, at one place, or so near each other that hardly a segment crosses another.
TEST_P(Coincidence, OfOutlines) {
  const std::vector<Shape> shapes = test::synthetic_shapes(304, 20);
  const ShapeSetPlan plan{{3, all_depths}};
  const ShapeSet set(shapes, plan);
  const baselines::Reference exact(shapes, plan);
  test::Random random(305);
  test::PairScene scene;
  for (std::uint32_t i = 0; i < test::samples(400); ++i) {
    const double heading = random.uniform(-3, 3);
    const std::uint32_t shape = random.below(20);
    const auto level = [&] { return static_cast<std::uint8_t>(i % 5 != 0 || random.below(2) == 0); };
    const double off = i % 4 == 0 ? 1e-5 * random.uniform(-1, 1) : 0;
    const double turn = i % 4 == 1 ? 1e-7 * random.uniform(-1, 1) : i % 4 == 2 ? std::numbers::pi : 0;
    scene.crowd.add({shape, -3, 4, heading, level()});
    scene.crowd.add({shape, -3 + off, 4, heading + turn, level()});
    scene.pairs.push_back({2 * i, 2 * i + 1});
  }
  const auto hits = collide_in(set, scene);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i)
    ASSERT_EQ(hits[i], exact.boundary(scene.crowd.agents(), scene.pairs[i], baselines::Method::brute_force))
        << i;
}

std::vector<const Implementation*> all_implementations() {
  std::vector<const Implementation*> all;
  for (const Implementation& each : implementations()) all.push_back(&each);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Implementations, Coincidence, testing::ValuesIn(all_implementations()),
                         [](const auto& param) { return param.param->name; });

}  // namespace
}  // namespace bch
