// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cstdio>

#include "tests/support/baseline_scene.hpp"
#include "tests/support/test.hpp"

// What theory says of limited depth: exact hits stay hits at every depth.

namespace bch {
namespace {

using baselines::Body;
using baselines::Structure;
using test::PairScene;

class Depths : public testing::Test {
 protected:
  std::array<Character, 2> people{default_male(), default_female()};
  std::vector<Body> bodies = test::posed_bodies({people.begin(), people.end()}, 5);

  std::vector<std::uint8_t> hits(const Structure& structure, const PairScene& scene,
                                 std::uint32_t depth = all_depths) {
    std::vector<std::uint8_t> result(scene.pairs.size());
    structure.query(scene.crowd.agents(), scene.pairs, result, depth);
    return result;
  }
};

TEST_F(Depths, ExactHitsStayHitsAtEveryDepth) {
  const PairScene scene = test::placements(31, bodies, 20'000);
  std::printf("seed 31, %zu placements\n", scene.pairs.size());
  for (const baselines::Kind& kind : baselines::kinds()) {
    const auto structure = kind.build(bodies, {});
    const auto deepest = hits(*structure, scene);
    if (!kind.has_depth) {
      EXPECT_EQ(hits(*structure, scene, 2), deepest) << kind.name;
      continue;
    }
    EXPECT_EQ(hits(*structure, scene, 100), deepest) << kind.name;
    if (kind.name == "paper_descent") continue;  // what it hits depends on its way down
    // Boxes stick out of those above, so single answers may come back; numbers shrink.
    const bool only_shrinks = kind.name == "reference" || kind.name == "bch_projected";
    std::vector<std::uint8_t> before(deepest.size(), 1);
    for (const std::uint32_t depth : {0u, 1u, 2u, 3u, 4u, 6u, 8u, 12u}) {
      const auto at_depth = hits(*structure, scene, depth);
      for (std::size_t i = 0; i < deepest.size(); ++i)
        ASSERT_TRUE(at_depth[i] >= deepest[i] && (!only_shrinks || at_depth[i] <= before[i]))
            << kind.name << " to depth " << depth << ", " << test::replay_line(scene, i);
      EXPECT_LE(std::count(at_depth.begin(), at_depth.end(), 1),
                std::count(before.begin(), before.end(), 1) + (test::replaying() ? 1 : 20))
          << kind.name << " to depth " << depth;
      before = at_depth;
    }
  }
}

TEST_F(Depths, DiscsAloneCoverTheTrianglesTheyStandFor) {
  const PairScene scene = test::placements(34, bodies, 20'000);
  std::printf("seed 34, %zu placements\n", scene.pairs.size());
  const baselines::Kind& kind = baselines::kind("bch_projected");
  const auto exact = kind.build(bodies, {}), discs = kind.build(bodies, {.projected_triangles = false});
  EXPECT_LT(discs->bytes(0), exact->bytes(0));
  const auto with = hits(*exact, scene), without = hits(*discs, scene);
  for (std::size_t i = 0; i < with.size(); ++i) ASSERT_GE(without[i], with[i]) << test::replay_line(scene, i);
  if (!test::replaying()) {
    EXPECT_GT(std::count(without.begin(), without.end(), 1), std::count(with.begin(), with.end(), 1));
  }
}

}  // namespace
}  // namespace bch
