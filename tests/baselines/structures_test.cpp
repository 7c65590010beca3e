// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/structure.hpp"

#include "tests/support/baseline_scene.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/test.hpp"

// The interface all structures share: names, counts, order, bad input; and solids that touch exactly.

namespace bch {
namespace {

using baselines::Body;
using baselines::Kind;
using baselines::TestCounts;
using baselines::Truth;
using test::complaint;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const Triangles block_triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

Body body_of(const std::vector<Vec3>& positions, const Triangles& triangles) {
  Body body{positions, triangles, {}};
  body.shape.outline = bch::outline(positions, triangles);
  body.shape.hierarchy = contour_hierarchy(body.shape.outline, 0.01f);
  return body;
}

/// A block from -half to half on the ground, and from `bottom` to `top`.
Body block(float half_x, float half_y, float bottom, float top) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(
        {(i & 1) != 0 ? half_x : -half_x, (i & 2) != 0 ? half_y : -half_y, (i & 4) != 0 ? top : bottom});
  return body_of(corners, block_triangles);
}

/// At the origin, so that the second one stands exactly where it is meant to.
test::Crowd two(std::uint32_t a, std::uint32_t b, double x, double y, double heading) {
  test::Crowd crowd;
  crowd.add({a, 0, 0, 0, 0});
  crowd.add({b, x, y, heading, 0});
  return crowd;
}

TEST(Kinds, HaveTheirNames) {
  std::set<std::string_view> names;
  for (const Kind& kind : baselines::kinds()) names.insert(kind.name);
  for (const char* name : {"reference", "paper_descent", "single", "fixed", "bch_projected", "obb_full",
                           "obb_contour", "obb_contour_2d", "obb_projected"})
    EXPECT_TRUE(names.contains(name)) << name;
  EXPECT_TRUE(names.size() == 9 || names.size() == 14) << names.size();
  EXPECT_EQ(&baselines::kind("obb_full"), &baselines::kind("obb_full"));
  try {
    baselines::kind("obb");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(
        std::string(error.what()).starts_with("no structure 'obb' (known: reference, paper_descent,"));
  }
}

TEST(Kinds, AnswerInAnyOrderOneByOneAndCounted) {
  const Character man = default_male();
  const std::vector<Body> bodies = test::posed_bodies({man}, 3);
  test::PairScene scene = test::placements(5, bodies, 500);
  const Agents agents = scene.crowd.agents();
  for (const test::Answers& one : test::build_all(bodies)) {
    SCOPED_TRACE(one.kind->name);
    EXPECT_EQ(one.structure->shape_count(), 3u);
    EXPECT_GT(one.structure->bytes(2), 0u);
    EXPECT_THROW(one.structure->bytes(3), std::out_of_range);
    std::vector<std::uint8_t> hits(scene.pairs.size(), 77);
    one.structure->query(agents, scene.pairs, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const Pair pair = scene.pairs[i];
      TestCounts counts;
      EXPECT_EQ(one.structure->query(agents, pair, all_depths), hits[i] == 1);
      EXPECT_EQ(one.structure->query(agents, {pair.second, pair.first}, all_depths), hits[i] == 1);
      EXPECT_EQ(one.structure->query(agents, pair, all_depths, counts), hits[i] == 1);
      EXPECT_GE(counts.nodes, 1u);
      if (one.kind->exact != Truth::none && hits[i] == 1) {
        EXPECT_GE(counts.leaves, 1u);
      }
      EXPECT_TRUE(one.structure->query(agents, {pair.first, pair.first}, all_depths));
    }
  }
}

/// Blocks that share a face, an edge, a corner, or miss each other by the last bit of a coordinate: there is
/// one right answer, and the structures that claim to be exact give it. What FCL says of them is its own
/// affair.
TEST(Kinds, TouchingSolidsHaveOneAnswer) {
  const std::vector<Body> bodies = {block(0.5f, 0.25f, 0, 1), block(0.5f, 0.25f, 1, 2),
                                    block(0.5f, 0.25f, std::nextafter(1.0f, 2.0f), 2)};
  struct Case {
    std::uint32_t other;
    double x, y;
    bool mesh, outline, projection;
  };
  const double beyond = 0x1p-51;
  const Case cases[] = {
      {0, 1, 0, true, true, true},  // side by side
      {0, 1 + beyond, 0, false, false, false},
      {0, 1, 0.5, true, true, true},  // corner to corner
      {0, 1, 0.5 + beyond, false, false, false},
      {0, 0, 0.5, true, true, true},
      {1, 0, 0, true, true, true},  // on top of each other
      {1, 0.25, 0.125, true, true, true},
      {1, 1, 0.5, true, true, true},  // a corner on a corner
      {1, 1 + beyond, 0.5, false, false, false},
      {2, 0.25, 0.125, false, true, true},  // above, by one bit
      {2, 1, 0.5, false, true, true},
  };
  for (const test::Answers& one : test::build_all(bodies)) {
    if (one.kind->exact == Truth::none || one.kind->name.starts_with("fcl_")) continue;
    for (const Case& c : cases) {
      const test::Crowd crowd = two(0, c.other, c.x, c.y, 0);
      const bool expected = one.kind->exact == Truth::mesh      ? c.mesh
                            : one.kind->exact == Truth::outline ? c.outline
                                                                : c.projection;
      EXPECT_EQ(one.structure->query(crowd.agents(), {0, 1}, all_depths), expected)
          << one.kind->name << ", " << c.x << ", " << c.y << ", other " << c.other;
    }
  }
}

TEST(Kinds, TheFixedCylinderHasItsRadius) {
  const std::vector<Body> bodies = {block(0.5f, 0.25f, 0, 1)};
  const auto narrow = baselines::kind("fixed").build(bodies, {.fixed_radius = 0.2f});
  const auto wide = baselines::kind("fixed").build(bodies, {});
  EXPECT_FALSE(narrow->query(two(0, 0, 0.45, 0, 1).agents(), {0, 1}, all_depths));
  EXPECT_TRUE(wide->query(two(0, 0, 0.45, 0, 1).agents(), {0, 1}, all_depths));
  EXPECT_FALSE(wide->query(two(0, 0, 0.55, 0, 1).agents(), {0, 1}, all_depths));
}

/// A triangle seen edge-on, one that is a segment, and one that is a point beside others.
TEST(Kinds, TakeDegenerateTriangles) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {0.4f, 0, 0}, {0.2f, 0, 0.5f}, {0, 0.3f, 0}};
  const std::vector<Triangles> meshes = {{{0, 1, 2}}, {{0, 1, 1}, {3, 3, 3}}, {{0, 1, 3}, {2, 2, 2}}};
  std::vector<Body> bodies;
  for (const Triangles& triangles : meshes) bodies.push_back(body_of(positions, triangles));
  test::Random random(12);
  const auto all = test::build_all(bodies);
  for (int i = 0; i < 3000; ++i) {
    const std::uint32_t a = random.below(3), b = random.below(3);
    const test::Crowd crowd = two(a, b, 0.1 * random.below(5), 0.1 * random.below(5), 0.5 * random.below(8));
    const baselines::Placement at = baselines::placement(crowd.agents(), {0, 1});
    for (const test::Answers& one : all) {
      if (one.kind->exact == Truth::none || one.kind->name.starts_with("fcl_")) continue;
      const bool expected = one.kind->exact == Truth::mesh ? test::meshes_meet(bodies[a], bodies[b], at)
                            : one.kind->exact == Truth::outline
                                ? test::outlines_meet(bodies[a].shape.outline, bodies[b].shape.outline, at)
                                : test::projections_meet(bodies[a], bodies[b], at);
      ASSERT_EQ(one.structure->query(crowd.agents(), {0, 1}, all_depths), expected)
          << one.kind->name << ", case " << i << ": " << a << " and " << b;
    }
  }
}

TEST(BadInput, BodiesAreNamedWithWhatIsWrong) {
  const Triangles wild = {{0, 1, 8}};
  for (const Kind& kind : baselines::kinds()) {
    SCOPED_TRACE(kind.name);
    const bool uses_triangles = kind.exact == Truth::mesh || kind.exact == Truth::projection;
    const auto build = [&](auto damage) {
      std::vector<Body> bodies(2, block(0.5f, 0.25f, 0, 1));
      damage(bodies[1]);
      return complaint([&] { kind.build(bodies, {}); });
    };
    EXPECT_EQ(build([](Body&) {}), "accepted");
    const std::string hierarchy = build([](Body& body) { body.shape.hierarchy.nodes.clear(); });
    const bool uses_hierarchy =
        kind.name == "reference" || kind.name == "paper_descent" || kind.name == "single";
    EXPECT_EQ(hierarchy, uses_hierarchy ? "body 1: a hierarchy without nodes" : "accepted");
    const std::string outline = build([](Body& body) { body.shape.outline = {}; });
    EXPECT_EQ(outline, kind.exact == Truth::outline ? "body 1: outline: contour offsets do not fit 0 points"
                                                    : "accepted");
    for (const std::string& message :
         {build([](Body& body) { body.triangles = {}; }), build([&](Body& body) { body.triangles = wild; }),
          build([](Body& body) { body.positions[3].x = NAN; }),
          build([](Body& body) { body.positions[3].x = 2e6f; })})
      EXPECT_TRUE(uses_triangles ? message.starts_with("body 1: ") : message == "accepted") << message;
  }
  for (const float radius : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(), 2e6f})
    EXPECT_NE(complaint([&] { baselines::kind("fixed").build({}, {.fixed_radius = radius}); }), "accepted");
}

}  // namespace
}  // namespace bch
