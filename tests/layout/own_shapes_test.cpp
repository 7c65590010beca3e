// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/base/rounding.hpp"
#include "layout/hierarchy/discs.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/plane_geometry.hpp"
#include "tests/support/test.hpp"

// Shapes of discs of one's own, and what queries say of them, against plain loops over all discs.

namespace bch {
namespace {

using test::Random;

/// How much larger than the smallest disc a node may be, times the extent.
constexpr double room_of_nodes =
    detail::rounding::query_margin + detail::rounding::conservative_margin + 1e-6;

std::vector<Disc> random_discs(Random& random, std::uint32_t count, double size = 0.5) {
  std::vector<Disc> discs;
  for (std::uint32_t i = 0; i < count; ++i)
    discs.push_back({static_cast<float>(random.uniform(-size, size)),
                     static_cast<float>(random.uniform(-size, size)),
                     static_cast<float>(size * std::exp(random.uniform(-4, -0.5)))});
  return discs;
}

TEST(ShapeFromDiscs, KeepsDiscsInTheirOrderAndEnlargesThemByRoundingAlone) {
  Random random(2801);
  for (const std::uint32_t count : {1u, 2u, 5u, 8u, 9u, 50u, 300u}) {
    const std::vector<Disc> discs = random_discs(random, count);
    const Hierarchy hierarchy = detail::disc_hierarchy(discs);
    validate(hierarchy);
    const std::vector<std::uint32_t> leaves = cut(hierarchy, all_depths);
    const std::vector<Disc> in_set = ShapeSet({{shape_from_discs(discs)}}).discs(0, 0);
    ASSERT_EQ(leaves.size(), discs.size());
    ASSERT_EQ(in_set.size(), discs.size());
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const Disc leaf = hierarchy.nodes[leaves[i]].disc;
      EXPECT_EQ(in_set[i], leaf);
      EXPECT_EQ(leaf.x, discs[i].x);
      EXPECT_EQ(leaf.y, discs[i].y);
      EXPECT_GT(leaf.radius, discs[i].radius);
      EXPECT_LT(leaf.radius, double{discs[i].radius} + 1.8e-6 * hierarchy.max_extent);
    }
    EXPECT_LE(detail::height(hierarchy), count == 1 ? 0 : count - 1);
  }
}

/// Every node holds the discs below, and nothing smaller does.
TEST(ShapeFromDiscs, NodesAreTheSmallestDiscs) {
  Random random(2802);
  for (int k = 0; k < 20; ++k) {
    const std::vector<Disc> discs = random_discs(random, 2 + random.below(20));
    const Hierarchy hierarchy = detail::disc_hierarchy(discs);
    const auto radius_about = [&](double x, double y) {
      double radius = 0;
      for (const Disc& disc : discs)
        radius = std::max(radius, std::hypot(double{disc.x} - x, double{disc.y} - y) + double{disc.radius});
      return radius;
    };
    const Disc root = hierarchy.nodes[0].disc;
    EXPECT_GE(root.radius, radius_about(root.x, root.y));
    for (int i = 0; i < 200; ++i) {
      const double root_x = root.x, root_y = root.y, away = 0.3 * std::exp(random.uniform(-8, 0)),
                   angle = random.uniform(-4, 4);
      EXPECT_LE(root.radius, radius_about(root_x + away * std::cos(angle), root_y + away * std::sin(angle)) +
                                 room_of_nodes * hierarchy.max_extent)
          << k;
    }
  }
  const Hierarchy two = detail::disc_hierarchy(std::vector<Disc>{{-1, 0, 0.5f}, {1, 0, 0.25f}});
  EXPECT_NEAR(two.nodes[0].disc.x, -0.125, 1e-6);
  EXPECT_NEAR(two.nodes[0].disc.radius, 1.375, room_of_nodes * two.max_extent);
  const Hierarchy in_one =
      detail::disc_hierarchy(std::vector<Disc>{{0.1f, 0, 0.01f}, {0, 0, 1}, {0, 0.2f, 0.1f}});
  EXPECT_NEAR(in_one.nodes[0].disc.radius, 1, room_of_nodes * in_one.max_extent);
}

/// Asks about the pairs of a scene at each of three levels: a deeper one never adds a collision.
/// Returns: how many the deepest one clears.
std::size_t cleared_by_levels(Random& random, const ShapeSet& set) {
  test::PairScene scene = random_scene(random, set, 200'000);
  std::vector<std::vector<std::uint8_t>> hits;
  for (std::uint8_t level = 0; level < 3; ++level) {
    for (std::uint8_t& each : scene.crowd.level) each = level;
    collide(set, scene.crowd.agents(), scene.pairs, hits.emplace_back(scene.pairs.size()));
  }
  std::size_t cleared = 0;
  for (std::size_t i = 0; i < hits[0].size(); ++i) {
    EXPECT_LE(hits[1][i], hits[0][i]) << i;
    EXPECT_LE(hits[2][i], hits[1][i]) << i;
    cleared += hits[2][i] != hits[0][i];
  }
  return cleared;
}

TEST(ShapeFromDiscs, RejectsWhatIsNoDisc) {
  const auto expect_rejected = [](const std::vector<Disc>& discs, const std::string& message) {
    EXPECT_TRUE(test::has(test::complaint([&] { shape_from_discs(discs); }), message));
  };
  const float infinite = std::numeric_limits<float>::infinity();
  expect_rejected({}, "0 discs");
  expect_rejected({{0, 0, 1}, {1, 2, 0}}, "disc 1 of 0 m at (1, 2) m");
  expect_rejected({{0, 0, -1}}, "disc 0 of -1 m");
  expect_rejected({{std::nanf(""), 0, 1}}, "disc 0");
  expect_rejected({{0, infinite, 1}}, "disc 0");
  expect_rejected({{0, 0, infinite}}, "disc 0 of inf m");
  expect_rejected({{2e6f, 0, 1}}, "extent");
  expect_rejected({{0, 0, 1e-8f}}, "extent");
  expect_rejected(std::vector<Disc>(5'000, Disc{0, 0, 1}), "5000 discs");
}

Capsule random_capsule(Random& random, double size) {
  const auto coordinate = [&] { return static_cast<float>(random.uniform(-size, size)); };
  const Vec2 a{coordinate(), coordinate()};
  const Vec2 b = random.below(5) == 0 ? a : Vec2{coordinate(), coordinate()};
  return {a, b, static_cast<float>(size * std::exp(random.uniform(-3, 0)))};
}

double distance_from(const Capsule& capsule, double x, double y) {
  return test::distance_to_segment<double>(x, y, capsule.a.x, capsule.a.y, capsule.b.x, capsule.b.y) -
         static_cast<double>(capsule.radius);
}

/// The outline's sides are outside of the capsule, and within the tolerance of it.
TEST(ShapeFromCapsules, OutlinesHoldThem) {
  Random random(2806);
  for (int k = 0; k < 300; ++k) {
    const Capsule capsule = random_capsule(random, std::exp(random.uniform(-4, 2)));
    const double tolerance = static_cast<double>(capsule.radius) * std::exp(random.uniform(-8, -1));
    const Shape shape = shape_from_capsules({&capsule, 1}, static_cast<float>(tolerance));
    ASSERT_EQ(shape.outline.contours(), 1u);
    const std::vector<Vec2>& points = shape.outline.points;
    double around = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 from = points[i], to = points[(i + 1) % points.size()];
      for (int step = 0; step < 10; ++step) {
        const double fraction = step / 10.0;
        const double x = (1 - fraction) * static_cast<double>(from.x) + fraction * static_cast<double>(to.x),
                     y = (1 - fraction) * static_cast<double>(from.y) + fraction * static_cast<double>(to.y);
        const double gap = distance_from(capsule, x, y);
        ASSERT_GE(gap, 0) << k;
        ASSERT_LE(gap, tolerance) << k;
      }
      around += static_cast<double>(from.x) * static_cast<double>(to.y) -
                static_cast<double>(to.x) * static_cast<double>(from.y);
    }
    EXPECT_GT(around, 0);
  }
}

/// Bodies of capsules collide where their capsules do, but for the tolerance.
TEST(ShapeFromCapsules, CollideAsTheyDo) {
  Random random(2807);
  constexpr float tolerance = 0.002f;
  std::vector<std::vector<Capsule>> bodies;
  std::vector<Shape> shapes;
  for (std::uint32_t i = 0; i < 12; ++i) {
    auto& body = bodies.emplace_back();
    for (std::uint32_t k = 0; k < 1 + i % 4; ++k) body.push_back(random_capsule(random, 0.3));
    shapes.push_back(shape_from_capsules(body, tolerance));
  }
  const ShapeSet set(shapes);
  test::PairScene scene = random_scene(random, set, 200'000);
  const Agents agents = scene.crowd.agents();
  std::vector<std::uint8_t> hits(scene.pairs.size());
  collide(set, agents, scene.pairs, hits);
  std::size_t colliding = 0, apart = 0;
  for (std::size_t k = 0; k < scene.pairs.size(); ++k) {
    const std::uint32_t a = scene.pairs[k].first, b = scene.pairs[k].second;
    const auto placed = [&](std::uint32_t agent, const Vec2& point) {
      const double c = std::cos(agents.heading.x()[agent]), s = std::sin(agents.heading.x()[agent]);
      const double x = point.x, y = point.y;
      // About the first agent, so that float holds it.
      return Vec2{static_cast<float>(agents.x[agent] - agents.x[a] + c * x - s * y),
                  static_cast<float>(agents.y[agent] - agents.y[a] + s * x + c * y)};
    };
    double gap = HUGE_VAL;
    for (const Capsule& p : bodies[agents.shape[a]])
      for (const Capsule& q : bodies[agents.shape[b]]) {
        const Capsule one{placed(a, p.a), placed(a, p.b), p.radius},
            other{placed(b, q.a), placed(b, q.b), q.radius};
        const auto ends = [](const Capsule& of, const Capsule& with) {
          return std::min(distance_from(of, with.a.x, with.a.y), distance_from(of, with.b.x, with.b.y)) -
                 static_cast<double>(with.radius);
        };
        const auto side = [](Vec2 from, Vec2 to, Vec2 of) {
          return (double{to.x} - double{from.x}) * (double{of.y} - double{from.y}) -
                 (double{to.y} - double{from.y}) * (double{of.x} - double{from.x});
        };
        const bool cross = (side(one.a, one.b, other.a) > 0) != (side(one.a, one.b, other.b) > 0) &&
                           (side(other.a, other.b, one.a) > 0) != (side(other.a, other.b, one.b) > 0);
        gap = std::min({gap, ends(one, other), ends(other, one), cross ? -1.0 : HUGE_VAL});
      }
    if (gap < -1e-5) {
      ASSERT_EQ(hits[k], 1) << k;
      ++colliding;
    } else if (gap > 2 * double{tolerance} + 1e-5) {
      ASSERT_EQ(hits[k], 0) << k;
      ++apart;
    }
  }
  EXPECT_GT(colliding, test::samples(25'000));
  EXPECT_GT(apart, test::samples(25'000));
}

/// Polygons and capsules beside people's shapes, and then discs, which have no outlines, too.
TEST(ShapesOfOnesOwn, MixWithOthersAtAllLevels) {
  Random random(2808);
  std::vector<Shape> shapes = test::synthetic_shapes(2809, 6);
  const std::vector<std::vector<Vec2>> chair = {{{-0.4f, -0.3f}, {0.4f, -0.3f}, {0.4f, 0.3f}, {-0.4f, 0.3f}},
                                                {{0.3f, -0.1f}, {0.6f, -0.1f}, {0.6f, 0.1f}, {0.3f, 0.1f}}};
  shapes.push_back(shape_from_polygons(chair));
  EXPECT_EQ(shapes.back().outline.contours(), 2u);
  const Capsule arms[] = {{{-0.3f, 0}, {0.3f, 0}, 0.1f}, {{0, 0}, {0, 0.4f}, 0.05f}};
  shapes.push_back(shape_from_capsules(arms));
  const ShapeSetPlan plan{.depths = {0, 3, all_depths}};
  const ShapeSet outlined(shapes, plan);
  EXPECT_TRUE(outlined.exact_leaves());
  EXPECT_GT(cleared_by_levels(random, outlined), 100u);
  for (std::uint32_t i = 0; i < 6; ++i) shapes.push_back(shape_from_discs(random_discs(random, 3 + 7 * i)));
  const ShapeSet mixed(shapes, plan);
  EXPECT_GT(cleared_by_levels(random, mixed), 100u);
}

TEST(ShapeFromCapsules, RejectsWhatIsNone) {
  const auto complaint = [](const std::vector<Capsule>& capsules, float tolerance = 0.001f) {
    return test::complaint([&] { shape_from_capsules(capsules, tolerance); });
  };
  const Capsule good{{0, 0}, {1, 0}, 0.1f};
  EXPECT_EQ(complaint({}), "shape: expected at least one capsule, found none");
  EXPECT_EQ(
      complaint({good, {{0, 0}, {1, 0}, 0}}),
      "shape: capsule 1: expected a radius above 0 m and an extent of at most 1e6 m, found a radius of 0");
  EXPECT_EQ(
      complaint({{{0, std::nanf("")}, {1, 0}, 1}}),
      "shape: capsule 0: expected a radius above 0 m and an extent of at most 1e6 m, found a radius of 1");
  EXPECT_EQ(complaint({good}, 0), "shape: expected a tolerance above 0 m, found 0");
  EXPECT_EQ(complaint({good}, -1), "shape: expected a tolerance above 0 m, found -1");
  EXPECT_EQ(complaint({good}, 1e-9f),
            "shape: capsule 0: expected a larger tolerance for its size, found 1e-09 m");
  EXPECT_EQ(complaint({good}, 1e-6f), "accepted");
  EXPECT_NE(test::complaint([] { shape_from_polygons({}); }), "accepted");
}

}  // namespace
}  // namespace bch
