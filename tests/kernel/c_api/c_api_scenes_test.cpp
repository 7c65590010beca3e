// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include <bch/bch.hpp>

#include "tests/support/c_api.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/program_run.hpp"

// Scenes that the C interface plans, and characters that it makes of arrays, are those of the C++ library.

namespace bch {
namespace {

using test::expect_ok;
using test::made;

/// A character in arrays, as callers of the C interface have it.
class Arrays {
 public:
  explicit Arrays(const Character& of) {
    static_assert(sizeof(Affine3) == sizeof(bch_affine3) && sizeof(Influence) == sizeof(bch_influence));
    for (const Joint& joint : of.joints)
      parents_.push_back(joint.parent), rests_.push_back(joint.rest), names_.push_back(joint.name.c_str());
    for (const Bone& bone : of.bones) bones_.push_back(bone.joint), binds_.push_back(bone.inverse_bind);
    begin_.assign(of.influence_begin.begin(), of.influence_begin.end());
    for (const Clip& clip : of.clips) add(clip);
    all.name = of.name.c_str(), all.root_joint = of.root_joint;
    all.vertices = reinterpret_cast<const bch_vec3*>(of.vertices.data()),
    all.vertex_count = of.vertices.size();
    all.triangles = of.triangles.front().data(), all.triangle_count = of.triangles.size();
    all.parents = parents_.data(), all.rests = affine(rests_.data()), all.joint_names = names_.data();
    all.joint_count = parents_.size();
    all.bone_joints = bones_.data(), all.inverse_binds = affine(binds_.data()),
    all.bone_count = bones_.size();
    all.influence_offsets = begin_.data();
    all.influences = reinterpret_cast<const bch_influence*>(of.influences.data());
    all.clips = clips_.data(), all.clip_count = clips_.size();
    all.to_ground = affine(&of.to_ground);
  }

  bch_character_arrays all = BCH_CHARACTER_ARRAYS_INIT;

  test::OwnedCharacter character() const {
    return made<test::OwnedCharacter>([&](bch_character** to) { return bch_character_create(&all, to); });
  }

 private:
  static const bch_affine3* affine(const Affine3* maps) { return reinterpret_cast<const bch_affine3*>(maps); }

  template <class Value>
  bch_curve curve_of(const std::vector<Key<Value>>& keys, const Curve<Value>& curve) {
    constexpr std::size_t width = sizeof(Value) / sizeof(float);
    std::vector<float>&times = numbers_.emplace_back(), &values = numbers_.emplace_back();
    for (const Key<Value>& key : keys) {
      const auto* const of = reinterpret_cast<const float*>(&key.value);
      times.push_back(key.time), values.insert(values.end(), of, of + width);
    }
    return {times.data(), values.data(), reinterpret_cast<const float*>(curve.tangents.data()), keys.size(),
            static_cast<std::int32_t>(curve.interpolation)};
  }

  void add(const Clip& clip) {
    std::vector<bch_channel>& channels = channels_.emplace_back();
    for (const Channel& of : clip.channels)
      channels.push_back({of.joint, curve_of(of.positions, of.position_curve),
                          curve_of(of.rotations, of.rotation_curve), curve_of(of.scales, of.scale_curve)});
    clips_.push_back({clip.name.c_str(), clip.seconds, channels.data(), channels.size()});
  }

  std::vector<std::int32_t> parents_;
  std::vector<Affine3> rests_, binds_;
  std::vector<const char*> names_;
  std::vector<std::uint32_t> bones_;
  std::vector<std::uint64_t> begin_;
  std::deque<std::vector<float>> numbers_;
  std::deque<std::vector<bch_channel>> channels_;
  std::vector<bch_clip> clips_;
};

/// A woman, and among her clips one whose curves are of every kind.
Character woman() {
  Character of = default_female();
  const auto half = std::sqrt(0.5f);
  Channel channel;
  channel.joint = 3;
  channel.positions = {{0, {0, 0, 0}}, {1, {0.1f, 0, 0.2f}}};
  channel.position_curve = {Interpolation::cubic, {{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 0}, {0, 0, 0}}}};
  channel.rotations = {{0, {0, 0, 0, 1}}, {0.5f, {0, 0, half, half}}};
  channel.rotation_curve = {Interpolation::cubic,
                            {{{0, 0, 0, 0}, {0, 0, 0.5f, 0}}, {{0.25f, 0, 0, 0}, {0, 0, 0, 0}}}};
  channel.scales = {{0, {1, 1, 1}}, {0.25f, {1, 1.5f, 1}}};
  channel.scale_curve.interpolation = Interpolation::step;
  of.clips.push_back({"own", 1, {channel}});
  return of;
}

std::string bytes_of(const bch_shape_set* set) {
  const TemporaryFolder folder;
  const std::string file = folder.file("c.bch");
  expect_ok(bch_shape_set_save(set, file.c_str()));
  return test::read_text(file);
}

/// Compares sets but for where their shapes come from.
void expect_same_set(const bch_shape_set* set, const ShapeSet& own) {
  const TemporaryFolder folder;
  const std::string file = folder.file("c.bch"), again = folder.file("again.bch"),
                    other = folder.file("own.bch");
  expect_ok(bch_shape_set_save(set, file.c_str()));
  save_baked(again, load_baked(file).set);
  save_baked(other, own);
  EXPECT_EQ(test::read_text(again), test::read_text(other));
}

bch_pose c_pose(const PoseTime& at) {
  return {at.clip, at.seconds};
}

test::OwnedSet set_of(const bch_plan& plan, std::span<const bch_character* const> characters,
                      std::span<const bch_shape_source> sources) {
  const auto builder = made<test::OwnedBuilder>(
      [&](bch_shape_set_builder** to) { return bch_shape_set_builder_create(&plan, to); });
  expect_ok(bch_shape_set_builder_add_sources(builder.get(), characters.data(), characters.size(),
                                              sources.data(), sources.size(), nullptr));
  return made<test::OwnedSet>(
      [&](bch_shape_set** to) { return bch_shape_set_builder_finish(builder.get(), to); });
}

TEST(CApiCharacters, OfArraysAreThoseOfTheLibrary) {
  const Character own = woman();
  const Arrays arrays(own);
  const auto character = arrays.character();
  bch_character_info info = BCH_CHARACTER_INFO_INIT;
  expect_ok(bch_character_get_info(character.get(), &info));
  EXPECT_EQ(info.name, own.name);
  EXPECT_EQ(info.joints, own.joints.size());
  EXPECT_EQ(info.triangles, own.triangles.size());

  const auto last = static_cast<std::uint32_t>(own.clips.size() - 1);
  std::vector<PoseTime> times = sample_poses(own, 10);
  for (const float seconds : {0.1f, 0.3f, 0.7f}) times.push_back({last, seconds});
  times.push_back({});
  PoseShaper shaper(own);
  std::vector<Shape> shapes;
  std::vector<bch_shape_source> sources;
  for (const PoseTime& at : times) shapes.push_back(shaper.shape(at)), sources.push_back({0, c_pose(at), 0});
  const bch_plan plan = BCH_PLAN_INIT;
  const bch_character* const alone = character.get();
  expect_same_set(set_of(plan, {&alone, 1}, sources).get(), ShapeSet(shapes));
}

/// Without a skeleton a character is what a mesh is.
TEST(CApiCharacters, OfAMeshAlone) {
  const bch_vec3 positions[] = {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 2}};
  const std::uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
  bch_character_arrays arrays = BCH_CHARACTER_ARRAYS_INIT;
  arrays.vertices = positions, arrays.vertex_count = 4, arrays.triangles = triangles,
  arrays.triangle_count = 2;
  arrays.name = "mesh";
  const auto character =
      made<test::OwnedCharacter>([&](bch_character** to) { return bch_character_create(&arrays, to); });
  const bch_plan plan = BCH_PLAN_INIT;
  const bch_character* const alone = character.get();
  const bch_shape_source rest{0, {BCH_REST_POSE, 0}, 0};
  const auto builder = made<test::OwnedBuilder>(
      [&](bch_shape_set_builder** to) { return bch_shape_set_builder_create(&plan, to); });
  expect_ok(bch_shape_set_builder_add_mesh(builder.get(), positions, 4, triangles, 2));
  const auto mesh = made<test::OwnedSet>(
      [&](bch_shape_set** to) { return bch_shape_set_builder_finish(builder.get(), to); });
  EXPECT_EQ(bytes_of(set_of(plan, {&alone, 1}, {&rest, 1}).get()), bytes_of(mesh.get()));
}

TEST(CApiCharacters, WhatIsWrongWithArrays) {
  const Character own = woman();
  const auto expect_refused = [&](auto spoil, const char* word) {
    Arrays arrays(own);
    spoil(arrays.all);
    bch_character* none = nullptr;
    EXPECT_EQ(bch_character_create(&arrays.all, &none), BCH_INVALID_ARGUMENT) << word;
    EXPECT_NE(std::string(bch_last_error()).find(word), std::string::npos) << bch_last_error();
    EXPECT_EQ(none, nullptr);
  };
  expect_refused([](auto& all) { all.vertices = nullptr; }, "arrays->vertices is NULL");
  expect_refused([](auto& all) { all.triangle_count = SIZE_MAX / 2; }, "arrays->triangle_count");
  expect_refused([](auto& all) { all.vertex_count = 3; }, "vertex");
  expect_refused([](auto& all) { all.root_joint = 1'000; }, "root joint 1000");
  expect_refused([](auto& all) { all.bone_joints = nullptr; }, "arrays->bone_joints is NULL");
  expect_refused([](auto& all) { all.influence_offsets = nullptr, all.bone_count = 0; }, "bone 0");
  std::vector<std::uint64_t> descending(own.vertices.size() + 1);
  descending[0] = 9;
  expect_refused([&](auto& all) { all.influence_offsets = descending.data(); }, "influence_offsets[1] is 0");
  const float late[] = {1, 0}, values[6] = {};
  const auto with_curve = [&](bch_curve curve) {
    return [curve](auto& all) {
      static bch_channel channel;
      static bch_clip clip;
      channel = {0, curve, {}, {}}, clip = {nullptr, 1, &channel, 1};
      all.clips = &clip, all.clip_count = 1;
    };
  };
  expect_refused(with_curve({late, values, nullptr, 2, BCH_LINEAR}), "out of order");
  expect_refused(with_curve({late, values, nullptr, 1, BCH_CUBIC}), "the tangents of a curve is NULL");
  expect_refused(with_curve({late, values, nullptr, 1, 3}), "interpolation of a curve is 3");
}

TEST(CApiScenes, PlansAreThoseOfTheLibrary) {
  const Character own[] = {default_male(), default_female()};
  test::Random random(285);
  std::vector<SceneAgent> agents;
  std::vector<std::uint32_t> characters, depths;
  std::vector<bch_pose> poses;
  std::vector<double> distances;
  const std::uint32_t some[] = {0, 3, all_depths};
  for (int i = 0; i < 200; ++i) {
    characters.push_back(random.below(2)),
        poses.push_back({random.below(2), 0.25f * static_cast<float>(random.below(7))});
    distances.push_back(random.uniform(0, 30)), depths.push_back(some[random.below(3)]);
    agents.push_back({{characters[i], {poses[i].clip, poses[i].seconds}},
                      distances[i],
                      static_cast<double>(depths[i] == all_depths ? 9 : depths[i])});
  }
  const SceneUse use{
      .solid = true,
      .density_depth = [](double of) { return of > 8 ? all_depths : static_cast<std::uint32_t>(of); },
      .slices = {0.5f, 1.1f},
      .whole_from = 20,
      .pose_step = 0.5f,
      .pairs_per_shape = 20};
  const ScenePlan expected = plan_scene(agents, use);
  ASSERT_GT(expected.shapes.size(), 10u);

  bch_scene_agents of = BCH_SCENE_AGENTS_INIT;
  of.character = characters.data(), of.poses = poses.data(), of.distance = distances.data();
  of.depth = depths.data(), of.count = agents.size();
  bch_scene_use c_use = BCH_SCENE_USE_INIT;
  c_use.solid = 1, c_use.slices = use.slices.data(), c_use.slice_count = 2, c_use.whole_from = 20;
  c_use.pose_step = 0.5f, c_use.pairs_per_shape = 20;
  const auto plan =
      made<test::OwnedScenePlan>([&](bch_scene_plan** to) { return bch_scene_plan_create(&of, &c_use, to); });

  const std::uint32_t* shape = nullptr;
  const std::uint8_t* level = nullptr;
  std::size_t count = 0;
  expect_ok(bch_scene_plan_get_agents(plan.get(), &shape, &level, &count));
  EXPECT_EQ(std::vector<std::uint32_t>(shape, shape + count), expected.agent_shape);
  EXPECT_EQ(std::vector<std::uint8_t>(level, level + count), expected.agent_level);

  const bch_shape_source* sources = nullptr;
  bch_plan set_plan = BCH_PLAN_INIT;
  expect_ok(bch_scene_plan_get_shapes(plan.get(), &sources, &count));
  expect_ok(bch_scene_plan_get_set(plan.get(), &set_plan));
  PoseShaper shapers[] = {PoseShaper(own[0], expected.set), PoseShaper(own[1], expected.set)};
  std::vector<Shape> shapes;
  for (const ShapeSource& source : expected.shapes)
    shapes.push_back(shapers[source.character].shape(source.at, source.whole));
  const auto male =
      made<test::OwnedCharacter>([](bch_character** to) { return bch_character_default(BCH_MALE, to); });
  const auto female =
      made<test::OwnedCharacter>([](bch_character** to) { return bch_character_default(BCH_FEMALE, to); });
  const bch_character* const people[] = {male.get(), female.get()};
  const auto set = set_of(set_plan, people, {sources, count});
  expect_same_set(set.get(), ShapeSet(shapes, expected.set));

  for (std::uint32_t i = 0; i < expected.shapes.size(); ++i) {
    bch_shape_origin origin;
    expect_ok(bch_shape_set_get_origin(set.get(), i, &origin));
    const ShapeSource& from = expected.shapes[i];
    EXPECT_STREQ(origin.character, from.character == 0 ? "default:male" : "default:female");
    EXPECT_EQ(origin.clip, own[from.character].clips[from.at.clip].name);
    EXPECT_EQ(origin.seconds, from.at.seconds);
  }
}

TEST(CApiScenes, WhatIsWrongWithThem) {
  const bch_pose pose{0, 0};
  const double behind = -1;
  bch_scene_agents of = BCH_SCENE_AGENTS_INIT;
  of.count = 1;
  bch_scene_plan* none = nullptr;
  EXPECT_EQ(bch_scene_plan_create(&of, nullptr, &none), BCH_INVALID_ARGUMENT);
  EXPECT_STREQ(bch_last_error(), "agents->poses is NULL");
  of.poses = &pose, of.distance = &behind;
  EXPECT_EQ(bch_scene_plan_create(&of, nullptr, &none), BCH_INVALID_ARGUMENT);
  of.distance = nullptr;
  bch_scene_use use = BCH_SCENE_USE_INIT;
  use.leaves = 2;
  EXPECT_EQ(bch_scene_plan_create(&of, &use, &none), BCH_INVALID_ARGUMENT);
  EXPECT_EQ(none, nullptr);

  const auto male =
      made<test::OwnedCharacter>([](bch_character** to) { return bch_character_default(BCH_MALE, to); });
  const bch_character* const people[] = {male.get()};
  const auto builder = made<test::OwnedBuilder>(
      [](bch_shape_set_builder** to) { return bch_shape_set_builder_create(nullptr, to); });
  const bch_shape_source beyond{1, pose, 0}, late{0, {1'000, 0}, 0};
  EXPECT_EQ(bch_shape_set_builder_add_sources(builder.get(), people, 1, &beyond, 1, nullptr),
            BCH_OUT_OF_RANGE);
  EXPECT_STREQ(bch_last_error(), "sources[0].character is 1 of 1");
  EXPECT_EQ(bch_shape_set_builder_add_sources(builder.get(), people, 1, &late, 1, nullptr), BCH_OUT_OF_RANGE);
}

TEST(CApiScenes, BestSlicesAreThoseOfTheLibrary) {
  const Character own[] = {default_male(), default_female()};
  std::vector<float> planes;
  for (int i = 1; i < 18; ++i) planes.push_back(0.1f * static_cast<float>(i));
  const auto male =
      made<test::OwnedCharacter>([](bch_character** to) { return bch_character_default(BCH_MALE, to); });
  const auto female =
      made<test::OwnedCharacter>([](bch_character** to) { return bch_character_default(BCH_FEMALE, to); });
  std::vector<const bch_character*> characters;
  std::vector<bch_pose> poses;
  std::vector<Shape> shapes;
  for (const bool she : {false, true}) {
    PoseShaper shaper(own[she], {.slices = planes});
    for (const PoseTime& at : sample_poses(own[she], 6)) {
      shapes.push_back(shaper.shape(at)), poses.push_back(c_pose(at));
      characters.push_back(she ? female.get() : male.get());
    }
  }
  float found[17];
  std::size_t count = 0;
  const auto ask = [&](std::size_t among, std::uint32_t slabs) {
    return bch_best_slices(characters.data(), poses.data(), poses.size(), planes.data(), among, slabs, found,
                           &count);
  };
  expect_ok(ask(planes.size(), 3));
  EXPECT_EQ(std::vector<float>(found, found + count), best_slices(shapes, planes, 3));
  expect_ok(ask(2, 9));
  EXPECT_EQ(count, 2u);
  EXPECT_EQ(ask(2, 0), BCH_INVALID_ARGUMENT);
  poses[7].clip = 1'000;
  EXPECT_EQ(ask(2, 3), BCH_OUT_OF_RANGE);
  EXPECT_EQ(std::string(bch_last_error()).substr(0, 24), "poses[7].clip is 1000 of");
}

}  // namespace
}  // namespace bch
