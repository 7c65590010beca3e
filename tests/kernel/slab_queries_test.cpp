// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include "tests/support/clearances.hpp"
#include "tests/support/penetrations.hpp"
#include "tests/support/slab_comparison.hpp"
#include "tests/support/test.hpp"

// Distances, times and contacts of bodies in slabs, and at different heights, against the definition: what the scalar references
// say of every pair of parts that may meet. And all queries again, in other orders, splits and numbers of threads.

namespace bch {
namespace {

using test::MovingScene;

constexpr float never = std::numeric_limits<float>::infinity();
constexpr std::uint32_t directions = 16;

/// The answers of all queries, row after row.
struct AllAnswers {
  test::Answers clearances;
  std::vector<float> times;
  std::vector<std::vector<DiscPair>> by_segments, by_discs;
  std::vector<Penetration> best, along;

  void append(const AllAnswers& more) {
    const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    add(clearances.distance, more.clearances.distance);
    add(clearances.direction, more.clearances.direction);
    add(clearances.discs, more.clearances.discs);
    add(times, more.times), add(by_segments, more.by_segments), add(by_discs, more.by_discs);
    add(best, more.best), add(along, more.along);
  }
};

std::vector<std::vector<DiscPair>> contacts_of(bch::Crowd& finder, const ShapeSet& set,
                                               const test::PairScene& scene,
                                               const CollisionOptions& options) {
  const Rows<DiscPair> rows = finder.contacts(set, scene.crowd.agents(), scene.pairs, options);
  std::vector<std::vector<DiscPair>> all;
  for (std::size_t i = 0; i < rows.size(); ++i) all.emplace_back(rows[i].begin(), rows[i].end());
  return all;
}

std::vector<float> times_of(const ShapeSet& set, const MovingScene& scene,
                            const Implementation& implementation) {
  std::vector<float> all(scene.pairs.size(), -1);
  time_of_impact(set, scene.crowd.agents(), scene.pairs, {scene.x, scene.y}, all,
                 {.implementation = &implementation});
  return all;
}

AllAnswers all_answers(const ShapeSet& set, const MovingScene& scene,
                       const Implementation& implementation = best_implementation()) {
  AllAnswers all;
  bch::Crowd finder;
  all.clearances = test::answers(set, scene.crowd.agents(), scene.pairs, never, &implementation);
  all.times = times_of(set, scene, implementation);
  all.by_segments = contacts_of(finder, set, scene, {.implementation = &implementation});
  all.by_discs =
      contacts_of(finder, set, scene, {.leaves = Leaves::discs, .implementation = &implementation});
  all.best = test::best_of(directions, set, scene, implementation);
  all.along = test::along(scene.along, set, scene, implementation);
  return all;
}

void expect_same(const AllAnswers& found, const AllAnswers& expected) {
  ASSERT_EQ(found.times.size(), expected.times.size());
  for (std::size_t i = 0; i < expected.times.size(); ++i) {
    ASSERT_TRUE(found.clearances.same(i, expected.clearances, i)) << i;
    ASSERT_EQ(found.times[i], expected.times[i]) << i;
    ASSERT_EQ(found.by_segments[i], expected.by_segments[i]) << i;
    ASSERT_EQ(found.by_discs[i], expected.by_discs[i]) << i;
    ASSERT_EQ(found.best[i], expected.best[i]) << i;
    ASSERT_EQ(found.along[i], expected.along[i]) << i;
  }
}

class SlabQueries : public test::SlabComparison {
 protected:
  void expect_clearances(const MovingScene& scene, double max_distance) {
    test::Answers expected;
    std::vector<bool> collide;
    for (const Pair pair : scene.pairs) {
      collide.push_back(reference.collide(scene.crowd.agents(), pair));
      const auto [distance, direction, first, second] =
          reference.clearance(scene.crowd.agents(), pair, max_distance);
      expected.distance.push_back(distance), expected.direction.push_back(direction);
      expected.discs.push_back({first, second});
    }
    const auto expect = [&](Overlap overlap, const test::Answers& answers) {
      expect_of_all(
          scene,
          [&](const Implementation& implementation) {
            return test::answers(set, scene.crowd.agents(), scene.pairs, max_distance, &implementation,
                                 overlap);
          },
          [&](const test::Answers& found, std::size_t i) { return found.same(i, answers, i); });
    };
    expect(Overlap::deepest, expected);
    for (std::size_t i = 0; i < collide.size(); ++i)
      if (collide[i]) expected.distance[i] = 0;
    expect(Overlap::zero, test::at_least_zero(expected));
  }
};

INSTANTIATE_TEST_SUITE_P(Three, SlabQueries, testing::Values(test::three_slabs));
INSTANTIATE_TEST_SUITE_P(Eight, SlabQueries, testing::Values(test::eight_slabs));
INSTANTIATE_TEST_SUITE_P(Whole, SlabQueries, testing::Values(std::vector<float>{}));

TEST_P(SlabQueries, ClearancesAreTheLeastOfParts) {
  const std::uint32_t pairs = test::samples(3'000);
  std::size_t never_meet = 0;
  for (const MovingScene& scene : scenes(pairs)) {
    for (const double max_distance : {HUGE_VAL, 0.3, 0.0}) expect_clearances(scene, max_distance);
    for (const Pair pair : scene.pairs) never_meet += !reference.may_meet(scene.crowd.agents(), pair);
  }
  EXPECT_GT(never_meet, pairs / 60);
}

TEST_P(SlabQueries, ExactClearancesAreTheLeastOfParts) {
  for (const MovingScene& scene : scenes(test::samples(1'000)))
    for (const double max_distance : {HUGE_VAL, 0.3, 0.0}) {
      std::vector<float> expected;
      for (const Pair pair : scene.pairs)
        expected.push_back(reference.exact_clearance(scene.crowd.agents(), pair, max_distance));
      expect_of_all(
          scene,
          [&](const Implementation& implementation) {
            std::vector<float> distance(scene.pairs.size());
            clearance(set, scene.crowd.agents(), scene.pairs, {distance},
                      {.implementation = &implementation,
                       .max_distance = max_distance,
                       .distance_leaves = Leaves::segments});
            return distance;
          },
          [&](const std::vector<float>& found, std::size_t i) { return found[i] == expected[i]; });
    }
}

TEST_P(SlabQueries, PointsAreAsFarApartAsTheDistanceSays) {
  const MovingScene scene = scene_of(3'000, true);
  std::vector<float> distance(scene.pairs.size());
  std::vector<Vec2> direction(scene.pairs.size());
  std::vector<NearestPoints> points(scene.pairs.size());
  clearance(set, scene.crowd.agents(), scene.pairs,
            {.distance = distance, .direction = direction, .points = points});
  std::size_t apart = 0;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    if (distance[i] == 0 || distance[i] == never) {
      ASSERT_EQ(points[i], NearestPoints{}) << i;
      continue;
    }
    ++apart;
    const auto [x, y] = test::way_between(points[i], scene.crowd, scene.pairs[i]);
    const double length = distance[i], along_x = direction[i].x, along_y = direction[i].y;
    ASSERT_NEAR(x, length * along_x, 3e-5) << i;
    ASSERT_NEAR(y, length * along_y, 3e-5) << i;
  }
  EXPECT_GT(apart, 200u);
}

TEST_P(SlabQueries, WithinLooksAtAllParts) {
  const std::uint32_t pairs = test::samples(3'000);
  std::size_t misses = 0;
  for (const MovingScene& scene : scenes(pairs)) {
    const Agents agents = scene.crowd.agents();
    std::vector<double> distances;
    std::vector<std::uint8_t> expected;
    for (const Pair pair : scene.pairs) {
      const double clearance = reference.clearance(agents, pair, HUGE_VAL).distance;
      const bool is_near = random.below(2) == 0 && clearance > 0 && clearance < HUGE_VAL;
      distances.push_back(is_near ? clearance * (1 + random.uniform(-2e-6, 0.5e-6)) : random.uniform(0, 0.5));
      expected.push_back(reference.within(agents, pair, distances.back()));
      misses += expected.back() == 0;
    }
    expect_of_all(
        scene,
        [&](const Implementation& implementation) {
          std::vector<std::uint8_t> found(scene.pairs.size());
          within(set, agents, scene.pairs, distances, found, {.implementation = &implementation});
          return found;
        },
        [&](const std::vector<std::uint8_t>& found, std::size_t i) { return found[i] == expected[i]; });
  }
  EXPECT_GT(misses, pairs / 3);
}

/// Walls: discs of all slabs are the same, so that all of them are as near.
TEST_P(SlabQueries, OfEqualGapsThoseInTheLowestSlabsCount) {
  if (GetParam().empty()) GTEST_SKIP() << "there are no slabs";
  shapes = test::synthetic_shapes(27, 10);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (i % 3 == 0) continue;
    // Some leave slabs out; others are larger in some.
    const Shape wall = std::exchange(shapes[i], {});
    shapes[i].heights = {-1, 3};
    for (std::size_t slab = 0; slab <= plan.slices.size(); ++slab)
      shapes[i].slabs.push_back(slab > 0 && random.below(4) == 0 ? Shape{} : wall);
  }
  set = ShapeSet(shapes, plan);
  test::PartReferences of_walls(shapes, plan, set);
  for (const bool raised : {false, true}) {
    const MovingScene scene = scene_of(3'000, raised);
    const Agents agents = scene.crowd.agents();
    const test::Answers found = test::answers(set, agents, scene.pairs, HUGE_VAL);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const baselines::Clearance expected = of_walls.clearance(agents, scene.pairs[i], HUGE_VAL);
      ASSERT_EQ(found.distance[i], expected.distance) << i;
      ASSERT_EQ(found.direction[i], expected.direction) << i;
      ASSERT_EQ(found.discs[i], (DiscPair{expected.first, expected.second})) << i;
    }
  }
}

TEST_P(SlabQueries, TimesAreTheFirstOfParts) {
  std::ptrdiff_t all = 0, between = 0;
  for (const MovingScene& scene : scenes(test::samples(3'000))) {
    std::vector<float> expected;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i)
      expected.push_back(reference.time(scene.crowd.agents(), scene.pairs[i], scene.x[i], scene.y[i]));
    all += std::ssize(expected);
    between += std::count_if(expected.begin(), expected.end(), [](float t) { return t > 0 && t <= 1; });
    expect_of_all(
        scene, [&](const Implementation& implementation) { return times_of(set, scene, implementation); },
        [&](const std::vector<float>& found, std::size_t i) { return found[i] == expected[i]; });
  }
  EXPECT_GT(between, all / 40);
}

TEST_P(SlabQueries, TimesAreZeroWhereBodiesCollide) {
  if (GetParam().empty()) GTEST_SKIP() << "whole bodies may stand in each other";
  const MovingScene scene = scene_of(10'000, true);
  std::vector<std::uint8_t> collided(scene.pairs.size());
  collide(set, scene.crowd.agents(), scene.pairs, collided, {.leaves = Leaves::discs});
  const std::vector<float> times = times_of(set, scene, best_implementation());
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (collided[i] != 0) {
      ASSERT_EQ(times[i], 0) << i;
    } else if (scene.x[i] == 0 && scene.y[i] == 0) {
      ASSERT_EQ(times[i], never) << i;
    }
  }
}

TEST_P(SlabQueries, ContactsAreThoseOfAllParts) {
  bch::Crowd finder;
  for (const MovingScene& scene : scenes(test::samples(1'500)))
    for (const Leaves leaves : {Leaves::segments, Leaves::discs}) {
      std::vector<std::vector<DiscPair>> expected;
      std::size_t touching = 0;
      for (const Pair pair : scene.pairs) {
        expected.push_back(reference.contacts(scene.crowd.agents(), pair, leaves));
        touching += !expected.back().empty();
      }
      EXPECT_GT(touching, scene.pairs.size() / 20);
      expect_of_all(
          scene,
          [&](const Implementation& implementation) {
            return contacts_of(finder, set, scene, {.leaves = leaves, .implementation = &implementation});
          },
          [&](const auto& found, std::size_t i) { return found[i] == expected[i]; });
    }
}

TEST_P(SlabQueries, AnySplitAndNumberOfThreadsGivesTheSame) {
  const MovingScene scene = scene_of(8'000, true);
  const AllAnswers expected = all_answers(set, scene);
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  for (const int threads : {1, 2, 7}) {
    tbb::task_arena arena(threads);
    expect_same(arena.execute([&] { return all_answers(set, scene); }), expected);
  }
  AllAnswers found;
  for (std::size_t begin = 0; begin < scene.pairs.size();) {
    const std::size_t size = std::min<std::size_t>(1 + random.below(700), scene.pairs.size() - begin);
    const auto part = [&]<class Value>(const std::vector<Value>& of) {
      const auto from = of.begin() + static_cast<std::ptrdiff_t>(begin);
      return std::vector<Value>(from, from + static_cast<std::ptrdiff_t>(size));
    };
    found.append(all_answers(
        set, {{scene.crowd, part(scene.pairs)}, part(scene.x), part(scene.y), part(scene.along)}));
    begin += size;
  }
  expect_same(found, expected);
}

TEST_P(SlabQueries, OfTheOtherOrderAreExchanged) {
  for (const bool raised : {false, true}) {
    MovingScene scene = tangent_scene(3'000, raised);
    AllAnswers expected = all_answers(set, scene);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      std::swap(scene.pairs[i].first, scene.pairs[i].second);
      scene.x[i] = -scene.x[i], scene.y[i] = -scene.y[i];
      scene.along[i] = {-scene.along[i].x, -scene.along[i].y};
      if (expected.clearances.discs[i] != no_discs) {
        Vec2& direction = expected.clearances.direction[i];
        direction = {-direction.x, -direction.y};
        expected.clearances.discs[i] = test::exchanged(expected.clearances.discs[i]);
      }
      for (auto* rows : {&expected.by_segments, &expected.by_discs}) {
        for (DiscPair& discs : (*rows)[i]) discs = test::exchanged(discs);
        test::sort_contacts((*rows)[i]);
      }
      for (auto* depths : {&expected.best, &expected.along}) {
        (*depths)[i].x = -(*depths)[i].x, (*depths)[i].y = -(*depths)[i].y;
      }
    }
    expect_same(all_answers(set, scene), expected);
  }
}

/// An agent and itself: its own slabs, each of which is where it is.
TEST_P(SlabQueries, OfAnAgentWithItself) {
  MovingScene scene = scene_of(200, true);
  for (Pair& pair : scene.pairs) pair.second = pair.first;
  const Agents agents = scene.crowd.agents();
  const AllAnswers all = all_answers(set, scene);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const Pair pair = scene.pairs[i];
    const baselines::Clearance nearest = reference.clearance(agents, pair, HUGE_VAL);
    ASSERT_EQ(all.clearances.distance[i], nearest.distance) << i;
    ASSERT_EQ(all.clearances.discs[i], (DiscPair{nearest.first, nearest.second})) << i;
    ASSERT_EQ(all.times[i], 0) << i;
    ASSERT_EQ(all.by_segments[i], reference.contacts(agents, pair, Leaves::segments)) << i;
    ASSERT_EQ(all.by_discs[i], reference.contacts(agents, pair, Leaves::discs)) << i;
    ASSERT_GT(all.best[i].depth, 0) << i;
  }
}

}  // namespace
}  // namespace bch