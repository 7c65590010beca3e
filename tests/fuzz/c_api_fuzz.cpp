// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

// Calls of the C interface in any order with any arguments: handles that live, were freed or never were, structs of other
// versions, counts, offsets and numbers that make no sense. Each succeeds, or says why not and has written nothing. Arrays
// are as long as their counts say.

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/fuzz/c_api_program.hpp"

namespace bch::fuzz {
namespace {

constexpr std::uint32_t most = 16;      // agents, points, parts
constexpr std::uint8_t untouched = 77;  // in the outputs

/// A crowd and pairs of it.
struct Scene {
  std::uint32_t shape[most]{};
  double x[most]{}, y[most]{}, heading[most]{}, z[most]{}, way[most]{};
  std::uint8_t level[most]{};
  bch_pair pairs[most]{};
  Versioned<bch_agents> agents{};
  std::size_t pair_count = 0;
  const bch_pair* pairs_or_none = nullptr;
  bch_agents* of = nullptr;

  explicit Scene(Program& by) {
    const std::size_t count = by.count(most);
    for (std::uint32_t i = 0; i < most && i < count; ++i) {
      shape[i] = by.index(3), level[i] = static_cast<std::uint8_t>(by.index(3));
      x[i] = by.number<double>(), y[i] = by.number<double>(), heading[i] = by.number<double>();
      z[i] = by.number<double>();
    }
    agents.known = {0,
                    by.array(shape),
                    by.array(x),
                    by.array(y),
                    by.array(heading),
                    by.chance(2) ? level : nullptr,
                    by.chance(4) ? z : nullptr,
                    count};
    of = by.sized(agents);
    pair_count = by.count(most), pairs_or_none = by.array(pairs);
    const auto agent = [&] {
      return by.index(static_cast<std::uint32_t>(std::clamp<std::size_t>(count, 1, most)));
    };
    for (std::uint32_t i = 0; i < most && i < pair_count; ++i)
      pairs[i] = {agent(), agent()}, way[i] = by.number<double>();
  }
};

/// An array of answers, before and after a call.
template <class Value>
class Answers {
 public:
  Answers() { std::memset(values, untouched, sizeof values); }
  Value values[most];

  /// Ends the program where a call that failed has written.
  void check(bch_status status) const {
    if (Program::succeeded(status)) return;
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(values);
    require(std::all_of(bytes, bytes + sizeof values, [](std::uint8_t byte) { return byte == untouched; }),
            "nothing is written on an error");
  }
};

/// The outputs of clearances.
struct ClearanceOut {
  Answers<float> distance;
  Answers<bch_vec2> direction;
  Answers<bch_disc_pair> discs;
  Answers<bch_nearest_points> points;
  Versioned<bch_clearance_out> out{};

  bch_clearance_out* of(Program& by) {
    out.known = {0, by.array(distance.values), by.chance(2) ? direction.values : nullptr,
                 by.chance(2) ? discs.values : nullptr, by.chance(2) ? points.values : nullptr};
    return by.sized(out);
  }
  void check(bch_status status) const {
    distance.check(status), direction.check(status), discs.check(status), points.check(status);
  }
};

/// The built-in man, who costs more than all else of an input: one for all, whom nobody frees.
bch_character* man(Program& by) {
  static bch_character* const one = [] {
    bch_character* made = nullptr;
    require(bch_character_default(BCH_MALE, &made) == BCH_OK, "there is a man");
    return made;
  }();
  return by.chance(16) ? by.handle<bch_character>() : one;
}

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

// Queries of pairs.

void ask_pairs(Program& by) {
  const Scene scene(by);
  const bch_shape_set* const set = by.handle<bch_shape_set>();
  Answers<std::uint8_t> hits, near;
  Answers<float> times;
  Answers<bch_penetration_depth> best, along;
  bch_vec2 directions[most];
  for (bch_vec2& one : directions) one = {by.number<float>(), by.number<float>()};
  const std::uint32_t kinds = by.bytes.take<std::uint8_t>(), n_directions = by.chance(8) ? by.index(300) : 4;
  const std::size_t count = scene.pair_count;
  Program::succeeded(bch_validate_agents(set, scene.of));
  const auto ask = [&](std::uint32_t kind, auto& to, auto call) {
    if (kinds >> kind & 1) to.check(call(scene.of, scene.pairs_or_none, by.options(), by.array(to.values)));
  };
  ask(0, hits, [&](auto of, auto pairs, auto options, auto to) {
    return bch_collide(set, of, pairs, count, options, to);
  });
  const std::size_t distances = by.chance(4) ? by.count(most) : by.chance(2) ? 1 : count;
  ask(1, near, [&](auto of, auto pairs, auto options, auto to) {
    return bch_within(set, of, pairs, count, scene.way, distances <= most ? distances : SIZE_MAX, options,
                      to);
  });
  ask(2, best, [&](auto of, auto pairs, auto options, auto to) {
    return bch_penetration(set, of, pairs, count, n_directions, options, to);
  });
  ask(3, along, [&](auto of, auto pairs, auto options, auto to) {
    return bch_penetration_along(set, of, pairs, count, directions, options, to);
  });
  ask(4, times, [&](auto of, auto pairs, auto options, auto to) {
    return bch_time_of_impact(set, of, pairs, count, scene.way, by.array(scene.way), options, to);
  });
  ClearanceOut out;
  if (kinds >> 5 & 1)
    out.check(bch_clearance(set, scene.of, scene.pairs_or_none, count, by.options(), by.array(out.of(by))));
}

// Queries of crowds.

template <class Rows>
void read_rows(const Rows& rows) {
  std::uint64_t last = 0;
  for (std::size_t i = 0; i <= rows.rows; ++i) {
    require(rows.offsets[i] >= last, "rows follow each other");
    last = rows.offsets[i];
  }
  std::vector<std::uint8_t> copy(last * sizeof *rows.values);
  if (last > 0) std::memcpy(copy.data(), rows.values, copy.size());
}

void find_pairs(Program& by) {
  const Scene scene(by);
  const bch_pair* pairs = nullptr;
  std::size_t count = untouched;
  if (!Program::succeeded(bch_broad_phase_find(by.handle<bch_broad_phase>(), by.handle<bch_shape_set>(),
                                               scene.of, by.chance(4) ? by.number<double>() : 0, by.options(),
                                               by.array(&pairs), by.array(&count))))
    return require(pairs == nullptr && count == untouched, "nothing is written on an error");
  for (std::size_t i = 0; i < count; ++i)
    require(pairs[i].first < pairs[i].second && pairs[i].second < most, "pairs are of agents");
}

void ask_crowd(Program& by) {
  const Scene scene(by);
  bch_index_rows rows{}, touched{};
  const bool walls = by.chance(2);
  if (Program::succeeded(
          bch_crowd_collider_collide_all(by.handle<bch_crowd_collider>(), by.handle<bch_shape_set>(),
                                         scene.of, walls ? by.handle<bch_obstacles>() : nullptr, by.options(),
                                         by.array(&rows), walls || by.chance(32) ? &touched : nullptr))) {
    read_rows(rows);
    if (touched.offsets != nullptr) read_rows(touched);
  } else {
    require(rows.offsets == nullptr && touched.offsets == nullptr, "nothing is written on an error");
  }
  bch_contact_rows contacts{};
  const bool all = by.chance(2);
  bch_contact_finder* const finder = by.handle<bch_contact_finder>();
  const bch_shape_set* const set = by.handle<bch_shape_set>();
  if (Program::succeeded(
          all ? bch_contact_finder_find_all(finder, set, scene.of, by.options(), by.array(&contacts))
              : bch_contact_finder_find(finder, set, scene.of, scene.pairs_or_none, scene.pair_count,
                                        by.options(), by.array(&contacts))))
    read_rows(contacts);
  else
    require(contacts.offsets == nullptr, "nothing is written on an error");
}

void make_crowd_objects(Program& by) {
  by.make<bch_broad_phase>(bch_broad_phase_create);
  by.make<bch_crowd_collider>(bch_crowd_collider_create);
  by.make<bch_contact_finder>(bch_contact_finder_create);
}

// Obstacles and scenes.

void make_obstacles(Program& by) {
  double x[most], y[most], bottom[most], top[most];
  std::uint64_t paths[most + 1], obstacles[most + 1];
  std::uint8_t areas[most];
  for (std::uint32_t i = 0; i < most; ++i)
    x[i] = by.number<double>(), y[i] = by.number<double>(), areas[i] = by.bytes.take<std::uint8_t>(),
    bottom[i] = by.number<double>(), top[i] = by.number<double>();
  const std::uint32_t path_count = by.bytes.below(6), obstacle_count = by.bytes.below(4);
  by.fill_offsets(paths, path_count, most);
  by.fill_offsets(obstacles, obstacle_count, path_count);
  const bool own_offsets = by.chance(2);
  Versioned<bch_obstacle_arrays> arrays{};
  arrays.known = {0,
                  by.array(x),
                  by.array(y),
                  by.array(paths),
                  by.chance(64) ? SIZE_MAX : path_count,
                  own_offsets ? obstacles : nullptr,
                  by.chance(64) ? SIZE_MAX : obstacle_count,
                  by.chance(2) ? areas : nullptr,
                  by.chance(4) ? bottom : nullptr,
                  by.chance(4) ? top : nullptr};
  const bch_obstacle_arrays* const of = by.array(by.sized(arrays));
  by.make<bch_obstacles>([&](bch_obstacles** to) { return bch_obstacles_create(of, to); });
}

void read_obstacles(Program& by) {
  const std::string text = by.bytes.text();
  const char* const or_none = by.chance(64) ? nullptr : text.c_str();
  const std::int32_t walkable = static_cast<int>(by.bytes.below(2));
  by.make<bch_obstacles>([&](bch_obstacles** to) { return bch_obstacles_from_wkt(or_none, walkable, to); });
}

void ask_obstacles(Program& by) {
  const Scene scene(by);
  const bch_shape_set* const set = by.handle<bch_shape_set>();
  const bch_obstacles* const walls = by.handle<bch_obstacles>();
  std::uint32_t count = 0, segments = 0, owner = 0;
  Program::succeeded(bch_obstacles_get_counts(walls, by.array(&count), by.array(&segments)));
  if (Program::succeeded(bch_obstacles_get_owner(walls, by.index(8), &owner)))
    require(owner < std::max(count, 1u) || count == 0, "obstacles have their segments");
  Answers<std::uint8_t> hits, near;
  Answers<float> times;
  Answers<bch_penetration_depth> depths;
  ClearanceOut out;
  const std::uint32_t kinds = by.bytes.take<std::uint8_t>();
  if (kinds & 1) hits.check(bch_obstacles_collide(set, scene.of, walls, by.options(), by.array(hits.values)));
  if (kinds & 2)
    near.check(bch_obstacles_within(set, scene.of, walls, by.array(scene.way), by.count(most), by.options(),
                                    by.array(near.values)));
  if (kinds & 4)
    depths.check(bch_obstacles_penetration(set, scene.of, walls, by.options(), by.array(depths.values)));
  if (kinds & 8)
    times.check(bch_obstacles_time_of_impact(set, scene.of, walls, by.array(scene.way), scene.way,
                                             by.options(), by.array(times.values)));
  if (kinds & 16)
    out.check(bch_obstacles_clearance(set, scene.of, walls, by.options(), by.array(out.of(by))));
}

void ask_scene(Program& by) {
  const Scene scene(by);
  Answers<double> densities;
  densities.check(bch_local_densities(by.array(scene.x), scene.y, by.count(most), by.number<double>(),
                                      by.array(densities.values)));
  std::uint32_t depth = 0;
  Program::succeeded(bch_depth_at_density(by.number<double>(), by.array(&depth)));
  Answers<float> slices;
  slices.check(bch_standing_slices(by.index(9), by.array(slices.values)));
  require(bch_status_name(by.bytes.take<std::int32_t>()) != nullptr, "every number has a name");
  bch_implementation_supported(by.bytes.take<std::uint32_t>());
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
