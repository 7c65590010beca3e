// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <bch/broad_phase.hpp>

#include "tests/support/allocation_count.hpp"
#include "tests/support/c_api.hpp"
#include "tests/support/c_api_faults.hpp"
#include "tests/support/scenes.hpp"

// Queries of the C interface that lack memory.

namespace bch {
namespace {

using test::Attempt;
using test::CApiAllocationFaults;
using test::expect_ok;
using test::fail_each;
using test::fail_each_making;
using test::made;

TEST_F(CApiAllocationFaults, BroadPhase) {
  EXPECT_GT(fail_each_making(bch_broad_phase_create, bch_broad_phase_free), 1u);
  EXPECT_GT(fail_each([&](Attempt& attempt) {
              const auto phase = made<test::OwnedBroadPhase>(bch_broad_phase_create);
              const bch_pair* pairs = nullptr;
              std::size_t count = 9;
              attempt(
                  [&] {
                    return bch_broad_phase_find(phase.get(), set.get(), &agents, 0, &one_thread, &pairs,
                                                &count);
                  },
                  [&] { return pairs == nullptr && count == 9; });
              EXPECT_EQ(count, candidate_pairs(set_of_shapes, crowd.agents()).size());
            }),
            4u);
}

TEST_F(CApiAllocationFaults, CrowdCollider) {
  EXPECT_GT(fail_each_making(bch_crowd_collider_create, bch_crowd_collider_free), 1u);
  const auto walls = made<test::OwnedObstacles>(
      [](bch_obstacles** to) { return bch_obstacles_from_wkt("LINESTRING(0 0, 2 2, 4 1)", 0, to); });
  for (const bool with_walls : {false, true}) {
    std::uint64_t expected = 0;
    EXPECT_GT(fail_each([&](Attempt& attempt) {
                const auto collider = made<test::OwnedCollider>(bch_crowd_collider_create);
                bch_index_rows rows{9, nullptr, nullptr}, touched = rows;
                attempt(
                    [&] {
                      return bch_crowd_collider_collide_all(collider.get(), set.get(), &agents,
                                                            with_walls ? walls.get() : nullptr, &one_thread,
                                                            &rows, with_walls ? &touched : nullptr);
                    },
                    [&] { return rows.rows == 9 && touched.rows == 9; });
                const std::uint64_t found = rows.offsets[rows.rows];
                if (expected == 0) expected = found;
                EXPECT_GT(found, 50u);
                EXPECT_EQ(found, expected);
              }),
              5u);
  }
}

TEST_F(CApiAllocationFaults, Contacts) {
  EXPECT_GT(fail_each_making(bch_contact_finder_create, bch_contact_finder_free), 1u);
  const std::vector<Pair> pairs = candidate_pairs(set_of_shapes, crowd.agents());
  for (const bool of_all : {false, true})
    EXPECT_GT(
        fail_each([&](Attempt& attempt) {
          const auto finder = made<test::OwnedFinder>(bch_contact_finder_create);
          bch_contact_rows rows{9, nullptr, nullptr, nullptr};
          attempt(
              [&] {
                return of_all
                           ? bch_contact_finder_find_all(finder.get(), set.get(), &agents, &one_thread, &rows)
                           : bch_contact_finder_find(finder.get(), set.get(), &agents, test::c_pairs(pairs),
                                                     pairs.size(), &one_thread, &rows);
              },
              [&] { return rows.rows == 9 && rows.offsets == nullptr; });
          EXPECT_EQ(rows.rows, pairs.size());
        }),
        1u);
}

TEST_F(CApiAllocationFaults, Obstacles) {
  const auto read = [](bch_obstacles** to) {
    return bch_obstacles_from_wkt_at(
        "LINESTRING(0 0, 5 5, 9 1) POLYGON((2 2, 4 2, 4 4, 2 4), (2.5 2.5, 3 2.5, 3 3))", 1, -1, 3, to);
  };
  EXPECT_GT(fail_each_making(read, bch_obstacles_free), 10u);
  const double x[] = {0, 1, 1}, y[] = {0, 0, 1};
  const std::uint64_t paths[] = {0, 2, 3};
  bch_obstacle_arrays arrays = BCH_OBSTACLE_ARRAYS_INIT;
  arrays.x = x, arrays.y = y, arrays.path_offsets = paths, arrays.path_count = 2;
  EXPECT_GT(fail_each_making([&](bch_obstacles** to) { return bch_obstacles_create(&arrays, to); },
                             bch_obstacles_free),
            5u);
  const auto walls = made<test::OwnedObstacles>(read);
  std::vector<std::uint8_t> hits(agents.count);
  EXPECT_GT(
      fail_each([&](Attempt& attempt) {
        hits.assign(hits.size(), 77);
        attempt(
            [&] { return bch_obstacles_collide(set.get(), &agents, walls.get(), &one_thread, hits.data()); },
            [&] { return std::count(hits.begin(), hits.end(), 77) == 100; });
        EXPECT_EQ(std::count(hits.begin(), hits.end(), 77), 0);
      }),
      1u);
  // Answers of several arrays are there, or in none of them.
  const float none = 77;
  std::vector<float> distance(agents.count);
  std::vector<bch_vec2> direction(agents.count);
  bch_clearance_out out = BCH_CLEARANCE_OUT_INIT;
  out.distance = distance.data(), out.direction = direction.data();
  EXPECT_GT(fail_each([&](Attempt& attempt) {
              distance.assign(agents.count, none), direction.assign(agents.count, {none, none});
              attempt(
                  [&] { return bch_obstacles_clearance(set.get(), &agents, walls.get(), &one_thread, &out); },
                  [&] {
                    return std::count(distance.begin(), distance.end(), none) == 100 &&
                           std::all_of(direction.begin(), direction.end(),
                                       [&](const bch_vec2& of) { return of.x == none && of.y == none; });
                  });
              EXPECT_EQ(std::count(distance.begin(), distance.end(), none), 0);
            }),
            2u);
}

/// Pairs of bodies at different heights, for which clearances and times need memory.
TEST_F(CApiAllocationFaults, PairsAtDifferentHeights) {
  const std::vector<Pair> pairs = candidate_pairs(set_of_shapes, crowd.agents(), 1);
  crowd.z.assign(crowd.x.size(), 0);
  crowd.z[1] = 0.5;
  agents = test::c_agents(crowd);
  std::vector<float> answers(pairs.size());
  const std::vector<double> way(pairs.size(), 0.5);
  bch_clearance_out out = BCH_CLEARANCE_OUT_INIT;
  out.distance = answers.data();
  for (const bool times : {false, true})
    EXPECT_GT(fail_each([&](Attempt& attempt) {
                answers.assign(answers.size(), 77);
                const auto left = [&] {
                  return static_cast<std::size_t>(std::count(answers.begin(), answers.end(), 77));
                };
                attempt(
                    [&] {
                      return times
                                 ? bch_time_of_impact(set.get(), &agents, test::c_pairs(pairs), pairs.size(),
                                                      way.data(), way.data(), &one_thread, answers.data())
                                 : bch_clearance(set.get(), &agents, test::c_pairs(pairs), pairs.size(),
                                                 &one_thread, &out);
                    },
                    [&] { return left() == answers.size(); });
                EXPECT_EQ(left(), 0u);
              }),
              2u);
}

TEST_F(CApiAllocationFaults, WhatASetTells) {
  std::vector<bch_disc> discs(1'000);
  std::size_t count = 0;
  EXPECT_GT(
      fail_each([&](Attempt& attempt) {
        count = 77;
        attempt([&] { return bch_shape_set_get_discs(set.get(), 0, 2, discs.data(), discs.size(), &count); },
                [&] { return count == 77; });
        EXPECT_EQ(count, set_of_shapes.discs(0, 2).size());
      }),
      0u);
  std::uint32_t begin[2];
  EXPECT_GT(fail_each([&](Attempt& attempt) {
              begin[0] = 77;
              attempt([&] { return bch_shape_set_get_slab_offsets(set.get(), 0, 2, begin); },
                      [&] { return begin[0] == 77; });
              EXPECT_EQ(begin[0], 0u);
            }),
            0u);
  EXPECT_GT(fail_each([&](Attempt& attempt) {
              count = 77;
              attempt([&] { return bch_shape_set_verify(set.get(), 10, nullptr, nullptr, &count); },
                      [&] { return count == 77; });
              EXPECT_EQ(count, 0u);
            }),
            2u);
  std::vector<double> densities(agents.count);
  EXPECT_GT(fail_each([&](Attempt& attempt) {
              densities[0] = -1;
              attempt(
                  [&] { return bch_local_densities(agents.x, agents.y, agents.count, 1, densities.data()); },
                  [&] { return densities[0] == -1; });
              EXPECT_GT(densities[0], 0);
            }),
            1u);
}

/// The threads that a call asks for are made where there is memory for them.
TEST_F(CApiAllocationFaults, Threads) {
  std::vector<std::uint8_t> hits(1);
  const bch_pair pair{0, 1};
  bch_query_options two = one_thread;
  two.threads = 2;
  EXPECT_GT(fail_each([&](Attempt& attempt) {
              const auto ask = [&](const bch_query_options& by) {
                return bch_collide(set.get(), &agents, &pair, 1, &by, hits.data());
              };
              expect_ok(ask(two));
              hits[0] = 77;
              attempt([&] { return ask(one_thread); }, [&] { return hits[0] == 77; });
              EXPECT_NE(hits[0], 77);
            }),
            0u);
}

/// A mistake that there is no memory to describe.
TEST_F(CApiAllocationFaults, Messages) {
  for (const bool memory : {true, false}) {
    float radius = 0;
    test::fail_allocations(memory ? test::Failing::none : test::Failing::all, 0);
    const bch_status status = bch_shape_set_get_radius(nullptr, 0, &radius);
    const bch_status far = bch_shape_set_get_radius(set.get(), 1'000, &radius);
    test::stop_failing_allocations();
    EXPECT_TRUE(status == BCH_INVALID_ARGUMENT || (!memory && status == BCH_NO_MEMORY)) << status;
    EXPECT_EQ(far, memory ? BCH_OUT_OF_RANGE : BCH_NO_MEMORY);
  }
}

}  // namespace
}  // namespace bch
