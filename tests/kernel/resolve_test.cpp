// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/crowd/separation_solver.hpp"
#include "tests/support/body_scenes.hpp"
#include "tests/support/on_threads.hpp"
#include "tests/support/test.hpp"

// Crowds without overlaps: Crowd::resolve().
namespace bch {
namespace {

using detail::SeparationSolver;
using test::BodyCrowd;
using test::Random;

/// Owns an answer of resolve(), whose memory is the Crowd's.
struct Answer {
  std::vector<double> x, y;
  std::vector<Pair> left;
  std::vector<std::uint32_t> agents_at_walls;
  std::uint32_t sweeps;
  std::vector<double> turn = {};

  friend bool operator==(const Answer&, const Answer&) = default;
};

Answer resolved(const BodySet& bodies, const BodyCrowd& crowd, const Crowd::ResolveOptions& options = {},
                CrowdOptions::Period period = {}) {
  Crowd finder({.period = period});
  const Crowd::Resolved found = finder.resolve(bodies, crowd.agents(), options);
  return {{found.x.begin(), found.x.end()},
          {found.y.begin(), found.y.end()},
          {found.left.begin(), found.left.end()},
          {found.agents_at_walls.begin(), found.agents_at_walls.end()},
          found.sweeps,
          {found.turn.begin(), found.turn.end()}};
}

/// People who stand close, on a staircase.
struct Scene {
  Random random{5701};
  BodySet bodies = test::random_bodies(random);
  BodyCrowd crowd = test::random_body_crowd(random, 40, bodies.body_count(), 3, 0.4);

  std::size_t hits(const Answer& at) const {
    BodyCrowd moved = crowd;
    moved.x = at.x, moved.y = at.y;
    for (std::size_t i = 0; i < at.turn.size(); ++i) moved.heading[i] += at.turn[i];
    std::vector<std::uint8_t> answers(moved.pairs.size());
    collide(bodies, moved.agents(), moved.pairs, answers);
    return static_cast<std::size_t>(std::ranges::count(answers, 1));
  }
  double mean_shift(const Answer& at) const {
    double sum = 0;
    for (std::size_t i = 0; i < at.x.size(); ++i)
      sum += std::hypot(at.x[i] - crowd.x[i], at.y[i] - crowd.y[i]);
    return sum / static_cast<double>(at.x.size());
  }
  double largest_shift(const Answer& at) const {
    double largest = 0;
    for (std::size_t i = 0; i < at.x.size(); ++i)
      largest = std::max(largest, std::hypot(at.x[i] - crowd.x[i], at.y[i] - crowd.y[i]));
    return largest;
  }
};

/// Two spheres of 0.3 m that overlap by 0.2 m along x, and a third one that does not.
struct ThreeSpheres {
  std::vector<std::vector<Sphere>> spheres = {{{0, 0, 1, 0.3f}}};
  BodySet bodies{spheres};
  BodyCrowd crowd{{0, 0, 0}, {0, 0.4, 0.8}, {0, 0, 3}, {0, 0, 0}, {0, 0, 0}, {}};
};

TEST(Resolve, PartsACrowdAndMovesItLittle) {
  const Scene scene;
  const Answer before{scene.crowd.x, scene.crowd.y, {}, {}, 0}, after = resolved(scene.bodies, scene.crowd);
  ASSERT_GT(scene.hits(before), 30u);
  EXPECT_EQ(scene.hits(after), 0u);
  EXPECT_TRUE(after.left.empty());
  EXPECT_GT(after.sweeps, 2u);
  EXPECT_LT(after.sweeps, 60u);
  EXPECT_LT(scene.largest_shift(after), 0.8);
  // Who is free stays where he is.
  EXPECT_EQ(
      resolved(scene.bodies, {scene.crowd.body, after.x, after.y, scene.crowd.z, scene.crowd.heading, {}}),
      (Answer{after.x, after.y, {}, {}, 0}));
}

TEST(Resolve, IsTheSameOnEveryImplementationAndForAnyNumberOfThreads) {
  const Scene scene;
  for (const double turn : {0.0, 0.5}) {
    const Answer expected = resolved(scene.bodies, scene.crowd, {.largest_turn = turn});
    for (const Implementation& implementation : test::supported())
      for (const unsigned threads : {1u, 2u})
        test::on_threads(threads, [&] {
          EXPECT_EQ(
              resolved(scene.bodies, scene.crowd, {.largest_turn = turn, .implementation = &implementation}),
              expected);
        });
  }
}

/// Four spheres in a row along x, as wide as shoulders: two rows at right angles overlap at the end of one.
struct TwoRows {
  std::vector<std::vector<Sphere>> spheres = {
      {{-0.3f, 0, 1, 0.1f}, {-0.1f, 0, 1, 0.1f}, {0.1f, 0, 1, 0.1f}, {0.3f, 0, 1, 0.1f}}};
  BodySet bodies{spheres};
  BodyCrowd crowd{{0, 0}, {0, 0.35}, {0, 0.15}, {0, 0}, {0, 0.5}, {}};
};

TEST(Resolve, ThoseWhoTurnShiftLess) {
  const Scene scene;
  const Answer still = resolved(scene.bodies, scene.crowd),
               turned = resolved(scene.bodies, scene.crowd, {.largest_turn = 0.4});
  EXPECT_TRUE(still.turn.empty());
  ASSERT_EQ(turned.turn.size(), scene.crowd.x.size());
  const auto [least, largest] = std::ranges::minmax(turned.turn);
  EXPECT_GE(least, -0.4);
  EXPECT_LE(largest, 0.4);
  EXPECT_LT(least, -0.05);
  EXPECT_GT(largest, 0.05);
  EXPECT_TRUE(turned.left.empty());
  EXPECT_EQ(scene.hits(turned), 0u);
  EXPECT_LT(scene.mean_shift(turned), 0.95 * scene.mean_shift(still));
}

TEST(Resolve, DirectionsTurnAsAnglesDo) {
  const TwoRows scene;
  const Answer angles = resolved(scene.bodies, scene.crowd, {.largest_turn = 1});
  EXPECT_TRUE(angles.left.empty());
  EXPECT_GT(std::abs(angles.turn[0]) + std::abs(angles.turn[1]), 0.01);
  Agents agents = scene.crowd.agents();
  const std::vector<double> cosines = {1, std::cos(0.5)}, sines = {0, std::sin(0.5)};
  agents.heading = Headings(cosines, sines);
  Crowd finder;
  const Crowd::Resolved directions = finder.resolve(scene.bodies, agents, {.largest_turn = 1});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(directions.turn[i], angles.turn[i], 1e-5);
    EXPECT_NEAR(directions.x[i], angles.x[i], 1e-5);
    EXPECT_NEAR(directions.y[i], angles.y[i], 1e-5);
  }
  // Whoever has no mobility does not turn.
  const std::vector<double> one = {0, 1};
  const Answer second = resolved(scene.bodies, scene.crowd, {.largest_turn = 1, .mobility = one});
  EXPECT_EQ(second.turn[0], 0);
  EXPECT_TRUE(second.left.empty());
}

TEST(Resolve, TwoGoHalfTheWayOrAsTheirMobilitiesSay) {
  const ThreeSpheres scene;
  const Answer both = resolved(scene.bodies, scene.crowd);
  EXPECT_NEAR(both.x[0], -0.1005, 1e-4);
  EXPECT_NEAR(both.x[1], 0.5005, 1e-4);
  EXPECT_EQ(both.x[2], 0.8);
  const std::vector<double> one = {0, 1, 1}, quarter = {0.25, 0.75, 0}, none = {0, 0, 1};
  const Answer second = resolved(scene.bodies, scene.crowd, {.mobility = one});
  EXPECT_EQ(second.x[0], 0);
  EXPECT_NEAR(second.x[1], 0.601, 1e-4);
  EXPECT_NEAR(resolved(scene.bodies, scene.crowd, {.largest_step = 1, .mobility = quarter}).x[0], -0.05025,
              1e-4);
  EXPECT_EQ(resolved(scene.bodies, scene.crowd, {.mobility = none}),
            (Answer{scene.crowd.x, scene.crowd.y, {{0, 1}}, {}, 0}));
}

TEST(Resolve, NobodyIsPushedIntoAnother) {
  ThreeSpheres scene;
  scene.crowd.x[2] = 1.01, scene.crowd.y[2] = 0;  // 1 cm behind the second one
  EXPECT_TRUE(resolved(scene.bodies, scene.crowd, {.sweeps = 1, .largest_step = 1}).left.empty());
}

TEST(Resolve, KeepsItsLimits) {
  const Scene scene;
  const Answer step = resolved(scene.bodies, scene.crowd, {.sweeps = 1, .largest_step = 0.01}),
               shift = resolved(scene.bodies, scene.crowd, {.largest_shift = 0.03});
  EXPECT_EQ(step.sweeps, 1u);
  EXPECT_EQ(shift.sweeps, 100u);
  EXPECT_NEAR(scene.largest_shift(step), 0.01, 1e-12);
  EXPECT_NEAR(scene.largest_shift(shift), 0.03, 1e-12);
  for (const Answer& each : {step, shift}) {
    EXPECT_GT(each.left.size(), 0u);
    EXPECT_EQ(each.left.size(), scene.hits(each));
  }
}

TEST(Resolve, WallsPushAndHold) {
  const ThreeSpheres scene;
  const ObstacleSet wall = obstacles_from_wkt("LINESTRING(-0.2 -1, -0.2 1)");
  const Answer found = resolved(scene.bodies, scene.crowd, {.obstacles = &wall});
  EXPECT_NEAR(found.x[0], 0.101, 2e-3);
  EXPECT_NEAR(found.x[1], 0.702, 3e-3);
  EXPECT_TRUE(found.left.empty() && found.agents_at_walls.empty());
  const std::vector<double> none = {0, 0, 0};
  EXPECT_EQ(resolved(scene.bodies, scene.crowd, {.mobility = none, .obstacles = &wall}),
            (Answer{scene.crowd.x, scene.crowd.y, {{0, 1}}, {0}, 0}));
}

TEST(Resolve, AcrossBordersAsWithin) {
  ThreeSpheres scene;
  const Answer within = resolved(scene.bodies, scene.crowd, {}, {10, 10});
  scene.crowd.x = {9.8, 0.2, 0.6};
  const Answer across = resolved(scene.bodies, scene.crowd, {}, {10, 10});
  EXPECT_EQ(across.sweeps, within.sweeps);
  EXPECT_NEAR(across.x[0], 9.8 + within.x[0], 1e-6);
  EXPECT_NEAR(across.x[1], 0.2 + within.x[1] - 0.4, 1e-6);
}

TEST(Resolve, RefusesWhatIsInvalid) {
  const ThreeSpheres scene;
  const std::vector<double> two = {1, 1}, large = {1, 1, 2};
  const auto expect_refused = [&](const Crowd::ResolveOptions& options, const char* words) {
    EXPECT_EQ(test::complaint([&] { resolved(scene.bodies, scene.crowd, options); }), words);
  };
  expect_refused({.directions = 3}, "resolve: expected an even number of directions from 2 to 256, found 3");
  expect_refused({.gap = -1}, "resolve: expected a gap of 0 to 1000 m, found -1");
  expect_refused({.largest_step = NAN}, "resolve: expected a largest_step of 0 to 1000 m, found nan");
  expect_refused({.largest_shift = -1}, "resolve: expected a largest_shift of 0 to inf m, found -1");
  expect_refused({.largest_turn = -1}, "resolve: expected a largest_turn of 0 to 3.2 rad, found -1");
  expect_refused({.largest_turn = NAN}, "resolve: expected a largest_turn of 0 to 3.2 rad, found nan");
  expect_refused({.mobility = two}, "resolve: expected 3 mobilities, one per agent, found 2");
  expect_refused({.mobility = large}, "resolve: agent 2: expected a mobility of 0 to 1, found 2");
}

TEST(SeparationSolver, FindsTheLeastSumOfSquares) {
  // Three in a row, each 0.2 m in the next one; the last is 0.1 m from a fourth.
  SeparationSolver solver;
  const auto expect_displacements = [&](std::initializer_list<double> expected) {
    solver.solve();
    for (std::uint32_t i = 0; const double x : expected) {
      EXPECT_NEAR(solver.displacement(i).x, x, 3e-3) << i;
      EXPECT_EQ(solver.displacement(i++).y, 0);
    }
  };
  const auto begin = [&] {
    solver.begin(4, {});
    for (std::uint32_t i = 0; i < 3; ++i) solver.add(i, i + 1, -1, 0, i < 2 ? 0.2 : -0.1);
    solver.add(0, 1, -1, 0, -1);  // is so anyway
  };
  begin();
  expect_displacements({-0.225, -0.025, 0.175, 0.075});
  begin();
  solver.add(0, SeparationSolver::nobody, 1, 0, -0.2);  // a wall
  expect_displacements({-0.2, 0, 0.2, 0.1});
}

TEST(SeparationSolver, TurnsWhereThatIsLess) {
  // The first agent may turn, with an arm of one: half of the displacement is by turning, as squares are least.
  SeparationSolver solver;
  solver.begin(2, {});
  solver.add(0, SeparationSolver::nobody, 1, 0, 0.2, {1, 0});
  solver.solve();
  EXPECT_NEAR(solver.displacement(0).x, 0.1, 1e-9);
  EXPECT_NEAR(solver.displacement(0).turn, 0.1, 1e-9);
  // The second one's turn counts the other way.
  solver.begin(2, {});
  solver.add(0, 1, 1, 0, 0.3, {0, 1});
  solver.solve();
  EXPECT_NEAR(solver.displacement(0).x, 0.1, 1e-9);
  EXPECT_NEAR(solver.displacement(1).x, -0.1, 1e-9);
  EXPECT_NEAR(solver.displacement(1).turn, -0.1, 1e-9);
}

}  // namespace
}  // namespace bch
