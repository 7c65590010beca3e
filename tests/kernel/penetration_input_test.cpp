// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/penetrations.hpp"

// What penetration() says of two discs, and of input that is not allowed.

namespace bch {
namespace {

using test::along;
using test::best_of;
using test::PairScene;

/// Two discs of radius 0.25 m.
class TwoDiscs : public testing::Test {
 protected:
  TwoDiscs() {
    scene.crowd.add({0, 0, 0, 0, 0});
    scene.crowd.add({0, 0, 0, 0, 0});
    scene.pairs = {{0, 1}};
  }

  const std::vector<Shape> shapes = {{{}, fixed_cylinder(0.25f)}};
  const ShapeSet set{shapes};
  PairScene scene;

  /// Returns whether discs part along a direction by the least depth that is enough.
  static testing::AssertionResult moves(const Penetration& found, double depth, double x, double y) {
    const double more = static_cast<double>(found.depth) - depth;
    if (more >= 0 && more <= 4e-6 * (1 + depth) && std::abs(found.x - x) <= 1e-9 &&
        std::abs(found.y - y) <= 1e-9)
      return testing::AssertionSuccess();
    return testing::AssertionFailure() << found.depth << " along (" << found.x << ", " << found.y << "), not "
                                       << depth << " along (" << x << ", " << y << ")";
  }
};

TEST_F(TwoDiscs, AreMovedApart) {
  scene.crowd.x[1] = 0.4;
  EXPECT_TRUE(moves(best_of(4, set, scene)[0], 0.1, -1, 0));
  EXPECT_TRUE(moves(along(std::vector<Vec2>{{3, 0}}, set, scene)[0], 0.9, 1, 0));
  EXPECT_TRUE(moves(along(std::vector<Vec2>{{0, 1e-30f}}, set, scene)[0], 0.5, 0, 1));
  scene.crowd.x[1] = 1e9;
  EXPECT_EQ(best_of(4, set, scene)[0].depth, 0);
  EXPECT_EQ(along(std::vector<Vec2>{{-2, 0}}, set, scene)[0], (Penetration{0, -1, 0}));
  EXPECT_TRUE(moves(along(std::vector<Vec2>{{2, 0}}, set, scene)[0], 1e9, 1, 0));
}

TEST_F(TwoDiscs, InOnePlaceMoveByTheFirstDirection) {
  for (const Pair pair : {Pair{0, 1}, {1, 1}, {0, 0}}) {
    scene.pairs = {pair};
    EXPECT_TRUE(moves(best_of(8, set, scene)[0], 0.5, 1, 0));
  }
  scene.pairs = {{1, 0}};
  EXPECT_TRUE(moves(best_of(8, set, scene)[0], 0.5, -1, 0));
}

class BadPenetration : public TwoDiscs {
 protected:
  template <class Call>
  void expect_rejected(const std::string& message, Call call) {
    std::vector<Penetration> out(scene.pairs.size(), {7, 7, 7});
    try {
      call(out);
      FAIL() << "accepted; expected: " << message;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
    for (const Penetration& each : out) EXPECT_EQ(each, (Penetration{7, 7, 7}));
  }
};

TEST_F(BadPenetration, DirectionsAreNamed) {
  scene.pairs = {{0, 1}, {1, 0}};
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  for (const Vec2 bad : {Vec2{0, 0}, Vec2{-0.0f, 0}, Vec2{nan, 1}, Vec2{1, infinity}})
    expect_rejected("pair 1: direction (", [&](std::span<Penetration> out) {
      penetration_along(set, scene.crowd.agents(), scene.pairs, std::vector<Vec2>{{1, 0}, bad}, out);
    });
  expect_rejected("2 pairs but 1 directions", [&](std::span<Penetration> out) {
    penetration_along(set, scene.crowd.agents(), scene.pairs, std::vector<Vec2>{{1, 0}}, out);
  });
  for (const std::uint32_t k : {0u, 1u, 3u, 255u, 258u, ~0u})
    expect_rejected(std::to_string(k) + " directions are not", [&](std::span<Penetration> out) {
      penetration(set, scene.crowd.agents(), scene.pairs, k, out);
    });
  EXPECT_EQ(best_of(most_directions, set, scene).size(), 2u);
}

TEST_F(BadPenetration, AgentsAndSizesAreNamed) {
  expect_rejected("room for 0", [&](std::span<Penetration> out) {
    penetration(set, scene.crowd.agents(), scene.pairs, 4, out.first(0));
  });
  scene.crowd.y[1] = std::numeric_limits<double>::quiet_NaN();
  expect_rejected("pair 0: agent 1: position (0, nan)", [&](std::span<Penetration> out) {
    penetration(set, scene.crowd.agents(), scene.pairs, 4, out);
  });
}

}  // namespace
}  // namespace bch
