// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <vector>

#include <bch/broad_phase.hpp>
#include <bch/clearance.hpp>
#include <bch/collide.hpp>
#include <bch/contacts.hpp>
#include <bch/penetration.hpp>
#include <bch/time_of_impact.hpp>

#include "tests/support/allocation_count.hpp"
#include "tests/support/scenes.hpp"

namespace bch {
namespace {

class Allocations : public testing::TestWithParam<int> {
 protected:
  Allocations() {
    test::Random random(52);
    for (int i = 0; i < 30'000; ++i)
      crowd.add({random.below(16), random.uniform(0, 300), random.uniform(0, 300), random.uniform(-4, 4),
                 static_cast<std::uint8_t>(random.below(3))});
  }

  /// Some tasks' worth: each pair takes microseconds.
  std::vector<Pair> some_pairs() const {
    std::vector<Pair> pairs = candidate_pairs(set, crowd.agents());
    pairs.resize(5'000);
    return pairs;
  }

  /// Of later calls, the first being over.
  template <class Call>
  std::size_t count(Call call) {
    return arena.execute([&] {
      call();
      const std::size_t before = test::allocation_count();
      for (int i = 0; i < 5; ++i) call();
      return test::allocation_count() - before;
    });
  }

  const tbb::global_control allow{tbb::global_control::max_allowed_parallelism, 4};
  tbb::task_arena arena{GetParam()};
  const ShapeSet set{test::synthetic_shapes(51, 16), {{0, 3, all_depths}, true}};
  test::Crowd crowd;
};

TEST_P(Allocations, BroadPhaseKeepsItsMemory) {
  BroadPhase broad_phase;
  std::size_t pairs = 0;
  EXPECT_EQ(count([&] { pairs = broad_phase.find(set, crowd.agents()).size(); }), 0u);
  EXPECT_GT(pairs, 20'000u);
  EXPECT_GT(count([&] { candidate_pairs(set, crowd.agents()); }), 0u);  // they are really counted
}

TEST_P(Allocations, CollideNeedsNone) {
  const std::vector<Pair> pairs = candidate_pairs(set, crowd.agents());
  std::vector<std::uint8_t> hits(pairs.size());
  for (const Semantics semantics : {Semantics::boundary, Semantics::solid})
    EXPECT_EQ(count([&] { collide(set, crowd.agents(), pairs, hits, {semantics}); }), 0u);
}

TEST_P(Allocations, CollideAllKeepsItsMemory) {
  CrowdCollider collider;
  std::size_t neighbours = 0;
  EXPECT_EQ(count([&] { neighbours = collider.collide_all(set, crowd.agents()).values.size(); }), 0u);
  EXPECT_GT(neighbours, 20'000u);
}

TEST_P(Allocations, ContactsKeepTheirMemory) {
  const std::vector<Pair> pairs = some_pairs();
  ContactFinder finder;
  std::size_t found = 0;
  EXPECT_EQ(count([&] { found = finder.find(set, crowd.agents(), pairs).values.size(); }), 0u);
  EXPECT_GT(found, pairs.size());
}

TEST_P(Allocations, ContactsOfACrowdOfBodiesOfDiscsKeepTheirMemory) {
  const std::vector<Disc> body = {
      {0, 0, 0.2f}, {0, 0.15f, 0.15f}, {0, -0.15f, 0.15f}, {0, 0.3f, 0.1f}, {0, -0.3f, 0.1f}};
  const ShapeSet bodies(std::vector<Shape>(1, shape_from_discs(body)));
  test::Crowd people;
  for (std::uint32_t i = 0; i < 150; ++i) people.add({0, 0.4 * (i % 15), 0.5 * (i / 15), 0.1 * i, 0});
  ContactFinder finder;
  std::size_t found = 0;
  EXPECT_EQ(count([&] { found = finder.find_all(bodies, people.agents()).contacts.values.size(); }), 0u);
  EXPECT_GT(found, 150u);
}

TEST_P(Allocations, PenetrationNeedsNone) {
  const std::vector<Pair> pairs = some_pairs();
  const std::vector<Vec2> directions(pairs.size(), Vec2{1, 2});
  std::vector<Penetration> ways(pairs.size());
  EXPECT_EQ(count([&] { penetration(set, crowd.agents(), pairs, 16, ways); }), 0u);
  EXPECT_EQ(count([&] { penetration_along(set, crowd.agents(), pairs, directions, ways); }), 0u);
}

TEST_P(Allocations, DistancesAndTimesNeedNone) {
  const std::vector<Pair> pairs = some_pairs();
  std::vector<float> values(pairs.size());
  std::vector<Vec2> directions(pairs.size());
  std::vector<DiscPair> nodes(pairs.size());
  std::vector<NearestPoints> points(pairs.size());
  const std::vector<double> way(pairs.size(), 0.5);
  for (const Leaves leaves : {Leaves::discs, Leaves::segments})
    EXPECT_EQ(count([&] {
                clearance(set, crowd.agents(), pairs, {values, directions, nodes, points},
                          {.max_distance = 0.5, .distance_leaves = leaves});
              }),
              0u);
  EXPECT_EQ(count([&] { time_of_impact(set, crowd.agents(), pairs, {way, way}, values); }), 0u);
  std::vector<std::uint8_t> hits(pairs.size());
  EXPECT_EQ(count([&] { within(set, crowd.agents(), pairs, way, hits); }), 0u);
}

/// On one ground, and at different heights.
TEST_P(Allocations, BodiesInSlabsNeedNoneEither) {
  const std::vector<Shape> parts = test::synthetic_shapes(51, 16);
  std::vector<Shape> bodies(parts.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i].slabs = {parts[i], parts[(i + 1) % 16], {}};
  const ShapeSet cut(bodies, {.depths = {0, 3, all_depths}, .slices = {0.4f, 1}});
  const std::vector<Pair> pairs = some_pairs();
  const std::vector<double> distance(pairs.size(), 0.5);
  std::vector<std::uint8_t> hits(pairs.size());
  std::vector<Penetration> ways(pairs.size());
  CrowdCollider collider;
  ContactFinder finder;
  for (const double step : {0.0, 0.3}) {
    crowd.z.clear();
    for (std::size_t i = 0; i < crowd.x.size() && step > 0; ++i)
      crowd.z.push_back(step * static_cast<double>(i % 4));
    EXPECT_EQ(count([&] { collide(cut, crowd.agents(), pairs, hits); }), 0u);
    EXPECT_EQ(count([&] { within(cut, crowd.agents(), pairs, distance, hits); }), 0u);
    EXPECT_EQ(count([&] { penetration(cut, crowd.agents(), pairs, 16, ways); }), 0u);
    EXPECT_EQ(count([&] { collider.collide_all(cut, crowd.agents()); }), 0u);
    EXPECT_EQ(count([&] { finder.find(cut, crowd.agents(), pairs); }), 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, Allocations, testing::Values(1, 2, 4), testing::PrintToStringParamName());

}  // namespace
}  // namespace bch
