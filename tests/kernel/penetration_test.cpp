// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/penetration_reference.hpp"
#include "layout/base/heading.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/differential.hpp"
#include "tests/support/test.hpp"
#include "tests/support/touching_scene.hpp"

namespace bch {
namespace {

using baselines::CutLists;
using test::PairScene;
using test::Random;

const ShapeSetPlan plan{{0, 3, 6, all_depths}, true};

std::vector<Penetration> best_of(std::uint32_t k, const ShapeSet& set, const PairScene& scene) {
  std::vector<Penetration> found(scene.pairs.size(), {-1, -1, -1});
  penetration(set, scene.crowd.agents(), scene.pairs, k, found);
  return found;
}

std::vector<Penetration> along(std::span<const Vec2> directions, const ShapeSet& set,
                               const PairScene& scene) {
  std::vector<Penetration> found(scene.pairs.size(), {-1, -1, -1});
  penetration_along(set, scene.crowd.agents(), scene.pairs, directions, found);
  return found;
}

/// Of every length and way.
std::vector<Vec2> random_directions(Random& random, std::size_t count) {
  std::vector<Vec2> directions;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = random.uniform(-4, 4), length = std::exp(random.uniform(-20, 20));
    directions.push_back(
        {static_cast<float>(length * std::cos(angle)), static_cast<float>(length * std::sin(angle))});
  }
  return directions;
}

/// The scene after every pair's first agent has moved.
PairScene moved(PairScene scene, std::span<const Penetration> by, double further = 0) {
  for (std::size_t i = 0; i < by.size(); ++i) {
    const double depth = static_cast<double>(by[i].depth) + further;
    scene.crowd.x[scene.pairs[i].first] += depth * by[i].x;
    scene.crowd.y[scene.pairs[i].first] += depth * by[i].y;
  }
  return scene;
}

class SeparatingAxisTest : public test::Differential {
 protected:
  SeparatingAxisTest() : Differential(91, plan) {}

  CutLists cuts{shapes, plan};

  std::size_t collisions(const PairScene& scene) const {
    std::vector<std::uint8_t> hits(scene.pairs.size());
    collide(set, scene.crowd.agents(), scene.pairs, hits);
    return static_cast<std::size_t>(std::count(hits.begin(), hits.end(), 1));
  }

  double max_extent(const Agents& agents, std::uint32_t agent) const {
    return static_cast<double>(cuts.max_extent(agents, agent));
  }
};

TEST_F(SeparatingAxisTest, NothingOverlapsAfterwards) {
  for (const bool tangent : {false, true}) {
    PairScene scene = tangent ? tangent_scene(50'000) : random_scene(random, set, 50'000);
    EXPECT_GT(collisions(scene), scene.pairs.size() / 5);
    const auto best = best_of(16, set, scene);
    const auto given = along(random_directions(random, scene.pairs.size()), set, scene);
    for (const auto& by : {best, given})
      for (const double further : {0.0, 1e-3, 0.1, 1.0}) EXPECT_EQ(collisions(moved(scene, by, further)), 0u);
    // And less than that leaves some.
    std::vector<Penetration> less = best;
    for (Penetration& each : less) each.depth *= 0.9f;
    EXPECT_GT(collisions(moved(scene, less)), 0u);
  }
}

/// By what is true of outlines, where they cross, nest, or nearly touch.
TEST_F(SeparatingAxisTest, NoOutlinesMeetAfterwards) {
  const auto outlines = [&](const Agents& agents, Pair pair) { return test::oracle(shapes, agents, pair); };
  PairScene tangent = random_scene(random, set, test::samples(400));
  make_tangent(random, tangent,
               [&](const Agents& agents, Pair pair) { return outlines(agents, pair).cross(); });
  std::size_t met = 0;
  for (const PairScene& before : {tangent, random_scene(random, set, test::samples(1'000))}) {
    const PairScene after = moved(before, best_of(8, set, before));
    for (const Pair pair : before.pairs) {
      const baselines::Oracle then = outlines(before.crowd.agents(), pair),
                              now = outlines(after.crowd.agents(), pair);
      met += then.cross() || then.nested();
      ASSERT_FALSE(now.cross() || now.nested());
    }
  }
  EXPECT_GT(met, test::samples(300));
}

/// Along paths of many steps, large and small, on which agents shift and turn, through each other and apart: no depth
/// changes by more than the points of the agents moved.
TEST_F(SeparatingAxisTest, DepthsDoNotJump) {
  PairScene scene = random_scene(random, set, 2'000);
  const std::vector<Vec2> directions = random_directions(random, scene.pairs.size());
  std::vector<Penetration> best = best_of(16, set, scene), given = along(directions, set, scene);
  double largest = 0;
  for (int step = 0; step < 400; ++step) {
    const double size = std::exp(random.uniform(-14, -2));
    std::vector<double> motion(scene.pairs.size());
    for (std::size_t i = 0; i < scene.pairs.size(); ++i)
      for (const std::size_t agent : {2 * i, 2 * i + 1}) {
        const double dx = random.uniform(-size, size), dy = random.uniform(-size, size);
        const double turn = random.uniform(-size, size);
        scene.crowd.x[agent] += dx, scene.crowd.y[agent] += dy, scene.crowd.heading[agent] += turn;
        motion[i] += std::hypot(dx, dy) +
                     std::abs(turn) * max_extent(scene.crowd.agents(), static_cast<std::uint32_t>(agent));
      }
    const auto next_best = best_of(16, set, scene), next_given = along(directions, set, scene);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const auto [a, b] = scene.pairs[i];
      const double both = max_extent(scene.crowd.agents(), a) + max_extent(scene.crowd.agents(), b);
      for (const auto& [now, before] :
           {std::pair{next_best[i], best[i]}, std::pair{next_given[i], given[i]}}) {
        const double change = std::abs(static_cast<double>(now.depth) - static_cast<double>(before.depth));
        ASSERT_LE(change, motion[i] + 1e-6 * both + 4e-7 * static_cast<double>(now.depth)) << i;
        largest = std::max(largest, change / motion[i]);
      }
    }
    best = next_best, given = next_given;
  }
  EXPECT_GT(largest, 0.5);  // the bound is not idle
}

/// What the header proves: beside where A stands it would have to move as far, by its discs alone.
TEST_F(SeparatingAxisTest, IsTheLeastThatDoesNotJump) {
  PairScene scene = random_scene(random, set, 5'000);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i)
    scene.pairs[i] = {static_cast<std::uint32_t>(2 * i), static_cast<std::uint32_t>(2 * i + 1)};
  std::fill(scene.crowd.heading.begin(), scene.crowd.heading.end(), 0);
  const std::vector<Vec2> directions(scene.pairs.size(), Vec2{1, 0});
  std::vector<Penetration> less = along(directions, set, scene);
  const Agents agents = scene.crowd.agents();
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const auto [a, b] = scene.pairs[i];
    const auto of_a = cuts.of(agents, a), of_b = cuts.of(agents, b);
    const Disc last = *std::min_element(of_a.begin(), of_a.end(), [](const Disc& p, const Disc& q) {
      return p.x - p.radius < q.x - q.radius;
    });
    const Disc foremost = *std::max_element(of_b.begin(), of_b.end(), [](const Disc& p, const Disc& q) {
      return p.x + p.radius < q.x + q.radius;
    });
    scene.crowd.y[a] = scene.crowd.y[b] + static_cast<double>(foremost.y) - static_cast<double>(last.y);
    less[i].depth *= 1 - 4e-7f;
    less[i].depth -= static_cast<float>(5e-6 * (max_extent(agents, a) + max_extent(agents, b)));
  }
  std::vector<float> distance(scene.pairs.size());
  clearance(set, moved(scene, less).crowd.agents(), scene.pairs, {distance});
  std::size_t asked = 0;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (!(less[i].depth > 0)) continue;
    ++asked;
    ASSERT_LE(distance[i], 0) << i;
  }
  EXPECT_GT(asked, distance.size() / 4);
}

/// Far apart, a line across a direction that is not quite the one that was measured lies elsewhere.
TEST_F(SeparatingAxisTest, LinesAcrossTheToldDirectionPartAgentsThatAreFarApart) {
  using Real = long double;
  for (const double distance : {1e5, 1e6, 1e7, 1e8, 7e8}) {
    PairScene scene = random_scene(random, set, 2'000);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const double angle = random.uniform(-4, 4);
      scene.crowd.x[2 * i] += distance * std::cos(angle), scene.crowd.y[2 * i] += distance * std::sin(angle);
    }
    const Agents agents = scene.crowd.agents();
    /// How far an agent's discs extend along a unit vector, from the origin of the world.
    const auto support = [&](std::uint32_t agent, Real x, Real y) {
      const detail::Rotation turn = detail::rotation(agents.heading[agent]);
      const Real c = turn.cosine, s = turn.sine;
      Real most = -HUGE_VALL;
      for (const Disc& disc : cuts.of(agents, agent)) {
        const Real at_x = disc.x, at_y = disc.y, radius = disc.radius;
        most = std::max(most, (c * at_x - s * at_y) * x + (s * at_x + c * at_y) * y + radius);
      }
      return most + agents.x[agent] * x + agents.y[agent] * y;
    };
    const auto best = best_of(16, set, scene);
    const auto given = along(random_directions(random, scene.pairs.size()), set, scene);
    for (const auto* told : {&best, &given})
      for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
        const Real x = (*told)[i].x, y = (*told)[i].y, length = std::sqrt(x * x + y * y);
        ASSERT_NEAR(static_cast<double>(length), 1, 1e-9);
        const auto [a, b] = scene.pairs[i];
        const Real back =
            -support(a, -x / length, -y / length) + static_cast<Real>((*told)[i].depth) * length;
        ASSERT_GE(back, support(b, x / length, y / length)) << distance << " m, pair " << i;
      }
  }
}

/// Two discs of radius 0.25 m.
class TwoDiscs : public testing::Test {
 protected:
  TwoDiscs() {
    scene.crowd.add({0, 0, 0, 0, 0});
    scene.crowd.add({0, 0, 0, 0, 0});
    scene.pairs = {{0, 1}};
  }

  const std::vector<Shape> shapes = {{{}, detail::fixed_cylinder(0.25f)}};
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

// ---- Contacts

/// Broad and narrow phase, in any set: the same as one after the other.
TEST(Contacts, OfACrowdAreThoseOfItsCandidates) {
  Random random(82);
  std::vector<Shape> few_discs;
  for (std::uint32_t i = 0; i < 10; ++i) few_discs.push_back(test::body_of_discs(random, 5));
  const ShapeSet sets[] = {ShapeSet(test::synthetic_shapes(81, 40), {{0, 3, 6, all_depths}, false}),
                           ShapeSet(few_discs), ShapeSet(few_discs, {.heights = true})};
  for (const ShapeSet& of : sets) {
    bch::Crowd finder, of_pairs;
    for (const std::uint32_t count : {0u, 1u, 150u, 700u, 20u}) {
      test::Crowd crowd;
      const double extent = std::sqrt(count) / 2;
      for (std::uint32_t i = 0; i < count; ++i)
        crowd.add({random.below(of.shape_count()), random.uniform(0, extent), random.uniform(0, extent),
                   random.uniform(-4, 4), static_cast<std::uint8_t>(random.below(of.level_count()))});
      if (of.has_heights())
        for (std::uint32_t i = 0; i < count; ++i) crowd.z.push_back(random.below(2));
      const std::vector<Pair> pairs = test::candidate_pairs(of, crowd.agents());
      const bch::Crowd::Contacts found = finder.contacts(of, crowd.agents());
      const Rows<DiscPair> expected = of_pairs.contacts(of, crowd.agents(), pairs);
      std::vector<Pair> touching;
      for (std::size_t i = 0; i < pairs.size(); ++i)
        if (!expected[i].empty()) touching.push_back(pairs[i]);
      EXPECT_TRUE(std::ranges::equal(found.pairs, touching)) << count;
      EXPECT_TRUE(std::ranges::equal(found.contacts.values, expected.values)) << count;
      ASSERT_EQ(found.contacts.size(), touching.size());
      for (std::size_t i = 0; i < touching.size(); ++i) EXPECT_FALSE(found.contacts[i].empty()) << count;
      EXPECT_EQ(touching.empty(), count < 2) << count;
    }
  }
}

}  // namespace
}  // namespace bch
