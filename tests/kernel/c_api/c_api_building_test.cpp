// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/paper_hierarchies.hpp"
#include "tests/support/c_api.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/test.hpp"

// Characters, sets and scenes that the C interface makes: sets have the bytes of those that the C++ library makes.

namespace bch {
namespace {

using test::expect_ok;
using test::finished;
using test::made;

std::string bytes_of(const bch_shape_set* set) {
  const TemporaryFolder folder;
  const std::string file = folder.file("c.bch").string();
  expect_ok(bch_shape_set_save(set, file.c_str()));
  return test::read_text(file);
}

std::string bytes_of(const ShapeSet& set, const ShapeOrigins& origins) {
  const TemporaryFolder folder;
  const std::string file = folder.file("own.bch").string();
  save_baked(file, set, origins);
  return test::read_text(file);
}

/// The corners of a shape's outline, in order of x and y, to a millimetre.
std::vector<std::pair<double, double>> corners_of(const bch_shape_set* set, std::uint32_t shape) {
  bch_vec2 points[8];
  bch_outline outline = BCH_OUTLINE_INIT;
  outline.points = points, outline.point_capacity = 8;
  expect_ok(bch_shape_set_get_outline(set, shape, &outline));
  EXPECT_EQ(outline.offset_count, 2u);
  std::vector<std::pair<double, double>> all;
  for (std::size_t i = 0; i < outline.point_count; ++i)
    all.emplace_back(std::round(1000 * points[i].x) / 1000, std::round(1000 * points[i].y) / 1000);
  std::sort(all.begin(), all.end());
  return all;
}

TEST(CApiBuilding, SetsOfPosesHaveTheBytesOfTheLibrary) {
  const Character character = default_female();
  const ShapeSetPlan plan{.depths = {0, 3, all_depths}, .heights = true};
  const std::vector<PoseTime> times = sample_poses(character, 20);
  ShapeBuilder shape_builder(character, plan, 0.02f);
  ShapeOrigins origins{static_cast<double>(0.02f), {"default:female"}, {}};
  for (const Clip& clip : character.clips) origins.names.push_back(clip.name);
  std::vector<Shape> shapes;
  for (const PoseTime& at : times) {
    shapes.push_back(shape_builder.shape(at));
    origins.origins.push_back({0, 1 + at.clip, at.seconds});
  }
  const std::string expected = bytes_of(ShapeSet(shapes, plan), origins);

  const auto female = test::c_person(BCH_FEMALE);
  const bch_character* const people[] = {female.get()};
  std::vector<bch_pose> poses(20);
  expect_ok(bch_character_sample_poses(female.get(), 20, poses.data()));
  std::vector<bch_pose_id> sources;
  for (const bch_pose& at : poses) sources.push_back({0, at});
  bch_plan c_plan = BCH_PLAN_INIT;
  c_plan.depths = plan.depths.data(), c_plan.depth_count = 3;
  c_plan.heights = 1;
  c_plan.threshold = 0.02f;
  const auto builder = test::c_builder(&c_plan);
  for (const std::uint32_t threads : {0u, 1u, 2u}) {
    bch_work work = BCH_WORK_INIT;
    work.threads = threads;
    expect_ok(bch_shape_set_builder_add_poses(builder.get(), female.get(), poses.data(), 20, &work));
    EXPECT_EQ(bytes_of(finished(builder).get()), expected) << threads;
    expect_ok(bch_shape_set_builder_add_pose_ids(builder.get(), people, 1, sources.data(), 20, &work));
    EXPECT_EQ(bytes_of(finished(builder).get()), expected) << threads;
    const auto baked = made<bch_shape_set_free>(bch_bake, people, 1, 20, &c_plan, &work);
    EXPECT_EQ(bytes_of(baked.get()), expected) << threads;
  }
  const auto c_shape_builder = made<bch_shape_builder_free>(bch_shape_builder_create, female.get(), &c_plan);
  for (const bch_pose& pose : poses) {
    expect_ok(bch_shape_builder_make(c_shape_builder.get(), pose));
    expect_ok(bch_shape_set_builder_add_shape(builder.get(), c_shape_builder.get()));
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
  std::vector<Shape> own = {shape_from_polygons({&chair, 1}),
                            shape_from_capsules({&limb, 1}, 0.002f),
                            {{}, detail::fixed_cylinder(0.3f)},
                            shape_from_discs({&disc, 1})};
  own[3].heights = {0.5f, 1};
  ShapeOrigins origins{static_cast<double>(0.01f), {"polygons", "capsules", "cylinder", "discs"}, {}};
  for (std::uint32_t i = 0; i < 4; ++i) origins.origins.push_back({i, ShapeOrigin::no_clip, 0});

  bch_plan plan = BCH_PLAN_INIT;
  plan.heights = 1;
  const auto builder = test::c_builder(&plan);
  const bch_vec2 corners[] = {{-0.4f, -0.3f}, {0.4f, -0.3f}, {0.4f, 0.3f}, {-0.4f, 0.3f}};
  const std::uint64_t offsets[] = {0, 4};
  const bch_capsule c_limb{{-0.2f, 0}, {0.2f, 0.1f}, 0.1f};
  const bch_disc c_disc{0.1f, 0, 0.2f};
  const bch_heights heights{0.5f, 1};
  expect_ok(bch_shape_set_builder_add_polygons(builder.get(), corners, offsets, 1, nullptr));
  expect_ok(bch_shape_set_builder_add_capsules(builder.get(), &c_limb, 1, 0.002f, nullptr));
  expect_ok(bch_shape_set_builder_add_cylinder(builder.get(), 0.3f, nullptr));
  expect_ok(bch_shape_set_builder_add_discs(builder.get(), &c_disc, 1, &heights));
  EXPECT_EQ(bytes_of(finished(builder).get()), bytes_of(ShapeSet(own, {.heights = true}), origins));

  const bch_vec3 positions[] = {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 2}};
  const std::uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
  const auto other = test::c_builder();
  expect_ok(bch_shape_set_builder_add_mesh(other.get(), positions, 4, triangles, 2));
  const std::vector<std::pair<double, double>> square = {{1, 0}, {1, 1}, {2, 0}, {2, 1}};
  EXPECT_EQ(corners_of(finished(other).get(), 0), square);
}

/// Each shape is replaced by another's pose, the last one by a shape builder.
TEST(CApiBuilding, ReplacedShapesAreThoseOfNewSets) {
  const auto female = test::c_person(BCH_FEMALE);
  std::vector<bch_pose> poses(6);
  expect_ok(bch_character_sample_poses(female.get(), 6, poses.data()));
  const auto builder = test::c_builder();
  const auto of = [&](const bch_pose* some) {
    expect_ok(bch_shape_set_builder_add_poses(builder.get(), female.get(), some, 3, nullptr));
    return finished(builder);
  };
  const auto start = of(&poses[0]), later = of(&poses[3]);
  const auto dynamic = made<bch_dynamic_shape_set_free>(bch_dynamic_shape_set_create, start.get());
  const std::uint32_t which[] = {1, 0};
  const bch_pose backwards[] = {poses[4], poses[3]};
  expect_ok(
      bch_dynamic_shape_set_replace_poses(dynamic.get(), female.get(), which, backwards, 2, 0.01f, nullptr));
  const auto shape_builder = made<bch_shape_builder_free>(bch_shape_builder_create, female.get(), nullptr);
  expect_ok(bch_shape_builder_make(shape_builder.get(), poses[5]));
  expect_ok(bch_dynamic_shape_set_replace(dynamic.get(), 2, shape_builder.get()));
  const bch_shape_set* present = nullptr;
  expect_ok(bch_dynamic_shape_set_get_shapes(dynamic.get(), &present));
  for (std::uint32_t shape = 0; shape < 3; ++shape)
    EXPECT_EQ(test::bytes(test::discs_of(present, shape)), test::bytes(test::discs_of(later.get(), shape)))
        << shape;
}

TEST(CApiBuilding, CallersHearOfProgressAndCancel) {
  const auto character = test::c_person(BCH_FEMALE);
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
  const auto builder = test::c_builder();
  expect_ok(bch_shape_set_builder_add_poses(builder.get(), character.get(), poses.data(), 400, &work));
  EXPECT_EQ(heard.last, 400u);
  finished(builder);

  // The shapes that were added before are there, as if nothing had been tried.
  for (const std::size_t before : {0, 2}) {
    const auto other = test::c_builder();
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

/// A triangle of centimetres that follows a knee, at (1, 0) m, and its last corner by half. Clips move the knee in every way.
struct Post {
  const bch_vec3 vertices[3] = {{0, 0, 0}, {100, 0, 0}, {0, 200, 100}};
  const std::uint32_t triangles[3] = {0, 1, 2};
  const std::int32_t parents[2] = {-1, 0};
  const bch_affine3 identity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  const bch_affine3 rests[2] = {identity, {{{1, 0, 0, 100}, {0, 1, 0, 0}, {0, 0, 1, 0}}}};
  const bch_affine3 binds[2] = {identity, {{{1, 0, 0, -100}, {0, 1, 0, 0}, {0, 0, 1, 0}}}};
  const char* const names[2] = {"foot", "knee"};
  const std::uint32_t bones[2] = {0, 1};
  const std::uint64_t begin[4] = {0, 1, 2, 4};
  const bch_influence influences[4] = {{1, 1}, {1, 1}, {0, 0.5f}, {1, 0.5f}};
  const float times[2] = {0, 1}, from_rest[6] = {100, 0, 0, 300, 0, 0}, at_rest[6] = {100, 0, 0, 100, 0, 0},
              swings[12] = {0, 0, 0, 800}, turns[8] = {0, 0, 0, 1, 0, 0, std::sqrt(0.5f), std::sqrt(0.5f)},
              grows[6] = {1, 1, 1, 3, 1, 1};
  std::vector<bch_channel> channels = {
      {1, {times, from_rest, nullptr, 2, BCH_LINEAR}, {}, {}},
      {1, {times, at_rest, swings, 2, BCH_CUBIC}, {}, {}},
      {1, {}, {times, turns, nullptr, 2, BCH_LINEAR}, {}},
      {1, {}, {}, {times, grows, nullptr, 2, BCH_STEP}},
  };
  std::vector<bch_clip> clips = {{"slide", 1, &channels[0], 1},
                                 {"swing", 1, &channels[1], 1},
                                 {"turn", 1, &channels[2], 1},
                                 {nullptr, 1, &channels[3], 1}};
  const bch_affine3 to_ground{{{0.01f, 0, 0, 0}, {0, 0.01f, 0, 0}, {0, 0, 0.01f, 0}}};
  bch_character_arrays arrays = BCH_CHARACTER_ARRAYS_INIT;

  Post() {
    arrays.root_joint = 0, arrays.name = "post";
    arrays.vertices = vertices, arrays.vertex_count = 3, arrays.triangles = triangles,
    arrays.triangle_count = 1;
    arrays.parents = parents, arrays.rests = rests, arrays.joint_names = names, arrays.joint_count = 2;
    arrays.bone_joints = bones, arrays.inverse_binds = binds, arrays.bone_count = 2;
    arrays.influence_offsets = begin, arrays.influences = influences;
    arrays.clips = clips.data(), arrays.clip_count = 4, arrays.to_ground = &to_ground;
  }
};

TEST(CApiBuilding, CharactersOfArraysMoveAsTheseSay) {
  const Post post;
  const auto character = made<bch_character_free>(bch_character_create, &post.arrays);
  bch_character_info info = BCH_CHARACTER_INFO_INIT;
  expect_ok(bch_character_get_info(character.get(), &info));
  EXPECT_STREQ(info.name, "post");
  EXPECT_EQ(info.joints, 2u);
  EXPECT_EQ(info.clips, 4u);
  EXPECT_EQ(info.vertices, 3u);
  EXPECT_EQ(info.triangles, 1u);
  const bch_pose poses[] = {{BCH_REST_POSE, 0}, {0, 0.5f}, {1, 0.5f}, {2, 1}, {3, 0.9f}, {3, 1}};
  const std::vector<std::pair<double, double>> corners[] = {
      {{0, 0}, {0, 2}, {1, 0}},       {{0.5, 2}, {1, 0}, {2, 0}}, {{0.5, 2}, {1, 0}, {2, 0}},
      {{-0.5, 0.5}, {1, -1}, {1, 0}}, {{0, 0}, {0, 2}, {1, 0}},   {{-2, 0}, {-1, 2}, {1, 0}}};
  const auto builder = test::c_builder();
  expect_ok(bch_shape_set_builder_add_poses(builder.get(), character.get(), poses, 6, nullptr));
  const auto set = finished(builder);
  for (std::uint32_t i = 0; i < 6; ++i) EXPECT_EQ(corners_of(set.get(), i), corners[i]) << i;

  // Without a skeleton a character is a mesh, where its vertices are.
  bch_character_arrays alone = BCH_CHARACTER_ARRAYS_INIT;
  alone.vertices = post.vertices, alone.vertex_count = 3, alone.triangles = post.triangles,
  alone.triangle_count = 1;
  const auto mesh = made<bch_character_free>(bch_character_create, &alone);
  expect_ok(bch_shape_set_builder_add_poses(builder.get(), mesh.get(), poses, 1, nullptr));
  const std::vector<std::pair<double, double>> as_given = {{0, 0}, {0, 200}, {100, 0}};
  EXPECT_EQ(corners_of(finished(builder).get(), 0), as_given);
}

TEST(CApiBuilding, WhatIsWrongWithArrays) {
  const auto expect_refused = [&](auto spoil, const char* word) {
    Post post;
    spoil(post);
    bch_character* none = nullptr;
    EXPECT_EQ(bch_character_create(&post.arrays, &none), BCH_INVALID_ARGUMENT) << word;
    EXPECT_NE(std::string(bch_last_error()).find(word), std::string::npos) << bch_last_error();
    EXPECT_EQ(none, nullptr);
  };
  const std::uint64_t descending[] = {9, 0, 0, 0};
  const float late[] = {1, 0};
  expect_refused([](Post& of) { of.arrays.vertices = nullptr; }, "arrays->vertices is NULL");
  expect_refused([](Post& of) { of.arrays.triangle_count = SIZE_MAX / 2; }, "arrays->triangle_count");
  expect_refused([](Post& of) { of.arrays.vertex_count = 2; }, "vertex");
  expect_refused([](Post& of) { of.arrays.root_joint = 1'000; }, "root joint 1000");
  expect_refused([](Post& of) { of.arrays.bone_joints = nullptr; }, "arrays->bone_joints is NULL");
  expect_refused([](Post& of) { of.arrays.influence_offsets = nullptr, of.arrays.bone_count = 0; }, "bone 0");
  expect_refused([&](Post& of) { of.arrays.influence_offsets = descending; }, "influence_offsets[1] is 0");
  expect_refused([&](Post& of) { of.channels[0].positions.times = late; }, "out of order");
  expect_refused([](Post& of) { of.channels[1].positions.tangents = nullptr; },
                 "the tangents of a curve is NULL");
  expect_refused([](Post& of) { of.channels[0].positions.interpolation = 3; },
                 "interpolation of a curve is 3");
}

TEST(CApiBuilding, ScenesArePlanned) {
  const std::uint32_t characters[] = {0, 0, 1, 0}, depths[] = {0, BCH_ALL_DEPTHS, 0, 0};
  const bch_pose poses[] = {{0, 0.1f}, {0, 0.4f}, {0, 0.6f}, {0, 0.6f}};
  bch_scene_agents of = BCH_SCENE_AGENTS_INIT;
  of.character = characters, of.poses = poses, of.depth = depths, of.count = 4;
  bch_scene_requirements use = BCH_SCENE_REQUIREMENTS_INIT;
  use.outlines = 0, use.heights = 1;
  use.pose_step = 0.5f, use.pairs_per_shape = 20;
  const auto plan = made<bch_scene_plan_free>(bch_scene_plan_create, &of, &use);

  const std::uint32_t* shape = nullptr;
  const std::uint8_t* level = nullptr;
  const bch_pose_id* sources = nullptr;
  std::size_t count = 0;
  expect_ok(bch_scene_plan_get_agents(plan.get(), &shape, &level, &count));
  EXPECT_EQ(std::vector<std::uint32_t>(shape, shape + count), (std::vector<std::uint32_t>{0, 0, 1, 2}));
  EXPECT_EQ(std::vector<std::uint8_t>(level, level + count), (std::vector<std::uint8_t>{0, 1, 0, 0}));
  bch_plan set_plan = BCH_PLAN_INIT;
  expect_ok(bch_scene_plan_get_set(plan.get(), &set_plan));
  EXPECT_EQ(std::vector<std::uint32_t>(set_plan.depths, set_plan.depths + set_plan.depth_count),
            (std::vector<std::uint32_t>{0, BCH_ALL_DEPTHS}));
  EXPECT_EQ(set_plan.outlines, 0);
  EXPECT_EQ(set_plan.heights, 1);
  EXPECT_EQ(set_plan.culling, 0);  // it does not pay for 20 pairs
  expect_ok(bch_scene_plan_get_shapes(plan.get(), &sources, &count));
  ASSERT_EQ(count, 3u);
  EXPECT_EQ(sources[1].character, 1u);
  EXPECT_EQ(sources[1].at.seconds, 0.5f);
  EXPECT_EQ(sources[2].character, 0u);

  const auto male = test::c_person(BCH_MALE), female = test::c_person(BCH_FEMALE);
  const bch_character* const people[] = {male.get(), female.get()};
  const auto builder = test::c_builder(&set_plan);
  expect_ok(bch_shape_set_builder_add_pose_ids(builder.get(), people, 2, sources, count, nullptr));
  const auto set = finished(builder);
  for (const auto& [made, from, seconds] :
       {std::tuple(0u, "default:male", 0.0f), {1u, "default:female", 0.5f}}) {
    bch_shape_origin origin;
    expect_ok(bch_shape_set_get_origin(set.get(), made, &origin));
    EXPECT_STREQ(origin.character, from);
    EXPECT_EQ(origin.seconds, seconds);
  }
}

TEST(CApiBuilding, WhatIsWrongWithScenes) {
  const bch_pose pose{0, 0};
  bch_scene_agents of = BCH_SCENE_AGENTS_INIT;
  of.count = 1;
  bch_scene_plan* none = nullptr;
  EXPECT_EQ(bch_scene_plan_create(&of, nullptr, &none), BCH_INVALID_ARGUMENT);
  EXPECT_STREQ(bch_last_error(), "agents->poses is NULL");
  of.poses = &pose;
  bch_scene_requirements use = BCH_SCENE_REQUIREMENTS_INIT;
  use.pose_step = -1;
  EXPECT_EQ(bch_scene_plan_create(&of, &use, &none), BCH_INVALID_ARGUMENT);
  EXPECT_EQ(none, nullptr);

  const auto male = test::c_person(BCH_MALE);
  const bch_character* const people[] = {male.get()};
  const auto builder = test::c_builder();
  const bch_pose_id beyond{1, pose}, late{0, {1'000, 0}};
  EXPECT_EQ(bch_shape_set_builder_add_pose_ids(builder.get(), people, 1, &beyond, 1, nullptr),
            BCH_OUT_OF_RANGE);
  EXPECT_STREQ(bch_last_error(), "pose_ids[0].character is 1 of 1");
  EXPECT_EQ(bch_shape_set_builder_add_pose_ids(builder.get(), people, 1, &late, 1, nullptr),
            BCH_OUT_OF_RANGE);
}

TEST(CApiOutlines, AreThoseOfCpp) {
  const auto female = test::c_person(BCH_FEMALE);
  const Character character = default_female();
  std::vector<bch_pose> poses(3);
  expect_ok(bch_character_sample_poses(female.get(), 3, poses.data()));
  bch_outline_options options = BCH_OUTLINE_OPTIONS_INIT;
  options.holes = 1, options.bottom = 0.5f;
  const auto found =
      made<bch_outlines_free>(bch_outlines_of_character, female.get(), poses.data(), 3, &options, nullptr);
  for (std::size_t i = 0; i < 3; ++i) {
    const Outline expected =
        outline(character, {poses[i].clip, poses[i].seconds}, {.between = {.bottom = 0.5f}, .holes = true});
    std::vector<bch_vec2> points(expected.points.size());
    bch_outline one = BCH_OUTLINE_INIT;
    one.points = points.data(), one.point_capacity = points.size();
    expect_ok(bch_outlines_get(found.get(), i, &one));
    ASSERT_EQ(one.point_count, points.size());
    EXPECT_EQ(one.offset_count, expected.contours() + 1);
    EXPECT_EQ(test::bytes(points), test::bytes(expected.points));
    for (const auto& [format, text] :
         {std::pair(BCH_WKT, to_wkt(expected)), {BCH_GEOJSON, to_geojson(expected)}}) {
      std::string read(text.size() + 9, '#');
      std::size_t length = 0;
      expect_ok(bch_outlines_get_text(found.get(), i, format, read.data(), text.size() - 1, &length));
      EXPECT_EQ(length, text.size());
      EXPECT_EQ(read, text.substr(0, length - 1) + std::string(10, '#'));
    }
  }
  std::size_t length = 7;
  EXPECT_EQ(bch_outlines_get_text(found.get(), 3, BCH_WKT, nullptr, 0, &length), BCH_OUT_OF_RANGE);
  EXPECT_EQ(bch_outlines_get_text(found.get(), 0, 2, nullptr, 0, &length), BCH_INVALID_ARGUMENT);
  EXPECT_EQ(length, 7u);
}

}  // namespace
}  // namespace bch
