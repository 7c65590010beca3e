// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <bch/clearance.hpp>

#include "baselines/clearance_reference.hpp"
#include "baselines/oracle.hpp"
#include "baselines/reference.hpp"
#include "kernel/simd/gaps.hpp"
#include "tests/support/clearances.hpp"
#include "tests/support/differential.hpp"

namespace bch {
namespace {

using baselines::Method;
using test::PairScene;
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();

using Hits = std::vector<std::uint8_t>;

Hits hits_within(const ShapeSet& set, const PairScene& scene, std::span<const double> distances,
                 const QueryOptions& options = {}) {
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
  baselines::ClearanceReference reference{shapes, plan};
  baselines::Reference collisions{shapes, plan, Leaves::discs};
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

  void expect_equal_to_brute_force(const PairScene& scene, const std::vector<double>& distances) {
    const Agents agents = scene.crowd.agents();
    Hits boundary, solid;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const bool near = reference.within(agents, scene.pairs[i], distances[i], Method::brute_force);
      boundary.push_back(near);
      solid.push_back(near || collisions.solid(agents, scene.pairs[i], Method::depth_first));
    }
    for (const auto& implementation : implementations()) {
      if (!implementation.supported()) continue;
      for (const auto& [semantics, expected] :
           {std::pair(Semantics::boundary, &boundary), std::pair(Semantics::solid, &solid)}) {
        const Hits found = hits_within(set, scene, distances, {semantics, &implementation});
        for (std::size_t i = 0; i < found.size(); ++i)
          ASSERT_EQ(found[i], (*expected)[i])
              << implementation.name << ", " << static_cast<int>(semantics) << ", pair " << i << ": shapes "
              << agents.shape[2 * i] << " and " << agents.shape[2 * i + 1] << ", " << distances[i] << " m";
      }
    }
  }
};

std::string name_of(const testing::TestParamInfo<SetKind>& kind) {
  return kind.param.name;
}
INSTANTIATE_TEST_SUITE_P(Sets, Within, testing::ValuesIn(set_kinds), name_of);

TEST_P(Within, EqualsBruteForce) {
  for (const double apart : {0.3, 1.0, 30.0, 1e4, 9e8}) {
    const PairScene scene = scene_of(5'000, apart);
    expect_equal_to_brute_force(scene, near_clearances(scene));
    expect_equal_to_brute_force(scene, std::vector<double>(scene.pairs.size(), 0.1));
  }
}

TEST_P(Within, EqualsBruteForceFarFromTheOrigin) {
  PairScene scene = scene_of(4'000);
  const std::vector<double> distances = near_clearances(scene);
  test::move_away(scene, 1e7, -8e8);
  expect_equal_to_brute_force(scene, distances);
}

TEST_P(Within, TheReferencesAgree) {
  const PairScene scene = scene_of(4'000);
  const std::vector<double> distances = near_clearances(scene);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i)
    ASSERT_EQ(reference.within(scene.crowd.agents(), scene.pairs[i], distances[i], Method::brute_force),
              reference.within(scene.crowd.agents(), scene.pairs[i], distances[i], Method::depth_first))
        << i;
}

/// What clearance.hpp says of both, at distances around the clearances.
TEST_P(Within, AgreesWithClearanceButForItsMargin) {
  const PairScene scene = scene_of(40'000);
  const Agents agents = scene.crowd.agents();
  const test::Answers apart = test::answers(set, agents, scene.pairs, infinity);
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

TEST_P(Within, BatchesThreadsAndTheOrderOfAPairDoNotMatter) {
  PairScene scene = scene_of(4'000);
  const std::vector<double> distances = near_clearances(scene);
  const Hits whole = hits_within(set, scene, distances);
  for (const std::size_t size : {0, 1, 17, 255, 257, 2049})
    for (const std::size_t begin : {0, 3}) {
      Hits part(size);
      within(set, scene.crowd.agents(), std::span(scene.pairs).subspan(begin, size),
             std::span(distances).subspan(begin, size), part);
      EXPECT_EQ(part, Hits(whole.begin() + static_cast<std::ptrdiff_t>(begin),
                           whole.begin() + static_cast<std::ptrdiff_t>(begin + size)));
    }
  for (Pair& pair : scene.pairs) std::swap(pair.first, pair.second);
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  for (const int threads : {1, 2, 8}) {
    tbb::task_arena arena(threads);
    EXPECT_EQ(arena.execute([&] { return hits_within(set, scene, distances); }), whole);
  }
}

TEST(WithinInput, ManyShapesAnswerLikeOneOfEach) {
  Random random(2703);
  const std::vector<Shape> shapes = test::synthetic_shapes(2704, 40);
  PairScene scene = random_scene(random, ShapeSet(shapes), 5'000);
  for (std::uint8_t& level : scene.crowd.level) level = 0;
  const double distance = 0.2;
  const Hits of_one = hits_within(ShapeSet(shapes), scene, {&distance, 1});
  const ShapeSet large(test::repeated(shapes));
  for (std::size_t i = 0; i < scene.crowd.shape.size(); ++i)
    scene.crowd.shape[i] += static_cast<std::uint32_t>(i * shapes.size() % large.shape_count());
  EXPECT_EQ(hits_within(large, scene, {&distance, 1}), of_one);
}

TEST(WithinInput, IsRejectedBeforeAnythingIsWritten) {
  const ShapeSet set(test::synthetic_shapes(1, 2));
  test::Crowd crowd;
  crowd.add({0, 0, 0, 0, 0});
  crowd.add({1, 1, 0, 0, 0});
  std::vector<Pair> pairs = {{0, 1}, {1, 0}};
  Hits hits(2, 42);
  const auto expect_rejected = [&](const std::string& message, const std::vector<double>& distances,
                                   const QueryOptions& options = {}, std::size_t size = 2) {
    try {
      within(set, crowd.agents(), pairs, distances, std::span(hits).first(size), options);
      FAIL() << "accepted; expected: " << message;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
    EXPECT_EQ(hits, Hits(2, 42));
  };
  expect_rejected("within: a distance of nan m", {std::nan("")});
  expect_rejected("within: a distance of -0.5 m", {-0.5});
  expect_rejected("within: pair 1: a distance of -1 m", {1, -1});
  expect_rejected("within: 2 pairs but 0 distances", {});
  expect_rejected("within: 2 pairs but 3 distances", {1, 1, 1});
  expect_rejected("within: 2 pairs but 1 answers", {1}, {}, 1);
  expect_rejected("within: no semantics is 2", {1}, {static_cast<Semantics>(2)});
  crowd.y[0] = infinity;
  expect_rejected("pair 0: agent 0: position (0, inf)", {1});
}

}  // namespace
}  // namespace bch
