// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/collide.hpp>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#include "baselines/reference.hpp"
#include "tests/support/scenes.hpp"

namespace bch {
namespace {

using baselines::Method;
using baselines::Reference;

using AllRows = std::vector<std::vector<std::uint32_t>>;

AllRows copy_of(const Rows<std::uint32_t>& answer) {
  AllRows rows;
  for (std::uint32_t i = 0; i + 1 < answer.offsets.size(); ++i) {
    const auto row = answer[i];
    rows.emplace_back(row.begin(), row.end());
  }
  return rows;
}

class CollideAll : public testing::Test {
 protected:
  const ShapeSetPlan plan{{0, 3, all_depths}, true};
  const std::vector<Shape> shapes = test::synthetic_shapes(61, 24);  // radii from 1 cm to 4 m
  const ShapeSet set{shapes, plan};
  const Reference reference{shapes, plan};

  test::Crowd crowd_of(std::uint32_t agents, double side, std::uint64_t seed) const {
    test::Random random(seed);
    test::Crowd crowd;
    for (std::uint32_t i = 0; i < agents; ++i)
      crowd.add({random.below(set.shape_count()), random.uniform(0, side), random.uniform(0, side),
                 random.uniform(-4, 4), static_cast<std::uint8_t>(random.below(set.level_count()))});
    return crowd;
  }

  /// Every agent against every other.
  AllRows expected(const Agents& agents, Semantics semantics) const {
    AllRows rows(agents.size());
    for (std::uint32_t i = 0; i < agents.size(); ++i)
      for (std::uint32_t j = 0; j < agents.size(); ++j) {
        if (i == j) continue;
        if (semantics == Semantics::boundary ? reference.boundary(agents, {i, j}, Method::depth_first)
                                             : reference.solid(agents, {i, j}, Method::depth_first))
          rows[i].push_back(j);
      }
    return rows;
  }
};

TEST_F(CollideAll, EqualsEveryAgentAgainstEveryOther) {
  CrowdCollider collider;
  for (const std::uint32_t size : {400u, 1u, 2u, 150u, 0u}) {
    const test::Crowd crowd = crowd_of(size, 30, size);
    for (const Semantics semantics : {Semantics::boundary, Semantics::solid}) {
      const AllRows rows = expected(crowd.agents(), semantics);
      for (const auto& implementation : implementations()) {
        if (!implementation.supported()) continue;
        EXPECT_EQ(copy_of(collider.collide_all(set, crowd.agents(), {semantics, &implementation})), rows)
            << size << " agents, " << implementation.name;
      }
    }
  }
}

TEST_F(CollideAll, AllInOnePlaceAndNobodyNearAnother) {
  CrowdCollider collider;
  const test::Crowd together = crowd_of(60, 0, 5), apart = crowd_of(60, 1e8, 6);
  const AllRows rows = copy_of(collider.collide_all(set, together.agents(), {Semantics::solid}));
  EXPECT_EQ(rows, expected(together.agents(), Semantics::solid));
  EXPECT_GT(rows[0].size(), 10u);
  EXPECT_EQ(copy_of(collider.collide_all(set, apart.agents())), AllRows(60));
}

TEST_F(CollideAll, AnyNumberOfThreads) {
  const test::Crowd crowd = crowd_of(20'000, 200, 7);
  AllRows alone;
  for (int threads = 1; threads <= 8; ++threads) {
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
    tbb::task_arena arena(threads);
    arena.execute([&] {
      CrowdCollider collider;
      const AllRows rows = copy_of(collider.collide_all(set, crowd.agents()));
      if (alone.empty()) alone = rows;
      EXPECT_EQ(rows, alone) << threads << " threads";
    });
  }
  std::size_t entries = 0;
  for (std::uint32_t i = 0; i < alone.size(); ++i) {
    EXPECT_TRUE(std::is_sorted(alone[i].begin(), alone[i].end()));
    entries += alone[i].size();
    for (const std::uint32_t j : alone[i])
      EXPECT_TRUE(std::binary_search(alone[j].begin(), alone[j].end(), i));
  }
  EXPECT_GT(entries, 20'000u);
}

}  // namespace
}  // namespace bch
