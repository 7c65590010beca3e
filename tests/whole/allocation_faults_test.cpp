// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <new>
#include <utility>
#include <vector>

#include <bch/baked.hpp>
#include <bch/broad_phase.hpp>
#include <bch/clearance.hpp>
#include <bch/collide.hpp>
#include <bch/contacts.hpp>
#include <bch/default_characters.hpp>
#include <bch/dynamic_shape_set.hpp>
#include <bch/obstacles.hpp>
#include <bch/outline_builder.hpp>
#include <bch/pose_shape.hpp>
#include <bch/shape_set_builder.hpp>

#include "layout/baked/image.hpp"
#include "layout/character/skinning.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

// Every allocation fails once, and once with all that follow it.

namespace bch {
namespace {

/// Runs `act`, which leaves nothing behind, with its first, second ... allocation failing, until none is left that
/// could: each time it throws std::bad_alloc, has leaked nothing, and `check` finds what was there before as it was.
/// Returns: how many allocations it takes.
template <class Act, class Check>
std::size_t fail_each(Act act, Check check) {
  act();  // what is made once in a program is made
  for (std::size_t after = 0;; ++after)
    for (const test::Failing mode : {test::Failing::one, test::Failing::all}) {
      const std::size_t live = test::live_allocations();
      bool thrown = false;
      test::fail_allocations(mode, after);
      try {
        act();
      } catch (const std::bad_alloc&) {
        thrown = true;
      }
      const std::size_t failures = test::stop_failing_allocations();
      const std::size_t leaked = test::live_allocations() - live;
      EXPECT_EQ(leaked, 0u) << "allocation " << after;
      if (failures == 0) {
        EXPECT_FALSE(thrown);
        return after;
      }
      EXPECT_TRUE(thrown) << "allocation " << after;
      check();
      if (testing::Test::HasFailure()) return after;
    }
}

template <class Act>
std::size_t fail_each(Act act) {
  return fail_each(act, [] {});
}

const ShapeSetPlan plan{{0, 2, all_depths}, true};

std::vector<PreparedShape> prepared(std::span<const Shape> shapes) {
  std::vector<PreparedShape> all;
  for (std::size_t s = 0; s < shapes.size(); ++s) all.emplace_back(plan).prepare(shapes[s], s);
  return all;
}

class AllocationFaults : public testing::Test {
 protected:
  AllocationFaults() {
    test::Random random(91);
    for (int i = 0; i < 300; ++i)
      crowd.add({random.below(3), random.uniform(0, 8), random.uniform(0, 8), random.uniform(-4, 4),
                 static_cast<std::uint8_t>(random.below(3))});
  }

  /// On this thread alone, so that the allocations come in one order; and by two.
  template <class Act, class Check>
  void fail_each_with_threads(Act act, Check check, std::size_t least) {
    for (const int threads : {1, 2}) {
      const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 2);
      tbb::task_arena arena(threads);
      EXPECT_GE(fail_each([&] { arena.execute(act); }, check), least);
    }
  }

  const std::vector<Shape> shapes = test::few_shapes();
  const ShapeSet set{shapes, plan};
  test::Crowd crowd;
};

TEST_F(AllocationFaults, Outline) {
  const Character character = default_male();
  detail::Skinner skinner(character);
  const auto pose = skinner.pose({});
  const std::vector<Vec3> positions(pose.begin(), pose.end());
  EXPECT_GT(fail_each([&] {
              Outline outline;
              OutlineBuilder(character.triangles, positions.size(), positions).build(positions, outline);
            }),
            10u);
}

TEST_F(AllocationFaults, Hierarchy) {
  EXPECT_GT(fail_each([&] { contour_hierarchy(shapes[0].outline, 0.01f); }), 5u);
}

TEST_F(AllocationFaults, ShapesOfAPoseGoOnAfterwards) {
  const Character character = default_female();
  PoseShaper shaper(character);
  const std::vector<PoseTime> poses = sample_poses(character, 3);
  const Shape expected = shaper.shape(poses[1]);
  EXPECT_GT(fail_each([&] { PoseShaper(character).shape(poses[0]); },
                      [&] { EXPECT_EQ(shaper.shape(poses[1]).outline.points, expected.outline.points); }),
            20u);
}

/// A shaper that ran out of memory makes the same shape later, at whichever allocation it was.
TEST_F(AllocationFaults, AShaperMakesTheShapeThatItCouldNot) {
  const Character character = default_female();
  const PoseTime at = sample_poses(character, 3)[1];
  for (const std::vector<float>& slices : {std::vector<float>{}, {0.5f, 1.2f}}) {
    const ShapeSetPlan of_shaper{.slices = slices};
    const auto content = [&](const Shape& shape) {
      return test::BakedBytes(ShapeSet({&shape, 1}, of_shaper), {}).text();
    };
    const std::string expected = content(PoseShaper(character, of_shaper).shape(at));
    for (std::size_t after = 0;; ++after) {
      PoseShaper shaper(character, of_shaper);
      bool thrown = false;
      test::fail_allocations(test::Failing::one, after);
      try {
        shaper.shape(at);
      } catch (const std::bad_alloc&) {
        thrown = true;
      }
      const bool failed = test::stop_failing_allocations() > 0;
      EXPECT_EQ(thrown, failed);
      ASSERT_EQ(content(shaper.shape(at)), expected) << after;
      if (failed) continue;
      EXPECT_GT(after, 20u);
      break;
    }
  }
}

TEST_F(AllocationFaults, Set) {
  EXPECT_GT(fail_each([&] { ShapeSet(shapes, plan); }), 15u);
}

/// A builder that could not add a shape still adds it later, and makes the same set.
TEST_F(AllocationFaults, SetBuilder) {
  // Enough that room is made for all that are expected.
  std::vector<Shape> many;
  while (many.size() < 70) many.insert(many.end(), shapes.begin(), shapes.end());
  const std::vector<PreparedShape> flat = prepared(many);
  const std::string expected = test::BakedBytes(ShapeSet(many, plan), {}).text();
  for (std::size_t after = 0;; ++after) {
    ShapeSetBuilder builder(plan, 100);
    std::size_t failures = 0;
    for (const PreparedShape& shape : flat) {
      test::fail_allocations(test::Failing::all, after);
      try {
        builder.add(shape);
        failures += test::stop_failing_allocations();
      } catch (const std::bad_alloc&) {
        failures += test::stop_failing_allocations();
        builder.add(shape);
      }
    }
    const ShapeSet built = std::move(builder).finish();
    ASSERT_EQ(test::BakedBytes(built, {}).text(), expected) << after;
    if (failures == 0) {
      EXPECT_GT(after, 5u);
      return;
    }
  }
}

/// What could not be added leaves nothing behind.
TEST_F(AllocationFaults, SetBuilderThatFinishesWithoutAShape) {
  const std::vector<PreparedShape> flat = prepared(shapes);
  const ShapeSet fewer(std::span<const Shape>(shapes).first(shapes.size() - 1), plan);
  const std::string expected = test::BakedBytes(fewer, test::origins_of(shapes.size() - 1)).text();
  for (std::size_t after = 0;; ++after) {
    ShapeSetBuilder builder(plan);
    for (std::size_t s = 0; s + 1 < flat.size(); ++s) builder.add(flat[s]);
    test::fail_allocations(test::Failing::all, after);
    try {
      builder.add(flat.back());
    } catch (const std::bad_alloc&) {
    }
    if (test::stop_failing_allocations() == 0) {
      EXPECT_GT(after, 2u);
      return;
    }
    const ShapeSet built = std::move(builder).finish();
    ASSERT_EQ(test::BakedBytes(built, test::origins_of(shapes.size() - 1)).text(), expected) << after;
  }
}

/// A shape that could not be replaced is the one before, and so are all others.
TEST_F(AllocationFaults, DynamicSet) {
  test::Random random(92);
  PreparedShape large(plan);
  large.prepare(test::contour_shape(test::star(random, 200, 0.3, 0.5)), 0);
  const std::string expected = test::BakedBytes(set, test::origins_of(shapes.size())).text();
  for (std::size_t after = 0;; ++after) {
    DynamicShapeSet dynamic(set);
    bool thrown = false;
    test::fail_allocations(test::Failing::all, after);
    try {
      dynamic.replace(1, large);
    } catch (const std::bad_alloc&) {
      thrown = true;
    }
    if (test::stop_failing_allocations() == 0) {
      EXPECT_GT(after, 1u);  // nodes and points: other parts have room
      break;
    }
    EXPECT_TRUE(thrown);
    std::vector<std::uint8_t> hits(crowd.shape.size() - 1), before(hits.size());
    std::vector<Pair> pairs;
    for (std::uint32_t i = 0; i < hits.size(); ++i) pairs.push_back({i, i + 1});
    collide(dynamic.set(), crowd.agents(), pairs, hits, {Semantics::solid});
    collide(set, crowd.agents(), pairs, before, {Semantics::solid});
    ASSERT_EQ(hits, before) << after;
    dynamic.replace(1, large);  // now it goes
    ASSERT_NE(dynamic.set().view().roots[plan.depths.size()].radius,
              set.view().roots[plan.depths.size()].radius);
  }
}

TEST_F(AllocationFaults, Image) {
  EXPECT_GT(fail_each([&] { detail::BakedImage(set, test::origins_of(shapes.size()), test::few_clips()); }),
            9u);
}

TEST_F(AllocationFaults, Load) {
  const TemporaryFolder folder;
  const auto file =
      folder.write("a.bch", test::BakedBytes(set, test::origins_of(shapes.size()), test::few_clips()).text());
  for (const FileAccess access : {FileAccess::read, FileAccess::map})
    EXPECT_GT(fail_each([&] { load_baked(file, access); }), 9u);
}

TEST_F(AllocationFaults, Pairs) {
  BroadPhase broad_phase;
  const std::vector<Pair> expected = candidate_pairs(set, crowd.agents());
  ASSERT_GT(expected.size(), 300u);
  fail_each_with_threads([&] { BroadPhase().find(set, crowd.agents()); },
                         [&] {
                           const auto pairs = broad_phase.find(set, crowd.agents());
                           EXPECT_EQ(std::vector<Pair>(pairs.begin(), pairs.end()), expected);
                         },
                         5);
}

/// One that ran out of memory answers the next call.
TEST_F(AllocationFaults, CrowdColliderAnswersTheNextCall) {
  const auto answer = CrowdCollider().collide_all(set, crowd.agents());
  const std::size_t expected = answer.values.size();
  ASSERT_GT(expected, 100u);
  for (std::size_t after = 0;; ++after) {
    CrowdCollider collider;
    test::fail_allocations(test::Failing::all, after);
    try {
      collider.collide_all(set, crowd.agents());
    } catch (const std::bad_alloc&) {
    }
    const std::size_t failures = test::stop_failing_allocations();
    ASSERT_EQ(collider.collide_all(set, crowd.agents()).values.size(), expected) << after;
    if (failures > 0) continue;
    EXPECT_GT(after, 5u);
    return;
  }
}

TEST_F(AllocationFaults, Contacts) {
  const std::vector<Pair> pairs = candidate_pairs(set, crowd.agents());
  ContactFinder finder;
  const std::size_t expected = ContactFinder().find(set, crowd.agents(), pairs).values.size();
  ASSERT_GT(expected, 100u);
  fail_each_with_threads([&] { ContactFinder().find(set, crowd.agents(), pairs); },
                         [&] { EXPECT_EQ(finder.find(set, crowd.agents(), pairs).values.size(), expected); },
                         2);
  const std::vector<Disc> body = {{0, 0, 0.3f}, {0, 0.3f, 0.2f}};
  const ShapeSet bodies(std::vector<Shape>(1, shape_from_discs(body)));
  test::Crowd people;
  for (std::uint32_t i = 0; i < 100; ++i) people.add({0, 0.4 * (i % 10), 0.4 * (i / 10), 0, 0});
  const auto of_crowd = [&](ContactFinder& of) {
    return of.find_all(bodies, people.agents()).contacts.values.size();
  };
  const std::size_t of_people = of_crowd(finder);
  ASSERT_GT(of_people, 100u);
  fail_each_with_threads(
      [&] {
        ContactFinder own;
        of_crowd(own);
      },
      [&] { EXPECT_EQ(of_crowd(finder), of_people); }, 2);
}

constexpr const char* walls =
    "LINESTRING(0 0, 5 5, 9 1) POLYGON((2 2, 4 2, 4 4, 2 4), (2.5 2.5, 3 2.5, 3 3)) LINESTRING(1 9, 9 9, 9 "
    "1)";

TEST_F(AllocationFaults, Obstacles) {
  EXPECT_GT(fail_each([] { obstacles_from_wkt(walls); }, [] {}), 10u);
  const ObstacleSet obstacles = obstacles_from_wkt(walls);
  std::vector<std::uint8_t> hits(crowd.x.size());
  CrowdCollider collider;
  const auto answer = [&] {
    return collider.collide_all(set, crowd.agents(), obstacles).obstacles.values.size();
  };
  const std::size_t expected = answer();
  ASSERT_GT(expected, 0u);
  fail_each_with_threads([&] { collide(set, crowd.agents(), obstacles, hits); },
                         [&] { EXPECT_EQ(answer(), expected); }, 2);
}

/// Answers that need no memory come without any, once TBB has its own.
TEST_F(AllocationFaults, QueriesWithoutMemory) {
  const std::vector<Pair> pairs = candidate_pairs(set, crowd.agents());
  std::vector<std::uint8_t> hits(pairs.size());
  std::vector<float> distance(pairs.size());
  std::vector<Vec2> direction(pairs.size());
  const auto ask = [&] {
    collide(set, crowd.agents(), pairs, hits);
    clearance(set, crowd.agents(), pairs, {distance, direction});
  };
  tbb::task_arena arena(1);
  arena.execute(ask);
  const auto expected_hits = std::exchange(hits, std::vector<std::uint8_t>(pairs.size()));
  const auto expected_distance = std::exchange(distance, std::vector<float>(pairs.size()));
  arena.execute([&] {
    test::fail_allocations(test::Failing::all, 0);
    ask();
    EXPECT_EQ(test::stop_failing_allocations(), 0u);
  });
  EXPECT_EQ(hits, expected_hits);
  EXPECT_EQ(distance, expected_distance);
}

}  // namespace
}  // namespace bch
