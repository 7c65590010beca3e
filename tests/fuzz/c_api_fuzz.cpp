// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Calls of the C interface in any order with any arguments: handles that live, were freed or never were, structs of other
// versions, counts, offsets and numbers that make no sense. Each succeeds, or says why not and has written nothing. Arrays
// are as long as their counts say.

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/fuzz/c_api_steps.hpp"

namespace bch::fuzz {
namespace {

// Sets.

void ask_outline(Program& by) {
  bch_vec2 points[most];
  std::uint64_t offsets[most];
  Versioned<bch_outline> outline{};
  const std::size_t point_count = by.count(most), offset_count = by.count(most);
  outline.known = {0, by.array(points), point_count, by.array(offsets), offset_count, 0, 0};
  bch_outline* const to = by.array(by.sized(outline));
  const std::uint32_t slab = by.chance(4) ? BCH_ALL_SLABS : by.index(3);
  Program::succeeded(by.chance(8)
                         ? bch_pose_shaper_get_outline(by.handle<bch_pose_shaper>(), slab, to)
                         : bch_shape_set_get_outline(by.handle<bch_shape_set>(), by.index(3), slab, to));
}

void ask_set(Program& by) {
  Versioned<bch_shape_set_info> info{};
  bch_shape_origin origin{};
  bch_disc discs[most];
  std::uint32_t offsets[most];
  std::size_t count = untouched;
  float radius = 0;
  Program::succeeded(bch_shape_set_get_info(by.handle<bch_shape_set>(), by.array(by.sized(info))));
  if (Program::succeeded(
          bch_shape_set_get_origin(by.handle<bch_shape_set>(), by.index(3), by.array(&origin))) &&
      origin.character != nullptr)
    require(std::strlen(origin.character) < 1000, "names end");
  Program::succeeded(bch_shape_set_get_radius(by.handle<bch_shape_set>(), by.index(3), by.array(&radius)));
  if (!Program::succeeded(bch_shape_set_get_discs(by.handle<bch_shape_set>(), by.index(3), by.index(2),
                                                  by.array(discs), by.count(most), &count)))
    require(count == untouched, "nothing is written on an error");
  Program::succeeded(bch_shape_set_get_slab_offsets(by.handle<bch_shape_set>(), by.index(3), by.index(2),
                                                    by.array(offsets)));
  const auto hear_line = [](void* user, const char* line) {
    require(*line != '\0', "findings say something");
    ++*static_cast<std::size_t*>(user);
  };
  std::size_t heard = 0, findings = 0;
  if (Program::succeeded(bch_shape_set_verify(by.handle<bch_shape_set>(), by.bytes.below(4), hear_line,
                                              &heard, by.array(&findings))))
    require(heard == findings, "findings are told");
}

/// A file that only this process has.
const std::filesystem::path& file() {
  static const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("bch_fuzz_" + std::to_string(getpid()) + ".bch");
  return path;
}

/// Loads a set that was saved, as it is or with damage, or any bytes.
void load(Program& by) {
  const std::string path = file().string();
  std::string bytes = by.bytes.text();
  if (by.chance(2) && Program::succeeded(bch_shape_set_save(by.handle<bch_shape_set>(), path.c_str()))) {
    std::ifstream stream(path, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(stream), {});
    if (by.chance(2)) bytes.at(by.bytes.take<std::uint16_t>() % bytes.size()) ^= 1;
    if (by.chance(4)) bytes.resize(by.bytes.take<std::uint16_t>() % bytes.size());
  }
  std::filesystem::remove(path);  // a set that is mapped keeps the file that it has
  std::ofstream(path, std::ios::binary) << bytes;
  const std::int32_t access =
      by.chance(16) ? by.bytes.take<std::int32_t>() : static_cast<int>(by.bytes.below(2));
  by.make<bch_shape_set>([&](bch_shape_set** to) {
    return bch_shape_set_load(by.chance(32) ? nullptr : path.c_str(), access, to);
  });
  std::filesystem::remove(path);
}

/// Something of each kind, so that calls have something to ask. The first byte says how the set is made; with slices it has no bodies
/// without outlines.
void begin(Program& by) {
  const std::uint8_t bits = by.bytes.take<std::uint8_t>();
  const std::uint32_t depths[] = {0, 2, BCH_ALL_DEPTHS};
  const float slice = 0.5f;
  bch_plan plan = BCH_PLAN_INIT;
  plan.threshold = 0.0625f, plan.heights = bits & 1, plan.depths = depths, plan.depth_count = 3;
  if (bits & 2) plan.slices = &slice, plan.slice_count = 1;
  auto* const builder = by.begin_with<bch_shape_set_builder>(
      [&](bch_shape_set_builder** to) { return bch_shape_set_builder_create(&plan, to); });
  const bch_disc discs[] = {{0, 0, 0.25f}, {0, 0.25f, 0.25f}, {0, -0.25f, 0.25f}};
  const bch_vec3 corners[] = {{-0.5f, 0, 0}, {0.5f, 0.25f, 0}, {0, -0.5f, 1}, {0.25f, 0.25f, 1}};
  const std::uint32_t triangles[] = {0, 1, 2, 1, 2, 3};
  const bool fine = bch_shape_set_builder_add_mesh(builder, corners, 4, triangles, 2) == BCH_OK &&
                    (bits & 6 || bch_shape_set_builder_add_discs(builder, discs, 3, nullptr) == BCH_OK) &&
                    (bits & 2 || bch_shape_set_builder_add_cylinder(builder, 0.25f, nullptr) == BCH_OK);
  require(fine, "bodies can be added");
  auto* const set = by.begin_with<bch_shape_set>(
      [&](bch_shape_set** to) { return bch_shape_set_builder_finish(builder, to); });
  by.begin_with<bch_dynamic_shape_set>(
      [&](bch_dynamic_shape_set** to) { return bch_dynamic_shape_set_create(set, to); });
  by.begin_with<bch_obstacles>([](bch_obstacles** to) {
    return bch_obstacles_from_wkt("LINESTRING(-1 0, 1 1) POLYGON((0 0, 2 0, 2 2, 0 0))", 0, to);
  });
  by.begin_with<bch_broad_phase>(bch_broad_phase_create);
  by.begin_with<bch_crowd_collider>(bch_crowd_collider_create);
  by.begin_with<bch_contact_finder>(bch_contact_finder_create);
}

template <class Object, bch_status (*call)(Object*)>
void free_one(Program& by) {
  by.free(call);
}

using Step = void (*)(Program&);
constexpr Step steps[] = {make_builder,
                          add_polygons,
                          add_round_bodies,
                          add_mesh,
                          make_character,
                          add_sources,
                          plan_scene,
                          read_plan,
                          finish,
                          ask_pairs,
                          ask_pairs,
                          ask_crowd,
                          find_pairs,
                          ask_outline,
                          ask_set,
                          make_obstacles,
                          read_obstacles,
                          ask_obstacles,
                          make_crowd_objects,
                          make_dynamic,
                          lend,
                          load,
                          ask_scene,
                          ask_character,
                          free_one<bch_shape_set, bch_shape_set_free>,
                          free_one<bch_shape_set_builder, bch_shape_set_builder_free>,
                          free_one<bch_dynamic_shape_set, bch_dynamic_shape_set_free>,
                          free_one<bch_pose_shaper, bch_pose_shaper_free>,
                          free_one<bch_broad_phase, bch_broad_phase_free>,
                          free_one<bch_crowd_collider, bch_crowd_collider_free>,
                          free_one<bch_contact_finder, bch_contact_finder_free>,
                          free_one<bch_character, bch_character_free>,
                          free_one<bch_scene_plan, bch_scene_plan_free>,
                          free_one<bch_obstacles, bch_obstacles_free>};

}  // namespace
}  // namespace bch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bch::fuzz;
  Program program(data, size);
  begin(program);
  // Poses take a hundred times as long as all else.
  int poses_left = 1;
  for (int i = 0; i < 40 && !program.bytes.empty(); ++i) {
    const std::uint32_t step = program.bytes.take<std::uint8_t>();
    if (step >= 254) {
      if (poses_left-- > 0) pose(program);
    } else {
      steps[step % std::size(steps)](program);
    }
  }
  return 0;
}
