// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/character_shapes.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/query_references.hpp"
#include "tests/support/test.hpp"

// Agents with a z, against the definition: a pair is answered as on one ground by brute force where both intervals of heights have a
// point in common, and else as agents who never meet. (obstacle_hall_test.cpp does the same for obstacles.)

namespace bch {
namespace {

using test::PairAnswers;
using test::PairScene;
using test::Questions;
using test::Random;

constexpr float never = std::numeric_limits<float>::infinity();

/// Says how queries answer a pair whose heights do not meet.
PairAnswers answers_apart(const Questions& of, std::size_t pair) {
  PairAnswers all{};
  all.deepest = all.nearest = all.exact = {never, {0, 0}, DiscPair::none, {}};
  all.time = never;
  all.best = {0, of.pairs[pair].first <= of.pairs[pair].second ? 1.0 : -1.0, 0};
  const double x = of.directions[pair].x, y = of.directions[pair].y, length = std::sqrt(x * x + y * y);
  all.along = {0, x / length, y / length};
  return all;
}

class AgentsWithHeights : public testing::Test {
 protected:
  bool heights_meet(const test::Crowd& crowd, Pair pair) const {
    const auto& [a, b] = pair;
    const Heights &of_a = shapes[crowd.shape[a]].heights, &of_b = shapes[crowd.shape[b]].heights;
    return crowd.z[a] + double{of_a.bottom} <= crowd.z[b] + double{of_b.top} &&
           crowd.z[b] + double{of_b.bottom} <= crowd.z[a] + double{of_a.top};
  }

  /// Asks all queries about the scene's agents, on one ground and then with a z.
  void expect_as_brute_force(const PairScene& scene) {
    Questions questions = questions_about(random, set, scene);
    const std::vector<PairAnswers> on_one_ground = reference.answers(set, questions);
    test::raise(random, questions.crowd);
    std::vector<PairAnswers> expected, twice_exchanged;
    std::size_t hits = 0, above = 0;
    for (std::size_t i = 0; i < questions.pairs.size(); ++i) {
      const bool meet = heights_meet(questions.crowd, questions.pairs[i]);
      expected.push_back(meet ? on_one_ground[i] : answers_apart(questions, i));
      twice_exchanged.push_back(expected.back().exchanged().exchanged());  // as 0 - 0 and no other zero
      hits += expected.back().hit;
      above += on_one_ground[i].hit > expected.back().hit;
    }
    EXPECT_GT(hits, expected.size() / 20);
    EXPECT_GT(above, expected.size() / 60);
    expect_answers(set, questions, expected, "in order");
    std::vector<PairAnswers> other_order = run_query(set, questions.exchanged());
    for (PairAnswers& each : other_order) each = each.exchanged();
    expect_same(other_order, twice_exchanged, "exchanged");
    expect_same(run_query(without_culling, questions), expected, "without culling");
  }

  Random random{20263};
  const ShapeSetPlan plan{.depths = {0, 3, all_depths}, .heights = true};
  const std::vector<Shape> shapes = test::bodies_with_heights(random);
  const ShapeSet set{shapes, plan};
  const ShapeSet without_culling{shapes, {.depths = plan.depths, .culling = false, .heights = true}};
  test::BruteForce reference{shapes, plan};
};

/// Anywhere, near tangent, and far from the origin.
TEST_F(AgentsWithHeights, AreAnsweredAsBruteForceSays) {
  for (const std::uint32_t pairs : {255u, test::samples(3'000)})
    expect_as_brute_force(random_scene(random, set, pairs));
  PairScene tangent = random_scene(random, set, test::samples(2'000));
  make_tangent(random, tangent, [&](const Agents& agents, Pair pair) {
    return reference.collisions.boundary(agents, pair, baselines::Method::depth_first);
  });
  expect_as_brute_force(tangent);
  PairScene far = random_scene(random, set, test::samples(2'000));
  test::move_away(far, 1e7, -8e8);
  expect_as_brute_force(far);
}

/// What a crowd finds by itself on floors three metres apart: as all pairs of agents one by one.
TEST_F(AgentsWithHeights, AreFoundByACrowd) {
  test::Crowd crowd;
  for (int i = 0; i < 400; ++i) {
    crowd.add({random.below(set.shape_count()), random.uniform(0, 7), random.uniform(0, 7),
               random.uniform(-4, 4), static_cast<std::uint8_t>(random.below(3))});
    crowd.z.push_back(3.0 * random.below(4) + random.uniform(0, 0.5));
  }
  const Agents agents = crowd.agents();
  Agents on_one_ground = agents;
  on_one_ground.z = {};
  std::vector<Pair> expected = test::candidate_pairs(set, on_one_ground, 0.5);
  const std::size_t on_all_floors = expected.size();
  std::erase_if(expected, [&](Pair pair) { return !heights_meet(crowd, pair); });
  EXPECT_EQ(test::candidate_pairs(set, agents, 0.5), expected);
  EXPECT_LT(expected.size(), on_all_floors * 3 / 4);

  const auto all_pairs = [](auto keeps) {
    std::vector<Pair> kept = test::all_pairs(400);
    std::erase_if(kept, [&](Pair pair) { return !keeps(pair); });
    return kept;
  };
  bch::Crowd finder;
  const std::vector<Pair> hits = all_pairs([&](Pair pair) {
    std::uint8_t hit = 0;
    collide(set, agents, {&pair, 1}, {&hit, 1});
    return hit != 0;
  });
  EXPECT_GT(hits.size(), 50u);
  EXPECT_EQ(test::sorted(finder.collisions(set, agents).span()), hits);
  EXPECT_EQ(test::sorted(finder.penetrations(set, agents).pairs.span()), hits);
  EXPECT_EQ(test::sorted(finder.contacts(set, agents).pairs.span()), all_pairs([&](Pair pair) {
              return !finder.contacts(set, agents, {&pair, 1})[0].empty();
            }));
  EXPECT_EQ(test::sorted(finder.clearances(set, agents, {.max_distance = 0.25}).pairs.span()),
            all_pairs([&](Pair pair) {
              float distance = 0;
              clearance(set, agents, {&pair, 1}, {{&distance, 1}});
              return distance <= 0.25f;
            }));
}

/// What a frame does: shapes one by one into another set.
TEST_F(AgentsWithHeights, OfADynamicSetAreThoseOfASet) {
  std::vector<Shape> others = shapes;
  std::rotate(others.begin(), others.begin() + 5, others.end());
  DynamicShapeSet dynamic{ShapeSet(others, plan)};
  BuiltShape prepared(plan);
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    prepared.prepare(shapes[i], i);
    if (!dynamic.try_replace(i, prepared)) dynamic.replace(i, prepared);
  }
  Questions questions = questions_about(random, set, random_scene(random, set, 2'000));
  test::raise(random, questions.crowd);
  expect_same(run_query(dynamic.set(), questions), run_query(set, questions), "dynamic");
}

/// A box of a metre and a half, and another one on the ground z above its own.
class TwoBoxes : public testing::Test {
 protected:
  static ShapeSet boxes(bool heights) {
    Shape box = test::contour_shape(test::polygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}), 0.1f);
    box.heights = {0, 1.5f};
    return ShapeSet(std::vector<Shape>{box}, {.heights = heights});
  }

  std::uint8_t hit(const ShapeSet& set, std::vector<double> z) {
    scene.crowd.z = std::move(z);
    std::uint8_t hit = 77;
    collide(set, scene.crowd.agents(), scene.pairs, {&hit, 1});
    return hit;
  }

  PairScene scene{{{0, 0}, {0, 0.5}, {0, 0}, {0, 0}, {0, 0}, {}}, {{0, 1}}};
};

TEST_F(TwoBoxes, MeetWhereTheirHeightsTouch) {
  const ShapeSet set = boxes(true);
  for (const auto& [z, expected] : {std::pair(1.5, 1), {1.5 + 1e-6, 0}, {-1.5, 1}, {-1.6, 0}})
    EXPECT_EQ(hit(set, {1e6, 1e6 + z}), expected) << z;
}

TEST_F(TwoBoxes, NeedASetWithHeightsAndAZEach) {
  const ShapeSet set = boxes(true), flat = boxes(false);
  const auto complaint = [&](const ShapeSet& of, const std::vector<double>& z) {
    return test::complaint([&] { hit(of, z); });
  };
  EXPECT_EQ(complaint(flat, {0, 0}), "agents: expected no z for a set without heights, found some");
  EXPECT_EQ(complaint(set, {0, NAN}), "pair 0: agent 1: expected a z within +-1e9 m, found nan");
  EXPECT_EQ(complaint(set, {0}), "agents: expected 2 values of z, one per shape, found 1");
  EXPECT_EQ(complaint(set, {}), "accepted");
  Shape upside_down = shape_from_discs(std::vector<Disc>{{0, 0, 0.2f}});
  upside_down.heights = {1, 0};
  EXPECT_EQ(test::complaint([&] { ShapeSet(std::vector<Shape>{upside_down}, {.heights = true}); }),
            "shape set: shape 0: heights: from 1 to 0 m");
}

}  // namespace
}  // namespace bch
