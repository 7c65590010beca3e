// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <bch/clearance.hpp>
#include <bch/collide.hpp>
#include <bch/contacts.hpp>
#include <bch/hierarchy.hpp>
#include <bch/shape_set.hpp>

#include "layout/hierarchy/discs.hpp"
#include "tests/support/scenes.hpp"

// Shapes of discs of one's own, and what queries say of them, against plain loops over all discs.

namespace bch {
namespace {

using test::Random;

std::vector<Disc> random_discs(Random& random, std::uint32_t count, double size = 0.5) {
  std::vector<Disc> discs;
  for (std::uint32_t i = 0; i < count; ++i)
    discs.push_back({static_cast<float>(random.uniform(-size, size)),
                     static_cast<float>(random.uniform(-size, size)),
                     static_cast<float>(size * std::exp(random.uniform(-4, -0.5)))});
  return discs;
}

/// The five discs of mechanical models of a crowd: shoulders, between them, and the chest.
std::vector<Disc> five_discs() {
  return {{0, -0.2f, 0.1f}, {0.01f, -0.1f, 0.12f}, {0.02f, 0, 0.13f}, {0.01f, 0.1f, 0.12f}, {0, 0.2f, 0.1f}};
}

TEST(ShapeFromDiscs, KeepsDiscsInTheirOrderAndEnlargesThemByRoundingAlone) {
  Random random(2801);
  for (const std::uint32_t count : {1u, 2u, 5u, 8u, 9u, 50u, 300u}) {
    const std::vector<Disc> discs = random_discs(random, count);
    const Hierarchy hierarchy = detail::disc_hierarchy(discs);
    validate(hierarchy);
    const std::vector<std::uint32_t> leaves = cut(hierarchy, all_depths);
    ASSERT_EQ(leaves.size(), discs.size());
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const Disc leaf = hierarchy.nodes[leaves[i]].disc;
      EXPECT_EQ(leaf.x, discs[i].x);
      EXPECT_EQ(leaf.y, discs[i].y);
      EXPECT_GT(leaf.radius, discs[i].radius);
      EXPECT_LT(leaf.radius, double{discs[i].radius} + 1.8e-6 * hierarchy.reach);
    }
    EXPECT_LE(height(hierarchy), count == 1 ? 0 : count - 1);
    EXPECT_EQ(ShapeSet({{shape_from_discs(discs)}}).discs(0, 0).size(), discs.size());
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
                                 3e-6 * hierarchy.reach)
          << k;
    }
  }
  const Hierarchy two = detail::disc_hierarchy(std::vector<Disc>{{-1, 0, 0.5f}, {1, 0, 0.25f}});
  EXPECT_NEAR(two.nodes[0].disc.x, -0.125, 1e-6);
  EXPECT_NEAR(two.nodes[0].disc.radius, 1.375, 1e-5);
}

TEST(ShapeFromDiscs, OneOfManyHoldsAllOthers) {
  const Hierarchy hierarchy =
      detail::disc_hierarchy(std::vector<Disc>{{0.1f, 0, 0.01f}, {0, 0, 1}, {0, 0.2f, 0.1f}});
  EXPECT_NEAR(hierarchy.nodes[0].disc.radius, 1, 1e-5);
}

TEST(ShapeFromDiscs, QueriesAreThoseOfAllPairsOfDiscs) {
  Random random(2803);
  std::vector<std::vector<Disc>> bodies = {five_discs()};
  for (std::uint32_t i = 0; i < 12; ++i) bodies.push_back(random_discs(random, 1 + 4 * i));
  std::vector<Shape> shapes;
  for (const std::vector<Disc>& body : bodies) shapes.push_back(shape_from_discs(body));
  const ShapeSet set(shapes);
  test::PairScene scene = random_scene(random, set, 4'000);
  const Agents agents = scene.crowd.agents();
  std::vector<std::uint8_t> hits(scene.pairs.size());
  std::vector<float> distance(scene.pairs.size());
  collide(set, agents, scene.pairs, hits);
  clearance(set, agents, scene.pairs, {distance}, {.overlap = Overlap::deepest});
  ContactFinder finder;
  const Rows<DiscPair> contacts = finder.find(set, agents, scene.pairs);
  std::size_t colliding = 0;
  for (std::size_t k = 0; k < scene.pairs.size(); ++k) {
    const auto [a, b] = scene.pairs[k];
    const auto centre = [&](std::uint32_t agent, const Disc& disc) {
      const double c = std::cos(agents.heading[agent]), s = std::sin(agents.heading[agent]);
      const double x = disc.x, y = disc.y;
      return std::pair(agents.x[agent] + c * x - s * y, agents.y[agent] + s * x + c * y);
    };
    const double slack =
        4e-6 * (shapes[agents.shape[a]].hierarchy.reach + shapes[agents.shape[b]].hierarchy.reach);
    double least = HUGE_VAL;
    std::size_t sure = 0, possible = 0;
    for (const Disc& p : bodies[agents.shape[a]])
      for (const Disc& q : bodies[agents.shape[b]]) {
        const auto [px, py] = centre(a, p);
        const auto [qx, qy] = centre(b, q);
        const double gap = std::hypot(qx - px, qy - py) - double{p.radius} - double{q.radius};
        least = std::min(least, gap);
        sure += gap <= 0, possible += gap <= slack;
      }
    EXPECT_NEAR(distance[k], least, slack) << k;
    EXPECT_LE(sure, contacts[k].size()) << k;
    EXPECT_GE(possible, contacts[k].size()) << k;
    EXPECT_EQ(hits[k] != 0, !contacts[k].empty()) << k;
    for (const DiscPair& discs : contacts[k]) {
      ASSERT_LT(discs.first, bodies[agents.shape[a]].size());
      const auto [px, py] = centre(a, bodies[agents.shape[a]][discs.first]);
      const auto [qx, qy] = centre(b, bodies[agents.shape[b]][discs.second]);
      EXPECT_LE(std::hypot(qx - px, qy - py), double{bodies[agents.shape[a]][discs.first].radius} +
                                                  double{bodies[agents.shape[b]][discs.second].radius} +
                                                  slack)
          << k;
    }
    colliding += hits[k];
  }
  EXPECT_GT(colliding, hits.size() / 5);
  EXPECT_LT(colliding, hits.size() * 4 / 5);
}

/// A deeper level never adds a collision, and characters of other kinds are in the same set.
TEST(ShapeFromDiscs, MixesWithOtherShapesAtAllLevels) {
  Random random(2804);
  std::vector<Shape> shapes = test::synthetic_shapes(2805, 6);
  for (std::uint32_t i = 0; i < 6; ++i) shapes.push_back(shape_from_discs(random_discs(random, 3 + 7 * i)));
  const ShapeSet set(shapes, {{0, 2, all_depths}});
  EXPECT_FALSE(set.solid());
  test::PairScene scene = random_scene(random, set, 4'000);
  std::vector<std::vector<std::uint8_t>> hits;
  for (std::uint8_t level = 0; level < 3; ++level) {
    for (std::uint8_t& each : scene.crowd.level) each = level;
    collide(set, scene.crowd.agents(), scene.pairs, hits.emplace_back(scene.pairs.size()));
  }
  std::size_t cleared = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    EXPECT_LE(hits[1][i], hits[0][i]) << i;
    EXPECT_LE(hits[2][i], hits[1][i]) << i;
    cleared += hits[2][i] != hits[0][i];
  }
  EXPECT_GT(cleared, 100u);
}

TEST(ShapeFromDiscs, RejectsWhatIsNoDisc) {
  const auto expect_rejected = [](const std::vector<Disc>& discs, const std::string& message) {
    try {
      shape_from_discs(discs);
      FAIL() << "accepted; expected: " << message;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  };
  const float infinite = std::numeric_limits<float>::infinity();
  expect_rejected({}, "0 discs");
  expect_rejected({{0, 0, 1}, {1, 2, 0}}, "disc 1 of 0 m at (1, 2) m");
  expect_rejected({{0, 0, -1}}, "disc 0 of -1 m");
  expect_rejected({{std::nanf(""), 0, 1}}, "disc 0");
  expect_rejected({{0, infinite, 1}}, "disc 0");
  expect_rejected({{0, 0, infinite}}, "disc 0 of inf m");
  expect_rejected({{2e6f, 0, 1}}, "reach");
  expect_rejected({{0, 0, 1e-8f}}, "reach");
  expect_rejected(std::vector<Disc>(5'000, Disc{0, 0, 1}), "5000 discs");
}

}  // namespace
}  // namespace bch
