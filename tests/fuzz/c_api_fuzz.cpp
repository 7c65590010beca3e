// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Calls of the C interface in any order with any arguments: handles that live, were freed or never were, structs of other
// versions, counts, offsets and numbers that make no sense. Each succeeds, or says why not and has written nothing.

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/fuzz/c_api_values.hpp"

namespace bch::fuzz {
namespace {

/// A file that only this process has.
const std::filesystem::path& file() {
  static const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("bch_fuzz_" + std::to_string(getpid()) + ".bch");
  return path;
}

/// Loads a set that was saved, as it is or with damage, or any bytes.
void load(Caller& by) {
  const std::string path = file().string();
  std::string bytes = by.bytes.text();
  if (by.chance(2) && by.finish(bch_shape_set_save(by.handle<bch_shape_set>(), path.c_str()))) {
    std::ifstream stream(path, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(stream), {});
    if (by.chance(2)) bytes.at(by.bytes.take<std::uint16_t>() % bytes.size()) ^= 1;
    if (by.chance(4)) bytes.resize(by.bytes.take<std::uint16_t>() % bytes.size());
  }
  std::filesystem::remove(path);  // a set that is mapped keeps the file that it has
  std::ofstream(path, std::ios::binary) << bytes;
  bch_shape_set** made = nullptr;
  by.draw(made);
  by.finish(bch_shape_set_load(
      by.chance(32) ? nullptr : path.c_str(),
      by.chance(16) ? by.bytes.take<std::int32_t>() : static_cast<int>(by.bytes.below(2)), made));
  std::filesystem::remove(path);
}

// Functions whose arguments are not any that their types have: what has to be small, and what takes long where it is none of these.

bch_status no_character(std::int32_t which, bch_character** character) {
  return bch_character_default(which < 2 ? -1 - which : which + 1, character);
}
bch_status sample_poses(const bch_character* character, std::uint8_t count, bch_pose* poses) {
  return bch_character_sample_poses(character, count % most, poses);
}
bch_status even_directions(const bch_shape_set* set, const bch_agents* agents, const bch_pair* pairs,
                           std::size_t count, std::uint8_t directions, const bch_query_options* options,
                           bch_penetration_depth* depths, bch_touch* touches) {
  const bch_status status = bch_penetration(set, agents, pairs, count, 2 * directions, options, depths);
  return status != BCH_OK
             ? status
             : bch_nearest_free(set, agents, pairs, count, 2 * directions, options, depths, touches);
}
bch_status status_name(std::int32_t status, std::uint32_t implementation) {
  require(bch_status_name(status) != nullptr, "every number has a name");
  bch_implementation_supported(implementation);
  return BCH_OK;
}

template <auto call>
void run_query(Caller& by) {
  by.run_query(call);
}
template <auto... calls>
constexpr std::array<void (*)(Caller&), sizeof...(calls) + 1> all = {load, run_query<calls>...};
constexpr auto& steps = all<
    no_character, bch_character_create, bch_character_get_info, bch_character_get_clip, sample_poses,
    bch_shape_set_get_info, bch_shape_set_get_origin, bch_shape_set_get_radius, bch_shape_set_get_discs,
    bch_shape_set_get_outline, bch_shape_set_verify, bch_shape_builder_create, bch_shape_builder_make,
    bch_shape_builder_get_outline, bch_shape_set_builder_create, bch_shape_set_builder_add_poses,
    bch_shape_set_builder_add_pose_ids, bch_shape_set_builder_add_shape, bch_shape_set_builder_add_polygons,
    bch_shape_set_builder_add_capsules, bch_shape_set_builder_add_discs, bch_shape_set_builder_add_cylinder,
    bch_shape_set_builder_add_mesh, bch_shape_set_builder_finish, bch_dynamic_shape_set_create,
    bch_dynamic_shape_set_get_shapes, bch_dynamic_shape_set_replace, bch_dynamic_shape_set_replace_poses,
    bch_validate_agents, bch_collide, bch_within, bch_clearance, bch_penetration, even_directions,
    bch_penetration_along, bch_time_of_impact, bch_crowd_create, bch_crowd_candidates, bch_crowd_collisions,
    bch_crowd_contacts, bch_crowd_contacts_of, bch_crowd_clearances, bch_crowd_penetrations,
    bch_crowd_by_agent, bch_crowd_obstacles, bch_obstacles_create, bch_obstacles_from_wkt,
    bch_obstacles_get_counts, bch_obstacles_get_owner, bch_obstacles_collide, bch_obstacles_within,
    bch_obstacles_clearance, bch_obstacles_penetration, bch_obstacles_time_of_impact,
    bch_animated_shape_create, bch_animated_shape_get_info, bch_animated_shape_get_discs,
    bch_shape_set_builder_add_animated_shape, bch_shape_set_add_clip, bch_shape_set_get_clip_count,
    bch_shape_set_get_clip, bch_local_densities, bch_depth_at_density, bch_scene_plan_create,
    bch_scene_plan_get_set, bch_scene_plan_get_shapes, bch_scene_plan_get_agents, status_name,
    bch_shape_set_free, bch_shape_builder_free, bch_shape_set_builder_free, bch_dynamic_shape_set_free,
    bch_crowd_free, bch_character_free, bch_scene_plan_free, bch_obstacles_free, bch_animated_shape_free,
    bch_body_set_create, bch_body_set_get_info, bch_body_set_get_spheres, bch_collide_bodies,
    bch_within_bodies, bch_clearance_bodies, bch_nearest_free_bodies, bch_nearest_free_bodies_touches,
    bch_penetration_bodies, bch_penetration_along_bodies, bch_time_of_impact_bodies,
    bch_crowd_body_candidates, bch_crowd_body_collisions, bch_crowd_body_contacts, bch_crowd_body_contacts_of,
    bch_crowd_body_clearances, bch_crowd_body_penetrations, bch_nearest_free_of_all,
    bch_nearest_free_of_all_bodies, bch_crowd_body_obstacles, bch_obstacles_collide_bodies,
    bch_obstacles_within_bodies, bch_obstacles_clearance_bodies, bch_body_set_free>;

/// Something of most kinds, so that calls have something to ask. The first byte says how the set is made.
void begin(Caller& by) {
  const std::uint8_t bits = by.bytes.take<std::uint8_t>();
  const std::uint32_t depths[] = {0, 2, BCH_ALL_DEPTHS}, triangles[] = {0, 1, 2, 1, 2, 3};
  bch_plan plan = BCH_PLAN_INIT;
  plan.threshold = 0.0625f, plan.heights = bits & 1, plan.depths = depths, plan.depth_count = 3;
  auto* const builder = by.begin_with<bch_shape_set_builder>(
      [&](bch_shape_set_builder** to) { return bch_shape_set_builder_create(&plan, to); });
  const bch_disc discs[] = {{0, 0, 0.25f}, {0, 0.25f, 0.25f}, {0, -0.25f, 0.25f}};
  bch_character_arrays arrays = BCH_CHARACTER_ARRAYS_INIT;
  const bch_vec3 corners[] = {{-0.5f, 0, 0}, {0.5f, 0.25f, 0}, {0, -0.5f, 1}, {0.25f, 0.25f, 1}};
  arrays.vertices = corners, arrays.vertex_count = 4, arrays.triangles = triangles, arrays.triangle_count = 2;
  bool fine = true;
  for (const std::size_t count : {2u, 2u, 1u})
    fine &= bch_shape_set_builder_add_mesh(builder, corners, 4, triangles, count) == BCH_OK;
  if (!(bits & 4)) fine &= bch_shape_set_builder_add_discs(builder, discs, 3, nullptr) == BCH_OK;
  fine &= bch_shape_set_builder_add_cylinder(builder, 0.25f, nullptr) == BCH_OK;
  require(fine, "bodies can be added");
  auto* const set = by.begin_with<bch_shape_set>(
      [&](bch_shape_set** to) { return bch_shape_set_builder_finish(builder, to); });
  by.begin_with<bch_dynamic_shape_set>(
      [&](bch_dynamic_shape_set** to) { return bch_dynamic_shape_set_create(set, to); });
  by.begin_with<bch_obstacles>([](bch_obstacles** to) {
    return bch_obstacles_from_wkt("LINESTRING(-1 0, 1 1) POLYGON((0 0, 2 0, 2 2, 0 0))", 0, -1, HUGE_VAL, to);
  });
  const bch_sphere spheres[] = {{0, 0, 0.5f, 0.5f}, {0, 0, 1.25f, 0.375f}, {0, 0.25f, 0.25f, 0.25f}};
  const std::uint64_t bodies[] = {0, 2, 3};
  by.begin_with<bch_body_set>([&](bch_body_set** to) { return bch_body_set_create(spheres, bodies, 2, to); });
  auto* const character =
      by.begin_with<bch_character>([&](bch_character** to) { return bch_character_create(&arrays, to); });
  auto* const shape_builder = by.begin_with<bch_shape_builder>(
      [&](bch_shape_builder** to) { return bch_shape_builder_create(character, &plan, to); });
  require(bch_shape_builder_make(shape_builder, {BCH_REST_POSE, 0}) == BCH_OK, "a shape is made");
  by.begin_with<bch_crowd>([](bch_crowd** to) { return bch_crowd_create(nullptr, to); });
}

}  // namespace
}  // namespace bch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bch::fuzz;
  Caller program(data, size);
  begin(program);
  for (int i = 0; i < 40 && !program.bytes.empty(); ++i)
    steps[program.bytes.take<std::uint8_t>() % std::size(steps)](program);
  return 0;
}
