// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/broad_phase.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <limits>

#include "kernel/collide.hpp"
#include "layout/heading.hpp"
#include "layout/rounding.hpp"
#include "tests/scenes.hpp"

namespace bch {
namespace {

const std::vector<Shape> shapes = test::synthetic_shapes(31, 24);
const ShapeSet set(shapes, {{0, 3, all_depths}, false});

test::Crowd crowd_in(double width, double height, std::uint32_t agents, std::uint64_t seed, double x = 0,
                     double y = 0) {
  test::Random random(seed);
  test::Crowd crowd;
  for (std::uint32_t i = 0; i < agents; ++i)
    crowd.add(random.below(set.shape_count()), x + random.uniform(0, width), y + random.uniform(0, height),
              random.uniform(-4, 4), static_cast<std::uint8_t>(random.below(3)));
  return crowd;
}

/// Every pair whose root discs are at most as far apart as their radii and the slack of pruning discs allow.
std::vector<Pair> brute_force(const Agents& agents) {
  const ShapeSetView view = set.view();
  std::vector<Pair> pairs;
  const auto offset = [&](std::size_t i, bool y) {
    const std::size_t root = agents.shape[i] * std::size_t{3} + agents.level[i];
    const Rotation r = rotation(agents.heading[i]);
    const double cx = view.roots[root].x, cy = view.roots[root].y;
    return y ? r.sine * cx + r.cosine * cy : r.cosine * cx - r.sine * cy;
  };
  const auto radius = [&](std::size_t i) {
    return static_cast<double>(view.roots[agents.shape[i] * std::size_t{3} + agents.level[i]].radius) +
           rounding::nesting_margin * static_cast<double>(view.reach[agents.shape[i]]);
  };
  for (std::uint32_t i = 0; i < agents.size(); ++i)
    for (std::uint32_t j = i + 1; j < agents.size(); ++j) {
      const double x = (agents.x[j] - agents.x[i]) + (offset(j, false) - offset(i, false));
      const double y = (agents.y[j] - agents.y[i]) + (offset(j, true) - offset(i, true));
      const double r = radius(i) + radius(j);
      if (x * x + y * y <= r * r) pairs.push_back({i, j});
    }
  return pairs;
}

void expect_equal(const test::Crowd& crowd) {
  EXPECT_EQ(candidate_pairs(set, crowd.agents()), brute_force(crowd.agents()));
}

TEST(BroadPhase, EqualsBruteForce) {
  expect_equal(crowd_in(20, 20, 1500, 1));
  expect_equal(crowd_in(60, 60, 1500, 2, -30, -30));
  expect_equal(crowd_in(400, 0.1, 1000, 3));
  expect_equal(crowd_in(0.01, 0.01, 100, 4));
  expect_equal(crowd_in(1e8, 1e8, 300, 5, -5e7, -5e7));
}

TEST(BroadPhase, FarFromTheOriginItIsTheSame) {
  test::Crowd crowd = crowd_in(20, 20, 1000, 6);
  for (auto* values : {&crowd.x, &crowd.y})
    for (double& at : *values) at = std::round(at * 0x1p20) * 0x1p-20;
  const auto near = candidate_pairs(set, crowd.agents());
  for (double& at : crowd.x) at += 1e7;
  for (double& at : crowd.y) at -= 9e8;
  EXPECT_EQ(candidate_pairs(set, crowd.agents()), near);
  expect_equal(crowd);
}

TEST(BroadPhase, LeavesNoHitOut) {
  const test::Crowd crowd = crowd_in(15, 15, 600, 7);
  std::vector<Pair> all;
  for (std::uint32_t i = 0; i < 600; ++i)
    for (std::uint32_t j = i + 1; j < 600; ++j) all.push_back({i, j});
  std::vector<std::uint8_t> hits(all.size());
  collide(set, crowd.agents(), all, hits);
  const auto candidates = candidate_pairs(set, crowd.agents());
  std::size_t found = 0, next = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    while (next < candidates.size() &&
           (candidates[next].first < all[k].first ||
            (candidates[next].first == all[k].first && candidates[next].second < all[k].second)))
      ++next;
    const bool is_candidate = next < candidates.size() && candidates[next] == all[k];
    EXPECT_TRUE(is_candidate || hits[k] == 0) << all[k].first << ", " << all[k].second;
    found += hits[k];
  }
  EXPECT_GT(found, 100u);
}

TEST(BroadPhase, AnyNumberOfThreads) {
  const test::Crowd crowd = crowd_in(60, 60, 9000, 8);
  const auto expected = candidate_pairs(set, crowd.agents());
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  for (int threads = 1; threads <= 8; ++threads) {
    tbb::task_arena arena(threads);
    EXPECT_EQ(arena.execute([&] { return candidate_pairs(set, crowd.agents()); }), expected) << threads;
  }
}

TEST(BroadPhase, NoAgentsAndBadOnes) {
  test::Crowd crowd;
  EXPECT_TRUE(candidate_pairs(set, crowd.agents()).empty());
  crowd.add(0, 0, 0, 0, 0);
  EXPECT_TRUE(candidate_pairs(set, crowd.agents()).empty());
  crowd.add(0, std::numeric_limits<double>::quiet_NaN(), 0, 0, 0);
  EXPECT_THROW(candidate_pairs(set, crowd.agents()), std::invalid_argument);
  crowd.x[1] = 0;
  crowd.shape[1] = set.shape_count();
  EXPECT_THROW(candidate_pairs(set, crowd.agents()), std::invalid_argument);
}

}  // namespace
}  // namespace bch
