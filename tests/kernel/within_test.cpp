// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/oracle.hpp"
#include "kernel/runtime/all_options.hpp"
#include "kernel/simd/gaps.hpp"
#include "tests/support/clearances.hpp"
#include "tests/support/differential.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using test::PairScene;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

using Hits = std::vector<std::uint8_t>;

Hits hits_within(const ShapeSet& set, const PairScene& scene, std::span<const double> distances,
                 const detail::AllOptions& options = {}) {
  Hits hits(scene.pairs.size());
  within(set, scene.crowd.agents(), scene.pairs, distances, hits, options);
  return hits;
}

/// The sets differ in what lets the kernel skip traversals.
struct SetKind {
  const char* name;
  ShapeSetPlan plan;
};
void PrintTo(const SetKind& kind, std::ostream* out) {
  *out << kind.name;
}
const SetKind set_kinds[] = {{"FourLevels", test::four_levels},
                             {"OneLevel", {}},
                             {"NoCulling", {.depths = {0, 3, 6, all_depths}, .culling = false}},
                             {"RootsAlone", {{0}}}};

class Within : public testing::TestWithParam<SetKind> {
 protected:
  const ShapeSetPlan& plan = GetParam().plan;
  std::vector<Shape> shapes = test::synthetic_shapes(2701, 40);
  ShapeSet set{shapes, plan};
  Random random{2702};

  PairScene scene_of(std::uint32_t pairs, double apart = 1) {
    PairScene scene = random_scene(random, set, pairs);
    for (std::size_t i = 1; i < scene.crowd.x.size(); i += 2)
      scene.crowd.x[i] += random.uniform(-apart, apart);
    return scene;
  }

  /// Draws distances of which many are as the pairs' clearances but for some bits, and some are none or infinite.
  std::vector<double> near_clearances(const PairScene& scene) {
    const test::Answers apart = test::answers(set, scene.crowd.agents(), scene.pairs, infinity);
    std::vector<double> distances;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const double clearance = std::max(0.0, static_cast<double>(apart.distance[i]));
      switch (random.below(8)) {
        case 0:
          distances.push_back(random.uniform(0, 2));
          break;
        case 1:
          distances.push_back(random.below(2) == 0 ? 0 : infinity);
          break;
        default:
          distances.push_back(clearance * (1 + random.uniform(-2e-6, 0.5e-6)));
      }
    }
    return distances;
  }

  /// Returns the sum of the radii of the largest discs of two agents.
  double largest_radii(const Agents& agents, std::size_t first) const {
    double sum = 0;
    for (const std::size_t agent : {first, first + 1}) {
      float largest = 0;
      for (const Disc& disc : set.discs(agents.shape[agent], agents.level[agent]))
        largest = std::max(largest, disc.radius);
      sum += static_cast<double>(largest);
    }
    return sum;
  }
};

std::string name_of(const testing::TestParamInfo<SetKind>& kind) {
  return kind.param.name;
}
INSTANTIATE_TEST_SUITE_P(Sets, Within, testing::ValuesIn(set_kinds), name_of);

/// What pairs.hpp says of both, at distances around the clearances.
TEST_P(Within, AgreesWithClearanceButForItsMargin) {
  const PairScene scene = scene_of(40'000);
  const Agents agents = scene.crowd.agents();
  const test::Answers apart = test::answers(set, agents, scene.pairs, infinity, nullptr, Overlap::zero);
  std::vector<double> distances = near_clearances(scene);
  for (std::size_t i = 0; i < distances.size(); i += 4)
    distances[i] = std::max(0.0, static_cast<double>(apart.distance[i]));  // just so far
  const Hits hits = hits_within(set, scene, distances);
  std::size_t misses = 0, beyond = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const double clearance = apart.distance[i];
    if (clearance <= distances[i]) {
      ASSERT_EQ(hits[i], 1) << i;
    } else if (hits[i]) {
      ASSERT_LE(clearance, distances[i] + detail::gap_price * (distances[i] + largest_radii(agents, 2 * i)))
          << i;
      ++beyond;
    }
    misses += hits[i] == 0;
  }
  EXPECT_GT(misses, hits.size() / 50);
  EXPECT_GT(beyond, hits.size() / 100);  // the margin is looked at
}

TEST_P(Within, AnswersAreOnesWhereOutlinesAreAsClose) {
  const PairScene scene = scene_of(test::samples(600));
  const Agents agents = scene.crowd.agents();
  std::vector<double> distances;
  for (const auto& [a, b] : scene.pairs) {
    const baselines::Oracle outlines(shapes[agents.shape[a]].outline, shapes[agents.shape[b]].outline,
                                     baselines::exact_placement(agents, a, b));
    distances.push_back(std::nextafter(static_cast<double>(outlines.distance()), infinity));
  }
  const Hits hits = hits_within(set, scene, distances);
  for (std::size_t i = 0; i < hits.size(); ++i) EXPECT_EQ(hits[i], 1) << i;
}

TEST_P(Within, OneDistanceServesAllPairs) {
  const PairScene scene = scene_of(3'000);
  for (const double distance : {0.0, 0.1, infinity})
    EXPECT_EQ(hits_within(set, scene, {&distance, 1}),
              hits_within(set, scene, std::vector<double>(scene.pairs.size(), distance)));
  const double all = infinity;
  EXPECT_EQ(hits_within(set, scene, {&all, 1}), Hits(scene.pairs.size(), 1));
}

}  // namespace
}  // namespace bch
