// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/fuzz/c_api_steps.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

// Questions about pairs, crowds, obstacles and scenes.

namespace bch::fuzz {

namespace {
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

}  // namespace

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

namespace {

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

}  // namespace

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
  const bool has_heights = by.chance(2);
  const auto bottom = by.number<double>(), top = by.number<double>();
  by.make<bch_obstacles>([&](bch_obstacles** to) {
    return has_heights ? bch_obstacles_from_wkt_at(or_none, walkable, bottom, top, to)
                       : bch_obstacles_from_wkt(or_none, walkable, to);
  });
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

}  // namespace bch::fuzz
