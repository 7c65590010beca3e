// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <bch/collide.hpp>
#include <bch/contacts.hpp>
#include <bch/time_of_impact.hpp>

#include "baselines/clearance_reference.hpp"
#include "baselines/contact_reference.hpp"
#include "baselines/penetration_reference.hpp"
#include "baselines/slab_bodies.hpp"
#include "baselines/time_of_impact_reference.hpp"
#include "layout/base/rounding.hpp"
#include "tests/support/clearances.hpp"
#include "tests/support/penetrations.hpp"
#include "tests/support/slab_scenes.hpp"

// Distances, times, contacts and depths of bodies in slabs, and at different heights, against the definition: what the scalar
// references say of every pair of parts that may meet.

namespace bch {
namespace {

using baselines::Method;
using baselines::SlabBodies;
using test::PairScene;
using test::Random;

constexpr float never = std::numeric_limits<float>::infinity();
constexpr std::uint32_t directions = 16;

/// Pairs that move, and ways out of each other.
struct Scene : PairScene {
  std::vector<double> x, y;
  std::vector<Vec2> along;
};

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

std::vector<std::vector<DiscPair>> contacts_of(ContactFinder& finder, const ShapeSet& set,
                                               const PairScene& scene, const QueryOptions& options) {
  const Rows<DiscPair> rows = finder.find(set, scene.crowd.agents(), scene.pairs, options);
  std::vector<std::vector<DiscPair>> all;
  for (std::size_t i = 0; i < rows.size(); ++i) all.emplace_back(rows[i].begin(), rows[i].end());
  return all;
}

std::vector<float> times_of(const ShapeSet& set, const Scene& scene, const Implementation& implementation) {
  std::vector<float> all(scene.pairs.size(), -1);
  time_of_impact(set, scene.crowd.agents(), scene.pairs, {scene.x, scene.y}, all,
                 {.implementation = &implementation});
  return all;
}

AllAnswers all_answers(const ShapeSet& set, const Scene& scene,
                       const Implementation& implementation = best_implementation()) {
  AllAnswers all;
  ContactFinder finder;
  all.clearances = test::answers(set, scene.crowd.agents(), scene.pairs, never, &implementation);
  all.times = times_of(set, scene, implementation);
  all.by_segments = contacts_of(finder, set, scene, {.implementation = &implementation});
  all.by_discs =
      contacts_of(finder, set, scene, {.implementation = &implementation, .leaves = Leaves::discs});
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

void sort(std::vector<DiscPair>& row) {
  std::sort(row.begin(), row.end(), [](const DiscPair& a, const DiscPair& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
}

DiscPair exchanged(const DiscPair& discs) {
  return {discs.second, discs.first};
}

/// What the scalar references say of pairs of bodies, part by part. The agent of the lower index is A, as everywhere; then pairs
/// are turned as they were asked about.
class PartReferences {
 public:
  PartReferences(std::span<const Shape> shapes, const ShapeSetPlan& plan, const ShapeSet& set)
      : shapes_(shapes),
        set_(set),
        levels_(plan.depths.size()),
        bodies_(shapes, plan, Leaves::discs),
        nearest_(bodies_.parts(), plan),
        first_(bodies_.parts(), plan),
        cuts_(bodies_.parts(), plan),
        segments_(bodies_.parts(), plan, Leaves::segments),
        are_cut_(!plan.slices.empty()) {}

  baselines::Clearance clearance(const Agents& agents, Pair pair, double max_distance) {
    const Pair ordered = in_order(pair);
    baselines::Clearance best{never, {0, 0}, no_discs.first, no_discs.second};
    for (const SlabBodies::PartPair& parts : bodies_.part_pairs(agents, ordered)) {
      // Lower slabs come first.
      baselines::Clearance at = nearest_.query(parts.agents(), {0, 1}, max_distance, Method::brute_force);
      if (!(at.distance < best.distance)) continue;
      best = at;
      best.first += first_disc(agents, ordered.first, parts.slab[0]);
      best.second += first_disc(agents, ordered.second, parts.slab[1]);
    }
    if (ordered == pair || best.distance == never) return best;
    return {best.distance, {-best.direction.x, -best.direction.y}, best.second, best.first};
  }

  float time(const Agents& agents, Pair pair, double x, double y) {
    if (are_cut_ && bodies_.collide(agents, pair, Method::depth_first)) return 0;
    const double sign = in_order(pair) == pair ? 1 : -1;
    float soonest = never;
    for (const SlabBodies::PartPair& parts : bodies_.part_pairs(agents, in_order(pair)))
      soonest =
          std::min(soonest, first_.query(parts.agents(), {0, 1}, sign * x, sign * y, Method::brute_force));
    return soonest;
  }

  std::vector<DiscPair> contacts(const Agents& agents, Pair pair, Leaves leaves) {
    const Pair ordered = in_order(pair);
    std::vector<DiscPair> all;
    for (const SlabBodies::PartPair& parts : bodies_.part_pairs(agents, ordered))
      for (const auto& [i, j] : baselines::contacts(cuts_, parts.agents(), {0, 1},
                                                    leaves == Leaves::segments ? &segments_ : nullptr)) {
        const DiscPair discs{i + first_disc(agents, ordered.first, parts.slab[0]),
                             j + first_disc(agents, ordered.second, parts.slab[1])};
        all.push_back(ordered == pair ? discs : exchanged(discs));
      }
    sort(all);
    return all;
  }

  struct Depth {
    float depth;   ///< the largest of the parts, each with its own slack
    double slack;  ///< by which all of them together may have more
  };
  /// Along a direction of the first agent.
  Depth depth(const Agents& agents, Pair pair, Vec2 along) {
    const Vec2 of_lower = in_order(pair) == pair ? along : Vec2{-along.x, -along.y};
    Depth most{0, 0};
    for (const SlabBodies::PartPair& parts : bodies_.part_pairs(agents, in_order(pair))) {
      const Agents of = parts.agents();
      most.depth = std::max(most.depth, baselines::penetration_along(cuts_, of, {0, 1}, of_lower).depth);
      most.slack = std::max(most.slack, 40 * detail::rounding::unit_roundoff *
                                            static_cast<double>(cuts_.reach(of, 0) + cuts_.reach(of, 1)));
    }
    return most;
  }

  bool may_meet(const Agents& agents, Pair pair) const { return !bodies_.part_pairs(agents, pair).empty(); }

 private:
  static Pair in_order(Pair pair) {
    return {std::min(pair.first, pair.second), std::max(pair.first, pair.second)};
  }

  /// Where the discs of an agent's slab begin. Bodies that are not cut have theirs once.
  std::uint32_t first_disc(const Agents& agents, std::uint32_t agent, std::uint32_t slab) const {
    const std::uint32_t shape = agents.shape[agent];
    if (shapes_[shape].slabs.empty()) return 0;
    return set_.slab_begin(shape, static_cast<std::uint32_t>(agents.root(agent, levels_) % levels_))[slab];
  }

  std::span<const Shape> shapes_;
  const ShapeSet& set_;
  std::size_t levels_;
  SlabBodies bodies_;
  baselines::ClearanceReference nearest_;
  baselines::TimeOfImpactReference first_;
  baselines::CutLists cuts_;
  baselines::LeafSegments segments_;
  bool are_cut_;
};

ShapeSetPlan plan_of(const std::vector<float>& slices) {
  ShapeSetPlan plan = test::levels_of(slices);
  plan.heights = true;
  return plan;
}

class SlabQueries : public testing::TestWithParam<std::vector<float>> {
 protected:
  Random random{20263};
  ShapeSetPlan plan = plan_of(GetParam());
  std::vector<Shape> shapes = test::bodies(random, plan);
  ShapeSet set{shapes, plan};
  PartReferences reference{shapes, plan, set};

  /// Ways of up to 3 m, half of them towards the other agent, some of none; of whole bodies at different heights only.
  Scene scene_of(std::uint32_t pairs, bool raised, double apart = 0) {
    Scene scene{random_scene(random, set, pairs), {}, {}, {}};
    for (std::size_t i = 0; i < scene.crowd.x.size(); i += 2)
      scene.crowd.x[i] -= apart * random.uniform(0, 1);
    if (raised || GetParam().empty()) raise(random, scene);
    for (const auto& [first, second] : scene.pairs) {
      const double towards = std::atan2(scene.crowd.y[second] - scene.crowd.y[first],
                                        scene.crowd.x[second] - scene.crowd.x[first]);
      const double angle = towards + random.uniform(-1, 1) * (random.below(2) == 0 ? std::numbers::pi : 0.5);
      const double length = random.below(8) == 0 ? 0 : random.uniform(0, 3);
      scene.x.push_back(length * std::cos(angle)), scene.y.push_back(length * std::sin(angle));
      const double out = random.uniform(-4, 4), size = std::exp(random.uniform(-20, 20));
      scene.along.push_back(
          {static_cast<float>(size * std::cos(out)), static_cast<float>(size * std::sin(out))});
    }
    return scene;
  }

  /// The same with pairs at the edge of a collision.
  Scene tangent_scene(std::uint32_t pairs, bool raised) {
    Scene scene = scene_of(pairs, raised);
    make_tangent(random, scene, [&](const Agents& agents, Pair pair) {
      std::uint8_t hit = 0;
      collide(set, agents, {&pair, 1}, {&hit, 1}, {.semantics = Semantics::solid});
      return hit != 0;
    });
    return scene;
  }

  std::vector<Scene> scenes(std::uint32_t pairs) {
    std::vector<Scene> all;
    for (const bool raised : {false, true}) {
      all.push_back(scene_of(pairs, raised));
      all.push_back(tangent_scene(pairs / 2, raised));
      all.push_back(scene_of(pairs / 2, raised, 2));
      test::move_away(all.back(), 1e7, -8e8);
    }
    return all;
  }

  /// Asks every implementation. `same` compares with what is expected of pair i.
  template <class Ask, class Same>
  void expect_of_all(const Scene& scene, Ask ask, Same same) {
    for (const auto& implementation : implementations()) {
      if (!implementation.supported()) continue;
      const auto found = ask(implementation);
      for (std::size_t i = 0; i < scene.pairs.size(); ++i)
        ASSERT_TRUE(same(found, i)) << implementation.name << ", pair " << i << ": shapes "
                                    << scene.crowd.shape[2 * i] << " and " << scene.crowd.shape[2 * i + 1];
    }
  }

  void expect_clearances(const Scene& scene, double max_distance) {
    test::Answers expected;
    for (const Pair pair : scene.pairs) {
      const auto [distance, direction, first, second] =
          reference.clearance(scene.crowd.agents(), pair, max_distance);
      expected.distance.push_back(distance), expected.direction.push_back(direction);
      expected.discs.push_back({first, second});
    }
    expect_of_all(
        scene,
        [&](const Implementation& implementation) {
          return test::answers(set, scene.crowd.agents(), scene.pairs, max_distance, &implementation);
        },
        [&](const test::Answers& found, std::size_t i) { return found.same(i, expected, i); });
  }

  std::size_t hits(const Scene& scene) const {
    std::vector<std::uint8_t> all(scene.pairs.size());
    collide(set, scene.crowd.agents(), scene.pairs, all, {.semantics = Semantics::solid});
    return static_cast<std::size_t>(std::count(all.begin(), all.end(), 1));
  }
};

INSTANTIATE_TEST_SUITE_P(Three, SlabQueries, testing::Values(test::three_slabs));
INSTANTIATE_TEST_SUITE_P(Eight, SlabQueries, testing::Values(test::eight_slabs));
INSTANTIATE_TEST_SUITE_P(Whole, SlabQueries, testing::Values(std::vector<float>{}));

TEST_P(SlabQueries, ClearancesAreTheLeastOfParts) {
  std::size_t never_meet = 0;
  for (const Scene& scene : scenes(3'000)) {
    for (const double max_distance : {HUGE_VAL, 0.3, 0.0}) expect_clearances(scene, max_distance);
    for (const Pair pair : scene.pairs) never_meet += !reference.may_meet(scene.crowd.agents(), pair);
  }
  EXPECT_GT(never_meet, 50u);
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
  PartReferences of_walls(shapes, plan, set);
  for (const bool raised : {false, true}) {
    const Scene scene = scene_of(3'000, raised);
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
  for (const Scene& scene : scenes(3'000)) {
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
  const Scene scene = scene_of(10'000, true);
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
  ContactFinder finder;
  for (const Scene& scene : scenes(1'500))
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
            return contacts_of(finder, set, scene, {.implementation = &implementation, .leaves = leaves});
          },
          [&](const auto& found, std::size_t i) { return found[i] == expected[i]; });
    }
}

TEST_P(SlabQueries, DepthsAreTheLargestOfParts) {
  for (const Scene& scene : scenes(3'000)) {
    std::vector<PartReferences::Depth> expected;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i)
      expected.push_back(reference.depth(scene.crowd.agents(), scene.pairs[i], scene.along[i]));
    const std::vector<Penetration> best = test::along(scene.along, set, scene);
    expect_of_all(
        scene,
        [&](const Implementation& implementation) {
          return test::along(scene.along, set, scene, implementation);
        },
        [&](const std::vector<Penetration>& found, std::size_t i) {
          const double x = scene.along[i].x, y = scene.along[i].y, length = std::sqrt(x * x + y * y);
          const double depth = found[i].depth, least = expected[i].depth;
          return found[i] == best[i] && found[i].x == x / length && found[i].y == y / length &&
                 depth >= least && depth <= least * (1 + 0x1p-22) + 1.01 * expected[i].slack;
        });
  }
}

TEST_P(SlabQueries, TheBestDepthIsTheLeastOfDirections) {
  std::vector<Vec2> spread;
  for (std::uint32_t k = 0; k < directions; ++k) {
    const double angle = 2 * std::numbers::pi * k / directions;
    spread.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))});
  }
  // Directions are rounded to float here.
  constexpr double rounding = 4e-6;
  for (const Scene& scene : scenes(1'000)) {
    const std::vector<Penetration> best = test::best_of(directions, set, scene);
    expect_of_all(
        scene,
        [&](const Implementation& implementation) {
          return test::best_of(directions, set, scene, implementation);
        },
        [&](const std::vector<Penetration>& found, std::size_t i) { return found[i] == best[i]; });
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      double least = HUGE_VAL, told = HUGE_VAL;
      for (const Vec2 along : spread) {
        const double depth = reference.depth(scene.crowd.agents(), scene.pairs[i], along).depth;
        least = std::min(least, depth);
        if (std::abs(static_cast<double>(along.x) - best[i].x) < 1e-6 &&
            std::abs(static_cast<double>(along.y) - best[i].y) < 1e-6)
          told = depth;
      }
      ASSERT_NEAR(best[i].depth, least, rounding) << i;
      ASSERT_NEAR(best[i].depth, told, rounding) << i;
    }
  }
}

TEST_P(SlabQueries, NothingOverlapsAfterTheDepth) {
  for (const bool raised : {false, true})
    for (const bool tangent : {false, true}) {
      const Scene before = tangent ? tangent_scene(3'000, raised) : scene_of(10'000, raised);
      EXPECT_GT(hits(before), before.pairs.size() / 20);
      for (const auto& by : {test::best_of(directions, set, before), test::along(before.along, set, before)})
        for (const double further : {0.0, 1e-3, 0.1}) {
          Scene after = before;
          for (std::size_t i = 0; i < by.size(); ++i) {
            const double depth = static_cast<double>(by[i].depth) + further;
            after.crowd.x[after.pairs[i].first] += depth * by[i].x;
            after.crowd.y[after.pairs[i].first] += depth * by[i].y;
          }
          EXPECT_EQ(hits(after), 0u);
        }
    }
}

TEST_P(SlabQueries, AnySplitAndNumberOfThreadsGivesTheSame) {
  const Scene scene = scene_of(8'000, true);
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
    Scene scene = tangent_scene(3'000, raised);
    AllAnswers expected = all_answers(set, scene);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      std::swap(scene.pairs[i].first, scene.pairs[i].second);
      scene.x[i] = -scene.x[i], scene.y[i] = -scene.y[i];
      scene.along[i] = {-scene.along[i].x, -scene.along[i].y};
      if (expected.clearances.discs[i] != no_discs) {
        Vec2& direction = expected.clearances.direction[i];
        direction = {-direction.x, -direction.y};
        expected.clearances.discs[i] = exchanged(expected.clearances.discs[i]);
      }
      for (auto* rows : {&expected.by_segments, &expected.by_discs}) {
        for (DiscPair& discs : (*rows)[i]) discs = exchanged(discs);
        sort((*rows)[i]);
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
  Scene scene = scene_of(200, true);
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
