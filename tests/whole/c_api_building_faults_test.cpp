// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <bch/baked.hpp>

#include "tests/support/allocation_count.hpp"
#include "tests/support/baked_bytes.hpp"
#include "tests/support/c_api.hpp"
#include "tests/support/c_api_faults.hpp"
#include "tests/support/program_run.hpp"
#include "tests/support/temporary_folder.hpp"

// Files, builders and characters of the C interface that lack memory.

namespace bch {
namespace {

using test::Attempt;
using test::bytes_of;
using test::CApiAllocationFaults;
using test::expect_ok;
using test::fail_each;
using test::fail_each_making;
using test::made;

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

}  // namespace
}  // namespace bch
