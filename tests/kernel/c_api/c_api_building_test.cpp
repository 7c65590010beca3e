// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include <bch/bch.hpp>

#include "tests/support/c_api.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/program_run.hpp"

// Sets that are built by the C interface have the bytes of those that the C++ library builds.

namespace bch {
namespace {

using test::expect_ok;
using test::made;

test::OwnedCharacter female() {
  return made<test::OwnedCharacter>([](bch_character** to) { return bch_character_default(BCH_FEMALE, to); });
}

test::OwnedSet finished(const test::OwnedBuilder& builder) {
  return made<test::OwnedSet>(
      [&](bch_shape_set** to) { return bch_shape_set_builder_finish(builder.get(), to); });
}

test::OwnedBuilder builder_of(const bch_plan* plan) {
  return made<test::OwnedBuilder>(
      [&](bch_shape_set_builder** to) { return bch_shape_set_builder_create(plan, to); });
}

std::string bytes_of(const bch_shape_set* set) {
  const TemporaryFolder folder;
  const std::string file = folder.file("c.bch");
  expect_ok(bch_shape_set_save(set, file.c_str()));
  return test::read_text(file);
}

std::string bytes_of(const ShapeSet& set, const ShapeOrigins& origins) {
  const TemporaryFolder folder;
  const std::string file = folder.file("own.bch");
  save_baked(file, set, origins);
  return test::read_text(file);
}

const std::vector<std::uint32_t> depths = {0, 3, all_depths};
const std::vector<float> slices = {0.6f, 1.1f};

bch_plan c_plan() {
  bch_plan plan = BCH_PLAN_INIT;
  plan.depths = depths.data(), plan.depth_count = depths.size();
  plan.slices = slices.data(), plan.slice_count = slices.size();
  plan.threshold = 0.02f;
  return plan;
}

TEST(CApiBuilding, SetsOfPosesHaveTheBytesOfTheLibrary) {
  const Character character = default_female();
  const ShapeSetPlan plan{.depths = depths, .slices = slices};
  const std::vector<PoseTime> times = sample_poses(character, 20);
  PoseShaper shaper(character, plan, 0.02f);
  ShapeOrigins origins{static_cast<double>(0.02f), {"default:female"}, {}};
  for (const Clip& clip : character.clips) origins.names.push_back(clip.name);
  std::vector<Shape> shapes;
  for (const PoseTime& at : times) {
    shapes.push_back(shaper.shape(at));
    origins.origins.push_back({0, 1 + at.clip, at.seconds});
  }
  const std::string expected = bytes_of(ShapeSet(shapes, plan), origins);

  const auto c_character = female();
  std::vector<bch_pose> poses(20);
  expect_ok(bch_character_sample_poses(c_character.get(), 20, poses.data()));
  const bch_plan with_slices = c_plan();
  const auto builder = builder_of(&with_slices);
  for (const std::uint32_t threads : {0u, 1u, 2u}) {
    bch_work work = BCH_WORK_INIT;
    work.threads = threads;
    expect_ok(bch_shape_set_builder_add_poses(builder.get(), c_character.get(), poses.data(), 20, &work));
    EXPECT_EQ(bytes_of(finished(builder).get()), expected) << threads;
  }

  const auto c_shaper = made<test::OwnedShaper>(
      [&](bch_pose_shaper** to) { return bch_pose_shaper_create(c_character.get(), &with_slices, to); });
  for (const bch_pose& pose : poses) {
    expect_ok(bch_pose_shaper_make(c_shaper.get(), pose, 0));
    expect_ok(bch_shape_set_builder_add_shape(builder.get(), c_shaper.get()));
  }
  const auto set = finished(builder);
  EXPECT_EQ(bytes_of(set.get()), expected);
  bch_shape_origin origin;
  expect_ok(bch_shape_set_get_origin(set.get(), 7, &origin));
  EXPECT_STREQ(origin.character, "default:female");
  EXPECT_EQ(origin.clip, character.clips[times[7].clip].name);
  EXPECT_EQ(origin.seconds, times[7].seconds);
}

TEST(CApiBuilding, BodiesOfOnesOwnAreThoseOfTheLibrary) {
  const std::vector<Vec2> chair = {{-0.4f, -0.3f}, {0.4f, -0.3f}, {0.4f, 0.3f}, {-0.4f, 0.3f}};
  const Capsule limb{{-0.2f, 0}, {0.2f, 0.1f}, 0.1f};
  const Disc disc{0.1f, 0, 0.2f};
  const ShapeSet own(std::vector<Shape>{shape_from_polygons({&chair, 1}),
                                        shape_from_capsules({&limb, 1}, 0.002f),
                                        {{}, fixed_cylinder(0.3f)}},
                     {.heights = true});
  bch_plan plan = BCH_PLAN_INIT;
  plan.heights = 1;
  const auto builder = builder_of(&plan);
  const std::uint64_t offsets[] = {0, 4};
  const bch_capsule c_limb{{-0.2f, 0}, {0.2f, 0.1f}, 0.1f};
  expect_ok(bch_shape_set_builder_add_polygons(builder.get(), reinterpret_cast<const bch_vec2*>(chair.data()),
                                               offsets, 1, nullptr));
  expect_ok(bch_shape_set_builder_add_capsules(builder.get(), &c_limb, 1, 0.002f, nullptr));
  expect_ok(bch_shape_set_builder_add_cylinder(builder.get(), 0.3f, nullptr));
  const auto set = finished(builder);
  EXPECT_EQ(bytes_of(set.get()), bytes_of(own, {static_cast<double>(0.01f),
                                                {"polygons", "capsules", "cylinder"},
                                                {{0, ShapeOrigin::rest_pose, 0},
                                                 {1, ShapeOrigin::rest_pose, 0},
                                                 {2, ShapeOrigin::rest_pose, 0}}}));

  // Discs, with heights: they do not meet what is above them.
  const bch_disc c_disc{disc.x, disc.y, disc.radius};
  const bch_heights low{0, 1}, high{1.5f, 2};
  expect_ok(bch_shape_set_builder_add_discs(builder.get(), &c_disc, 1, &low));
  expect_ok(bch_shape_set_builder_add_discs(builder.get(), &c_disc, 1, &high));
  const auto discs = finished(builder);
  test::Crowd crowd;
  crowd.add({0, 0, 0, 0, 0}), crowd.add({1, 0, 0, 0, 0}), crowd.add({1, 0, 0, 0, 0});
  crowd.z = {0, 0, -1};
  const bch_agents agents = test::c_agents(crowd);
  const bch_pair pairs[] = {{0, 1}, {0, 2}};
  std::uint8_t hits[2];
  expect_ok(bch_collide(discs.get(), &agents, pairs, 2, nullptr, hits));
  EXPECT_EQ(hits[0], 0);
  EXPECT_EQ(hits[1], 1);
}

TEST(CApiBuilding, AMeshStandsWhereItsVerticesAre) {
  const bch_vec3 positions[] = {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 2}};
  const std::uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
  const auto builder = builder_of(nullptr);
  expect_ok(bch_shape_set_builder_add_mesh(builder.get(), positions, 4, triangles, 2));
  const auto set = finished(builder);
  bch_outline outline = BCH_OUTLINE_INIT;
  bch_vec2 points[8];
  outline.points = points, outline.point_capacity = 8;
  expect_ok(bch_shape_set_get_outline(set.get(), 0, 0, &outline));
  ASSERT_EQ(outline.point_count, 4u);
  EXPECT_EQ(outline.offset_count, 2u);
  for (const bch_vec2& corner : {bch_vec2{1, 0}, bch_vec2{2, 0}, bch_vec2{2, 1}, bch_vec2{1, 1}})
    EXPECT_TRUE(std::any_of(points, points + 4,
                            [&](const bch_vec2& p) {
                              return std::abs(p.x - corner.x) < 1e-6f && std::abs(p.y - corner.y) < 1e-6f;
                            }))
        << corner.x << " " << corner.y;
}

/// The poses of a crowd in two frames, and then the same in a set that is new.
TEST(CApiBuilding, ReplacedShapesAreThoseOfNewSets) {
  const auto character = female();
  std::vector<bch_pose> poses(24);
  expect_ok(bch_character_sample_poses(character.get(), 24, poses.data()));
  const auto builder = builder_of(nullptr);
  const auto of = [&](std::span<const bch_pose> some) {
    expect_ok(
        bch_shape_set_builder_add_poses(builder.get(), character.get(), some.data(), some.size(), nullptr));
    return finished(builder);
  };
  const auto start = of(std::span(poses).first(12)), later = of(std::span(poses).last(12));
  const auto dynamic = made<test::OwnedDynamicSet>(
      [&](bch_dynamic_shape_set** to) { return bch_dynamic_shape_set_create(start.get(), to); });
  std::vector<std::uint32_t> which;
  for (std::uint32_t i = 0; i < 12; ++i) which.push_back(11 - i);
  std::vector<bch_pose> backwards(poses.rbegin(), poses.rbegin() + 12);
  bch_work work = BCH_WORK_INIT;
  work.threads = 2;
  expect_ok(bch_dynamic_shape_set_replace_poses(dynamic.get(), character.get(), which.data(),
                                                backwards.data(), 11, 0.01f, &work));
  const auto shaper = made<test::OwnedShaper>(
      [&](bch_pose_shaper** to) { return bch_pose_shaper_create(character.get(), nullptr, to); });
  expect_ok(bch_pose_shaper_make(shaper.get(), backwards[11], 0));
  expect_ok(bch_dynamic_shape_set_replace(dynamic.get(), 0, shaper.get()));

  const bch_shape_set* present = nullptr;
  expect_ok(bch_dynamic_shape_set_get_shapes(dynamic.get(), &present));
  for (std::uint32_t shape = 0; shape < 12; ++shape) {
    bch_disc a[1000], b[1000];
    std::size_t discs_a = 0, discs_b = 0;
    expect_ok(bch_shape_set_get_discs(present, shape, 0, a, 1000, &discs_a));
    expect_ok(bch_shape_set_get_discs(later.get(), shape, 0, b, 1000, &discs_b));
    ASSERT_EQ(discs_a, discs_b);
    EXPECT_EQ(std::memcmp(a, b, discs_a * sizeof *a), 0) << shape;
  }
}

TEST(CApiBuilding, CallersHearOfProgressAndCancel) {
  const auto character = female();
  std::vector<bch_pose> poses(400);
  expect_ok(bch_character_sample_poses(character.get(), 400, poses.data()));
  struct Heard {
    std::uint64_t calls = 0, last = 0, cancel_at = ~std::uint64_t{0};
  } heard;
  bch_work work = BCH_WORK_INIT;
  work.user = &heard;
  work.progress = [](void* user, std::uint64_t done, std::uint64_t total) {
    auto& to = *static_cast<Heard*>(user);
    EXPECT_EQ(total, 400u);
    EXPECT_GE(done, to.last);
    to.last = done;
    return static_cast<std::int32_t>(++to.calls >= to.cancel_at);
  };
  const auto builder = builder_of(nullptr);
  expect_ok(bch_shape_set_builder_add_poses(builder.get(), character.get(), poses.data(), 400, &work));
  EXPECT_EQ(heard.last, 400u);
  finished(builder);

  // The shapes that were added before are there, as if nothing had been tried.
  for (const std::size_t before : {0, 2}) {
    const auto other = builder_of(nullptr);
    for (const auto& to : {builder.get(), other.get()})
      expect_ok(bch_shape_set_builder_add_poses(to, character.get(), poses.data(), before, nullptr));
    heard = {0, 0, 1};
    EXPECT_EQ(bch_shape_set_builder_add_poses(builder.get(), character.get(), poses.data(), 400, &work),
              BCH_CANCELLED);
    EXPECT_LT(heard.last, 400u);
    for (const auto& to : {builder.get(), other.get()})
      expect_ok(bch_shape_set_builder_add_poses(to, character.get(), &poses[100], 1, nullptr));
    EXPECT_EQ(bytes_of(finished(builder).get()), bytes_of(finished(other).get())) << before;
  }
}

TEST(CApiBuilding, CharactersOfFilesAreImported) {
  const TemporaryFolder folder;
  const std::string file = folder.write("strip.gltf", SkinnedStrip{}.text());
  const auto character = made<test::OwnedCharacter>(
      [&](bch_character** to) { return bch_character_import(file.c_str(), nullptr, to); });
  bch_character_info info = BCH_CHARACTER_INFO_INIT;
  expect_ok(bch_character_get_info(character.get(), &info));
  EXPECT_EQ(info.triangles, 2u);
  EXPECT_STREQ(info.name, "strip.gltf");
  const char* name = nullptr;
  float seconds = 0;
  expect_ok(bch_character_get_clip(character.get(), 0, &name, &seconds));
  EXPECT_STREQ(name, "walk");
  EXPECT_GT(seconds, 0);
  EXPECT_EQ(bch_character_get_clip(character.get(), info.clips, &name, &seconds), BCH_OUT_OF_RANGE);

  bch_import_options options = BCH_IMPORT_OPTIONS_INIT;
  options.progress = [](void*, std::uint64_t, std::uint64_t) { return 1; };
  bch_character* none = nullptr;
  EXPECT_EQ(bch_character_import(file.c_str(), &options, &none), BCH_CANCELLED);
  options = BCH_IMPORT_OPTIONS_INIT;
  options.most_triangles = 1;
  EXPECT_EQ(bch_character_import(file.c_str(), &options, &none), BCH_BAD_FILE);
  EXPECT_EQ(bch_character_import("/nowhere/a.glb", nullptr, &none), BCH_FILE_NOT_FOUND);
  EXPECT_EQ(none, nullptr);
}

}  // namespace
}  // namespace bch
