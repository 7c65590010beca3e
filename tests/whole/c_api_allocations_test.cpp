// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <vector>

#include <bch/broad_phase.hpp>

#include "tests/support/allocation_count.hpp"
#include "tests/support/c_api.hpp"
#include "tests/support/scenes.hpp"

// Calls of the C interface need no more memory than those of the C++ library: those about pairs none, and objects keep theirs.

namespace bch {
namespace {

using test::expect_ok;
using test::made;

/// By the number of threads that calls ask for.
class CApiAllocations : public testing::TestWithParam<std::uint32_t> {
 protected:
  CApiAllocations() {
    test::Random random(53);
    for (int i = 0; i < 3'000; ++i)
      crowd.add({random.below(16), random.uniform(0, 95), random.uniform(0, 95), random.uniform(-4, 4),
                 static_cast<std::uint8_t>(random.below(3))});
    agents = test::c_agents(crowd);
    options.threads = GetParam();
    pairs = candidate_pairs(shapes, crowd.agents());
    if (pairs.size() > 2'000) pairs.resize(2'000);
  }

  /// Of later calls, the first being over.
  template <class Call>
  std::size_t count(Call call) {
    expect_ok(call());
    const std::size_t before = test::allocation_count();
    for (int i = 0; i < 5; ++i) expect_ok(call());
    return test::allocation_count() - before;
  }

  const ShapeSet shapes{test::synthetic_shapes(54, 16), {{0, 3, all_depths}, true}};
  const test::OwnedSet set = test::c_set(shapes);
  test::Crowd crowd;
  bch_agents agents;
  std::vector<Pair> pairs;
  bch_query_options options = BCH_QUERY_OPTIONS_INIT;
};

TEST_P(CApiAllocations, QueriesOfPairsNeedNone) {
  const std::size_t n = pairs.size();
  const bch_pair* const of = test::c_pairs(pairs);
  EXPECT_GT(n, 1'000u);
  std::vector<std::uint8_t> hits(n);
  std::vector<float> values(n);
  std::vector<bch_vec2> directions(n);
  std::vector<bch_disc_pair> discs(n);
  std::vector<bch_nearest_points> points(n);
  std::vector<bch_penetration_depth> depths(n);
  const std::vector<double> way(n, 0.5);
  const std::vector<bch_vec2> along(n, {1, 2});
  bch_clearance_out out = BCH_CLEARANCE_OUT_INIT;
  out.distance = values.data(), out.direction = directions.data();
  out.discs = discs.data(), out.points = points.data();
  const bch_shape_set* const in = set.get();
  EXPECT_EQ(count([&] { return bch_validate_agents(in, &agents); }), 0u);
  EXPECT_EQ(count([&] { return bch_collide(in, &agents, of, n, &options, hits.data()); }), 0u);
  EXPECT_EQ(count([&] { return bch_within(in, &agents, of, n, way.data(), n, &options, hits.data()); }), 0u);
  EXPECT_EQ(count([&] { return bch_clearance(in, &agents, of, n, &options, &out); }), 0u);
  EXPECT_EQ(count([&] { return bch_penetration(in, &agents, of, n, 16, &options, depths.data()); }), 0u);
  EXPECT_EQ(
      count([&] { return bch_penetration_along(in, &agents, of, n, along.data(), &options, depths.data()); }),
      0u);
  EXPECT_EQ(count([&] {
              return bch_time_of_impact(in, &agents, of, n, way.data(), way.data(), &options, values.data());
            }),
            0u);
  options.implementation = "scalar";
  EXPECT_EQ(count([&] { return bch_collide(in, &agents, of, n, &options, hits.data()); }), 0u);
}

TEST_P(CApiAllocations, ObjectsKeepTheirMemory) {
  const auto phase = made<test::OwnedBroadPhase>(bch_broad_phase_create);
  const bch_pair* found = nullptr;
  std::size_t number = 0;
  EXPECT_EQ(count([&] {
              return bch_broad_phase_find(phase.get(), set.get(), &agents, 0, &options, &found, &number);
            }),
            0u);
  EXPECT_GT(number, 1'000u);
  const auto collider = made<test::OwnedCollider>(bch_crowd_collider_create);
  bch_index_rows rows{};
  EXPECT_EQ(count([&] {
              return bch_crowd_collider_collide_all(collider.get(), set.get(), &agents, nullptr, &options,
                                                    &rows, nullptr);
            }),
            0u);
  EXPECT_EQ(rows.rows, agents.count);
  const auto finder = made<test::OwnedFinder>(bch_contact_finder_create);
  bch_contact_rows contacts{};
  EXPECT_EQ(count([&] {
              return bch_contact_finder_find(finder.get(), set.get(), &agents, test::c_pairs(pairs),
                                             pairs.size(), &options, &contacts);
            }),
            0u);
  EXPECT_EQ(contacts.rows, pairs.size());
  EXPECT_GT(count([] {  // they are really counted
              bch_broad_phase* made = nullptr;
              expect_ok(bch_broad_phase_create(&made));
              return bch_broad_phase_free(made);
            }),
            0u);
}

INSTANTIATE_TEST_SUITE_P(Threads, CApiAllocations, testing::Values(0, 1, 2, 4),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace bch
