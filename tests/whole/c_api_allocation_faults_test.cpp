// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <bch/broad_phase.hpp>

#include "tests/support/allocation_count.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/c_api.hpp"
#include "tests/support/program_run.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

// Every allocation of a call of the C interface fails once, and once with all that follow it.

namespace bch {
namespace {

using test::expect_ok;
using test::made;

/// Makes one call of a round twice: without the memory that it needs, and again with it.
class Attempt {
 public:
  using Call = std::function<bch_status()>;
  using Holds = std::function<bool()>;
  Attempt(test::Failing mode, std::size_t after) : mode_(mode), after_(after) {}

  /// `untouched` is asked after a failure.
  void operator()(
      const Call& call, const Holds& untouched = [] { return true; }) {
    test::fail_allocations(mode_, after_);
    const bch_status status = call();
    failures = test::stop_failing_allocations();
    if (failures == 0) return expect_ok(status);
    EXPECT_EQ(status, BCH_NO_MEMORY) << "allocation " << after_;
    EXPECT_STREQ(bch_last_error(), "out of memory");
    EXPECT_TRUE(untouched()) << "allocation " << after_;
    expect_ok(call());
  }

  std::size_t failures = 0;

 private:
  const test::Failing mode_;
  const std::size_t after_;
};

/// Runs a round, which leaves nothing behind, with the first, second ... allocation of its attempt failing, or with every
/// `step`-th, until there are no more.
/// Returns: how many allocations the attempt takes.
template <class Round>
std::size_t fail_each(Round round, std::size_t step = 1) {
  Attempt first(test::Failing::none, 0);
  round(first);  // what is made once in a program is made
  for (std::size_t after = 0;; after += step)
    for (const test::Failing mode : {test::Failing::one, test::Failing::all}) {
      const std::size_t live = test::live_allocations();
      Attempt attempt(mode, after);
      round(attempt);
      const std::size_t leaked = test::live_allocations() - live;
      EXPECT_EQ(leaked, 0u) << "allocation " << after;
      if (attempt.failures == 0 || testing::Test::HasFailure()) return after;
    }
}

/// The same for a function that makes an object.
template <class Object, class Make>
std::size_t fail_each_making(Make make, bch_status (*free)(Object*), std::size_t step = 1) {
  return fail_each(
      [&](Attempt& attempt) {
        Object* object = nullptr;
        attempt([&] { return make(&object); }, [&] { return object == nullptr; });
        EXPECT_NE(object, nullptr);
        expect_ok(free(object));
      },
      step);
}

const std::vector<std::uint32_t> depths = {0, 2, all_depths};

bch_plan c_plan() {
  bch_plan plan = BCH_PLAN_INIT;
  plan.depths = depths.data(), plan.depth_count = depths.size(), plan.heights = 1;
  return plan;
}

std::string bytes_of(const bch_shape_set* set) {
  static const TemporaryFolder folder;
  const std::string file = folder.file("set.bch");
  expect_ok(bch_shape_set_save(set, file.c_str()));
  return test::read_text(file);
}

class CApiAllocationFaults : public testing::Test {
 protected:
  CApiAllocationFaults() {
    test::Random random(91);
    for (int i = 0; i < 100; ++i)
      crowd.add({random.below(set_of_shapes.shape_count()), random.uniform(0, 4), random.uniform(0, 4),
                 random.uniform(-4, 4), static_cast<std::uint8_t>(random.below(3))});
    agents = test::c_agents(crowd);
    one_thread.threads = 1;
  }

  /// A builder that has a shape already, which stays whatever happens to the next.
  test::OwnedBuilder begun() const {
    const auto create = [&](bch_shape_set_builder** to) { return bch_shape_set_builder_create(&plan, to); };
    auto builder = made<test::OwnedBuilder>(create);
    const bch_disc discs[] = {{0, 0, 0.25f}, {0, 0.25f, 0.125f}};
    expect_ok(bch_shape_set_builder_add_discs(builder.get(), discs, 2, nullptr));
    return builder;
  }

  std::string finished(const test::OwnedBuilder& builder) const {
    return bytes_of(made<test::OwnedSet>([&](bch_shape_set** to) {
                      return bch_shape_set_builder_finish(builder.get(), to);
                    }).get());
  }

  /// What a function adds to a builder it adds once, after whatever failed.
  template <class Add>
  std::size_t fail_each_adding(Add add, std::size_t step = 1) {
    const auto expected = begun();
    expect_ok(add(expected.get()));
    const std::string bytes = finished(expected);
    return fail_each(
        [&](Attempt& attempt) {
          const auto builder = begun();
          attempt([&] { return add(builder.get()); });
          EXPECT_EQ(finished(builder), bytes);
        },
        step);
  }

  /// A man who stands, of whom shapes are made.
  test::OwnedCharacter man() const {
    return made<test::OwnedCharacter>([](bch_character** to) { return bch_character_default(BCH_MALE, to); });
  }

  test::OwnedShaper standing(const test::OwnedCharacter& of) const {
    auto shaper = made<test::OwnedShaper>(
        [&](bch_pose_shaper** to) { return bch_pose_shaper_create(of.get(), &plan, to); });
    expect_ok(bch_pose_shaper_make(shaper.get(), {BCH_REST_POSE, 0}, 0));
    return shaper;
  }

  const ShapeSet set_of_shapes{test::few_shapes(), {.depths = depths, .heights = true}};
  const test::OwnedSet set = test::c_set(set_of_shapes);
  const bch_plan plan = c_plan();
  test::Crowd crowd;
  bch_agents agents;
  bch_query_options one_thread = BCH_QUERY_OPTIONS_INIT;
};

TEST_F(CApiAllocationFaults, Load) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.bch");
  save_baked(file, set_of_shapes);
  for (const std::int32_t access : {BCH_READ, BCH_MAP})
    EXPECT_GT(
        fail_each_making([&](bch_shape_set** to) { return bch_shape_set_load(file.c_str(), access, to); },
                         bch_shape_set_free),
        5u);
  const std::string bytes = test::read_text(file);
  const std::string copy = folder.file("b.bch");
  EXPECT_GT(fail_each([&](Attempt& attempt) {
              attempt([&] { return bch_shape_set_save(set.get(), copy.c_str()); });
              EXPECT_EQ(test::read_text(copy), bytes);
            }),
            5u);
}

TEST_F(CApiAllocationFaults, BuildersAndWhatTheyAdd) {
  const auto create = [&](bch_shape_set_builder** to) { return bch_shape_set_builder_create(&plan, to); };
  EXPECT_GT(fail_each_making(create, bch_shape_set_builder_free), 3u);
  const bch_vec2 corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::uint64_t square[] = {0, 4};
  const bch_heights heights{0, 1};
  EXPECT_GT(fail_each_adding([&](bch_shape_set_builder* to) {
              return bch_shape_set_builder_add_polygons(to, corners, square, 1, &heights);
            }),
            5u);
  const bch_capsule limb{{-0.25f, 0}, {0.25f, 0.125f}, 0.125f};
  EXPECT_GT(fail_each_adding([&](bch_shape_set_builder* to) {
              return bch_shape_set_builder_add_capsules(to, &limb, 1, 0.01f, nullptr);
            }),
            5u);
  const bch_disc disc{0.5f, 0, 0.25f};
  EXPECT_GT(fail_each_adding([&](bch_shape_set_builder* to) {
              return bch_shape_set_builder_add_discs(to, &disc, 1, &heights);
            }),
            2u);
  EXPECT_GT(fail_each_adding([&](bch_shape_set_builder* to) {
              return bch_shape_set_builder_add_cylinder(to, 0.25f, nullptr);
            }),
            2u);
  const bch_vec3 positions[] = {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 2}};
  const std::uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
  EXPECT_GT(fail_each_adding([&](bch_shape_set_builder* to) {
              return bch_shape_set_builder_add_mesh(to, positions, 4, triangles, 2);
            }),
            20u);
}

TEST_F(CApiAllocationFaults, ShapesOfCharacters) {
  const auto character = man();
  const auto shaper = standing(character);
  EXPECT_GT(fail_each_adding(
                [&](bch_shape_set_builder* to) { return bch_shape_set_builder_add_shape(to, shaper.get()); }),
            5u);
  bch_work work = BCH_WORK_INIT;
  work.threads = 1;
  const bch_pose poses[] = {{BCH_REST_POSE, 0}, {0, 0}};
  EXPECT_GT(fail_each_adding(
                [&](bch_shape_set_builder* to) {
                  return bch_shape_set_builder_add_poses(to, character.get(), poses, 2, &work);
                },
                7),
            20u);
}

/// A set that could not be finished is finished later; its builder begins another one.
TEST_F(CApiAllocationFaults, Finish) {
  const bch_vec2 corners[] = {{0, 0}, {1, 0}, {1, 1}};
  const std::uint64_t offsets[] = {0, 3};
  for (const bool alone : {true, false}) {  // discs alone are kept in another way
    const auto filled = [&] {
      auto builder = begun();
      if (!alone) expect_ok(bch_shape_set_builder_add_polygons(builder.get(), corners, offsets, 1, nullptr));
      return builder;
    };
    const std::string expected = finished(filled());
    EXPECT_GT(fail_each([&](Attempt& attempt) {
                const auto builder = filled();
                bch_shape_set* made = nullptr;
                attempt([&] { return bch_shape_set_builder_finish(builder.get(), &made); },
                        [&] { return made == nullptr; });
                EXPECT_EQ(bytes_of(made), expected);
                expect_ok(bch_shape_set_free(made));
                const bch_disc discs[] = {{0, 0, 0.25f}, {0, 0.25f, 0.125f}};
                expect_ok(bch_shape_set_builder_add_discs(builder.get(), discs, 2, nullptr));
                if (alone) {
                  EXPECT_EQ(finished(builder), expected);
                }
              }),
              5u);
  }
}

/// One that could not be finished may get more shapes instead.
TEST_F(CApiAllocationFaults, FinishAfterMore) {
  const bch_vec2 corners[] = {{0, 0}, {1, 0}, {1, 1}};
  const std::uint64_t offsets[] = {0, 3};
  const auto add = [&](const test::OwnedBuilder& to) {
    expect_ok(bch_shape_set_builder_add_polygons(to.get(), corners, offsets, 1, nullptr));
  };
  const auto other = begun();
  add(other);
  const std::string expected = finished(other);
  for (std::size_t after = 0;; ++after) {
    const auto builder = begun();
    bch_shape_set* none = nullptr;
    test::fail_allocations(test::Failing::all, after);
    const bch_status status = bch_shape_set_builder_finish(builder.get(), &none);
    if (test::stop_failing_allocations() == 0) {
      EXPECT_GT(after, 5u);
      return expect_ok(bch_shape_set_free(none));
    }
    EXPECT_EQ(status, BCH_NO_MEMORY);
    add(builder);
    ASSERT_EQ(finished(builder), expected) << after;
  }
}

TEST_F(CApiAllocationFaults, DynamicSets) {
  const auto create = [&](bch_dynamic_shape_set** to) { return bch_dynamic_shape_set_create(set.get(), to); };
  EXPECT_GT(fail_each_making(create, bch_dynamic_shape_set_free), 5u);
  const auto character = man();
  const auto shaper = standing(character);
  bch_work work = BCH_WORK_INIT;
  work.threads = 1;
  EXPECT_GT(fail_each([&](Attempt& attempt) {
              const auto dynamic = made<test::OwnedDynamicSet>(create);
              const bch_shape_set* lent = nullptr;
              expect_ok(bch_dynamic_shape_set_get_shapes(dynamic.get(), &lent));
              float radius = 0, now = 0;
              expect_ok(bch_shape_set_get_radius(lent, 1, &radius));
              attempt([&] { return bch_dynamic_shape_set_replace(dynamic.get(), 1, shaper.get()); },
                      [&] {
                        expect_ok(bch_shape_set_get_radius(lent, 1, &now));
                        return now == radius;
                      });
              expect_ok(bch_shape_set_get_radius(lent, 1, &now));
              EXPECT_NE(now, radius);
            }),
            5u);
  const std::uint32_t which[] = {2, 0};
  const bch_pose poses[] = {{BCH_REST_POSE, 0}, {0, 0}};
  EXPECT_GT(fail_each(
                [&](Attempt& attempt) {
                  const auto dynamic = made<test::OwnedDynamicSet>(create);
                  attempt([&] {
                    return bch_dynamic_shape_set_replace_poses(dynamic.get(), character.get(), which, poses,
                                                               2, 0.01f, &work);
                  });
                },
                7),
            20u);
}

TEST_F(CApiAllocationFaults, Characters) {
  const auto create = [](bch_character** to) { return bch_character_default(BCH_FEMALE, to); };
  EXPECT_GT(fail_each_making(create, bch_character_free, 2'003), 10'000u);
  const auto character = man();
  const auto shaper = [&](bch_pose_shaper** to) {
    return bch_pose_shaper_create(character.get(), &plan, to);
  };
  EXPECT_GT(fail_each_making(shaper, bch_pose_shaper_free, 3), 20u);
  std::vector<bch_pose> poses(5);
  EXPECT_GT(fail_each([&](Attempt& attempt) {
              poses.assign(5, {77, 0});
              attempt([&] { return bch_character_sample_poses(character.get(), 5, poses.data()); },
                      [&] { return poses[0].clip == 77; });
              EXPECT_NE(poses[4].clip, 77u);
            }),
            0u);
}

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
    return bch_obstacles_from_wkt(
        "LINESTRING(0 0, 5 5, 9 1) POLYGON((2 2, 4 2, 4 4, 2 4), (2.5 2.5, 3 2.5, 3 3))", 1, to);
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

TEST_F(CApiAllocationFaults, Scenes) {
  const auto character = man();
  const bch_character* const people[] = {character.get()};
  const bch_shape_source sources[] = {{0, {BCH_REST_POSE, 0}, 1}, {0, {0, 0}, 0}};
  bch_work work = BCH_WORK_INIT;
  work.threads = 1;
  EXPECT_GT(fail_each_adding(
                [&](bch_shape_set_builder* to) {
                  return bch_shape_set_builder_add_sources(to, people, 1, sources, 2, &work);
                },
                11),
            20u);
  const bch_pose poses[] = {{0, 0}, {0, 1}, {BCH_REST_POSE, 0}};
  bch_scene_agents of = BCH_SCENE_AGENTS_INIT;
  of.poses = poses, of.count = 3;
  EXPECT_GT(fail_each_making([&](bch_scene_plan** to) { return bch_scene_plan_create(&of, nullptr, to); },
                             bch_scene_plan_free),
            5u);
  const bch_vec3 positions[] = {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}};
  const std::uint32_t triangles[] = {0, 1, 2};
  bch_character_arrays arrays = BCH_CHARACTER_ARRAYS_INIT;
  arrays.vertices = positions, arrays.vertex_count = 3, arrays.triangles = triangles,
  arrays.triangle_count = 1;
  EXPECT_GT(fail_each_making([&](bch_character** to) { return bch_character_create(&arrays, to); },
                             bch_character_free),
            5u);
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
