// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/fuzz/c_api_steps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>

// Characters, builders, plans and sets.

namespace bch::fuzz {

namespace {
/// The built-in man, who costs more than all else of an input: one for all, whom nobody frees.
bch_character* man(Program& by) {
  static bch_character* const one = [] {
    bch_character* made = nullptr;
    require(bch_character_default(BCH_MALE, &made) == BCH_OK, "there is a man");
    return made;
  }();
  return by.chance(16) ? by.handle<bch_character>() : one;
}

}  // namespace

// Characters.

void ask_character(Program& by) {
  Versioned<bch_character_info> info{};
  bch_pose poses[most];
  const char* name = nullptr;
  float seconds = 0;
  Program::succeeded(bch_character_get_info(man(by), by.array(by.sized(info))));
  Program::succeeded(bch_character_get_clip(man(by), by.index(40), by.array(&name), by.array(&seconds)));
  Program::succeeded(bch_character_sample_poses(man(by), by.bytes.below(most + 1), by.array(poses)));
  by.free(bch_character_free);
  bch_character* none = nullptr;
  const std::int32_t which = by.bytes.take<std::int32_t>();
  if (which < BCH_MALE || which > BCH_BULKY_MALE)
    require(!Program::succeeded(bch_character_default(which, &none)), "there are three");
}

namespace {

// Building.

struct Plan {
  std::uint32_t depths[4]{};
  float slices[4]{};
  Versioned<bch_plan> plan{};

  bch_plan* of(Program& by) {
    plan.known = BCH_PLAN_INIT;
    std::uint32_t depth = 0;
    for (std::uint32_t& one : depths) one = depth += by.index(4);
    if (by.chance(2)) depths[by.bytes.below(4)] = BCH_ALL_DEPTHS;
    for (float& one : slices) one = by.number<float>();
    if (!by.chance(8)) std::sort(std::begin(slices), std::end(slices), std::less<>());
    const std::uint8_t bits = by.bytes.take<std::uint8_t>();
    plan.known.outlines = !(bits & 1), plan.known.culling = !(bits & 2), plan.known.heights = bits >> 2 & 1;
    if (bits & 8) plan.known.depths = by.array(depths), plan.known.depth_count = by.count(4);
    if (bits & 16) plan.known.slices = by.array(slices), plan.known.slice_count = by.count(4);
    plan.known.threshold = by.chance(16) ? by.number<float>() : 0.25f;
    return by.chance(16) ? nullptr : by.sized(plan);
  }
};

}  // namespace

void make_builder(Program& by) {
  Plan plan;
  const bch_plan* const of = plan.of(by);
  by.make<bch_shape_set_builder>(
      [&](bch_shape_set_builder** to) { return bch_shape_set_builder_create(of, by.array(to)); });
}

void finish(Program& by) {
  bch_shape_set_builder* const builder = by.handle<bch_shape_set_builder>();
  by.make<bch_shape_set>([&](bch_shape_set** to) { return bch_shape_set_builder_finish(builder, to); });
}

void add_polygons(Program& by) {
  bch_vec2 corners[most];
  std::uint64_t offsets[most + 1];
  for (bch_vec2& corner : corners) corner = {by.number<float>(), by.number<float>()};
  const std::uint32_t polygons = by.bytes.below(4);
  by.fill_offsets(offsets, polygons, most);
  const bch_heights heights{by.number<float>(), by.number<float>()};
  Program::succeeded(bch_shape_set_builder_add_polygons(
      by.handle<bch_shape_set_builder>(), by.array(corners), by.array(offsets),
      by.chance(64) ? std::numeric_limits<std::size_t>::max() : polygons, by.chance(2) ? &heights : nullptr));
}

void add_round_bodies(Program& by) {
  bch_capsule capsules[4];
  bch_disc discs[most];
  for (bch_capsule& one : capsules)
    one = {{by.number<float>(), by.number<float>()},
           {by.number<float>(), by.number<float>()},
           by.number<float>()};
  for (bch_disc& one : discs) one = {by.number<float>(), by.number<float>(), by.number<float>()};
  const bch_heights heights{by.number<float>(), by.number<float>()};
  const bch_heights* const high = by.chance(2) ? &heights : nullptr;
  const float tolerance = by.chance(8) ? by.number<float>() : 0.0625f;
  Program::succeeded(bch_shape_set_builder_add_capsules(by.handle<bch_shape_set_builder>(),
                                                        by.array(capsules), by.count(4), tolerance, high));
  Program::succeeded(bch_shape_set_builder_add_discs(by.handle<bch_shape_set_builder>(), by.array(discs),
                                                     by.count(most), high));
  Program::succeeded(
      bch_shape_set_builder_add_cylinder(by.handle<bch_shape_set_builder>(), by.number<float>(), high));
}

void add_mesh(Program& by) {
  bch_vec3 positions[most];
  std::uint32_t corners[3 * most];
  for (bch_vec3& one : positions) one = {by.number<float>(), by.number<float>(), by.number<float>()};
  for (std::uint32_t& one : corners) one = by.index(8);
  Program::succeeded(bch_shape_set_builder_add_mesh(by.handle<bch_shape_set_builder>(), by.array(positions),
                                                    by.count(most), by.array(corners), by.count(most)));
}

namespace {

bch_pose pose_of(Program& by) {
  return {by.chance(2) ? BCH_REST_POSE : by.index(20), by.number<float>()};
}

void choose_slices(Program& by) {
  const bch_character* const characters[] = {by.handle<bch_character>(), by.handle<bch_character>()};
  const bch_pose poses[] = {{BCH_REST_POSE, 0}, pose_of(by)};
  const float planes[] = {0, 0.25f, by.number<float>()};
  Answers<float> slices;
  std::size_t count = 0;
  slices.check(bch_best_slices(by.array(characters), by.array(poses), by.count(2), by.array(planes),
                               by.count(3), by.index(4), by.array(slices.values), by.array(&count)));
}

/// Cancels after so many calls. An older version has no user.
std::int32_t hear(void* user, std::uint64_t, std::uint64_t) {
  return user != nullptr && (*static_cast<std::uint8_t*>(user))-- == 0;
}

}  // namespace

void pose(Program& by) {
  Plan plan;
  const bch_plan* const of = plan.of(by);
  by.make<bch_pose_shaper>([&](bch_pose_shaper** to) { return bch_pose_shaper_create(man(by), of, to); });
  Program::succeeded(bch_pose_shaper_make(by.handle<bch_pose_shaper>(), pose_of(by), by.bytes.below(2)));
  Program::succeeded(
      bch_shape_set_builder_add_shape(by.handle<bch_shape_set_builder>(), by.handle<bch_pose_shaper>()));
  Program::succeeded(bch_dynamic_shape_set_replace(by.handle<bch_dynamic_shape_set>(), by.index(4),
                                                   by.handle<bch_pose_shaper>()));
  if (by.chance(4)) choose_slices(by);
  const bch_pose poses[] = {pose_of(by), pose_of(by)};
  const std::uint32_t shapes[] = {by.index(4), by.index(4)};
  std::uint8_t calls_left = by.bytes.take<std::uint8_t>();
  Versioned<bch_work> work{};
  work.known = {0, 1, by.chance(2) ? hear : nullptr, &calls_left};
  const bch_work* const how = by.sized(work);
  Program::succeeded(bch_shape_set_builder_add_poses(by.handle<bch_shape_set_builder>(), man(by),
                                                     by.array(poses), by.count(2), how));
  Program::succeeded(bch_dynamic_shape_set_replace_poses(by.handle<bch_dynamic_shape_set>(), man(by),
                                                         by.array(shapes), by.array(poses), by.count(2),
                                                         by.chance(8) ? by.number<float>() : 0.25f, how));
}

/// A small character: a mesh, up to two joints, one clip.
void make_character(Program& by) {
  bch_vec3 vertices[most];
  std::uint32_t corners[3 * most], bones[2] = {0, by.index(2)};
  for (bch_vec3& one : vertices) one = {by.number<float>(), by.number<float>(), by.number<float>()};
  for (std::uint32_t& one : corners) one = by.index(4);
  const std::int32_t parents[] = {-1, by.chance(16) ? by.bytes.take<std::int32_t>() : 0};
  std::uint64_t begin[most + 1];
  bch_influence influences[most];
  for (std::uint32_t v = 0; v <= most; ++v) begin[v] = by.chance(64) ? by.bytes.below(most) : v;
  for (bch_influence& one : influences) one = {by.index(2), by.chance(32) ? by.number<float>() : 1};
  float times[2] = {0, by.number<float>()}, values[8] = {0, 0, 0, 1, 0, 0, 0, 1}, tangents[16]{};
  tangents[by.bytes.below(16)] = by.number<float>();
  const auto interpolation = static_cast<std::int32_t>(by.index(3));
  const auto curve = [&] {
    return bch_curve{by.array(times), by.array(values), by.array(tangents), by.count(2), interpolation};
  };
  const bch_channel channel{by.index(2), by.chance(2) ? curve() : bch_curve{},
                            by.chance(2) ? curve() : bch_curve{}, by.chance(2) ? curve() : bch_curve{}};
  const bch_clip clip{by.chance(2) ? "walk" : nullptr, by.number<float>(), by.array(&channel), by.count(1)};
  Versioned<bch_character_arrays> arrays{};
  arrays.known = BCH_CHARACTER_ARRAYS_INIT;
  arrays.known.vertices = by.array(vertices), arrays.known.vertex_count = by.chance(16) ? by.count(most) : 4;
  arrays.known.triangles = by.array(corners), arrays.known.triangle_count = by.count(most);
  if (by.chance(2)) {
    arrays.known.parents = by.array(parents), arrays.known.joint_count = by.count(2);
    arrays.known.bone_joints = by.array(bones), arrays.known.bone_count = by.count(2);
    arrays.known.root_joint = static_cast<std::int32_t>(by.index(3)) - 1;
  }
  if (by.chance(2)) arrays.known.influence_offsets = begin, arrays.known.influences = by.array(influences);
  if (by.chance(2)) arrays.known.clips = by.array(&clip), arrays.known.clip_count = by.count(1);
  const bch_character_arrays* const of = by.sized(arrays);
  by.make<bch_character>(
      [&](bch_character** to) { return bch_character_create(by.array(of), by.array(to)); });
}

void add_sources(Program& by) {
  const bch_character* const characters[] = {by.handle<bch_character>(), by.handle<bch_character>()};
  bch_shape_source sources[4];
  for (bch_shape_source& one : sources)
    one = {by.index(2), {by.chance(2) ? BCH_REST_POSE : by.index(2), by.number<float>()}, 0};
  sources[0].whole = by.bytes.below(2);
  Versioned<bch_work> work{};
  work.known = {0, 1, nullptr, nullptr};
  Program::succeeded(bch_shape_set_builder_add_sources(by.handle<bch_shape_set_builder>(),
                                                       by.array(characters), by.count(2), by.array(sources),
                                                       by.count(4), by.sized(work)));
}

void plan_scene(Program& by) {
  std::uint32_t character[most], depth[most];
  bch_pose poses[most];
  double distance[most];
  float slices[] = {0, by.number<float>()};
  for (std::uint32_t i = 0; i < most; ++i) {
    character[i] = by.index(2), depth[i] = by.chance(2) ? BCH_ALL_DEPTHS : by.index(4);
    poses[i] = {BCH_REST_POSE, by.number<float>()}, distance[i] = std::abs(by.number<double>());
  }
  Versioned<bch_scene_agents> agents{};
  agents.known = {0,
                  by.chance(2) ? character : nullptr,
                  by.array(poses),
                  by.chance(2) ? distance : nullptr,
                  by.chance(2) ? depth : nullptr,
                  by.count(most)};
  Versioned<bch_scene_use> use{};
  use.known = BCH_SCENE_USE_INIT;
  use.known.solid = by.bytes.below(2), use.known.leaves = static_cast<std::int32_t>(by.index(2));
  use.known.slices = by.array(slices), use.known.slice_count = by.count(2);
  if (by.chance(4)) use.known.whole_from = by.number<double>(), use.known.pose_step = by.number<float>();
  const bch_scene_agents* const of = by.sized(agents);
  const bch_scene_use* const how = by.sized(use);
  by.make<bch_scene_plan>(
      [&](bch_scene_plan** to) { return bch_scene_plan_create(of, by.array(how), by.array(to)); });
}

void read_plan(Program& by) {
  const bch_scene_plan* const plan = by.handle<bch_scene_plan>();
  Versioned<bch_plan> set{};
  set.known = BCH_PLAN_INIT;
  if (Program::succeeded(bch_scene_plan_get_set(plan, by.array(by.sized(set)))) && by.chance(2))
    by.make<bch_shape_set_builder>(
        [&](bch_shape_set_builder** to) { return bch_shape_set_builder_create(&set.known, to); });
  const bch_shape_source* shapes = nullptr;
  std::size_t count = 0;
  if (Program::succeeded(bch_scene_plan_get_shapes(plan, by.array(&shapes), by.array(&count))))
    Program::succeeded(bch_shape_set_builder_add_sources(by.handle<bch_shape_set_builder>(), nullptr, 0,
                                                         shapes, count, nullptr));
  const std::uint32_t* shape = nullptr;
  const std::uint8_t* level = nullptr;
  if (Program::succeeded(
          bch_scene_plan_get_agents(plan, by.array(&shape), by.array(&level), by.array(&count))))
    for (std::size_t i = 0; i < count; ++i)
      require(shape[i] < most && level[i] < most, "few shapes and levels");
}

void make_dynamic(Program& by) {
  const bch_shape_set* const start = by.handle<bch_shape_set>();
  by.make<bch_dynamic_shape_set>(
      [&](bch_dynamic_shape_set** to) { return bch_dynamic_shape_set_create(start, to); });
}

void lend(Program& by) {
  const bch_shape_set* lent = nullptr;
  if (Program::succeeded(
          bch_dynamic_shape_set_get_shapes(by.handle<bch_dynamic_shape_set>(), by.array(&lent))))
    by.keep(const_cast<bch_shape_set*>(lent));
}

}  // namespace bch::fuzz
