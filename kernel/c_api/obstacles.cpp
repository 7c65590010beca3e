// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/c_api/obstacles.hpp"

#include "kernel/c_api/calls.hpp"

using namespace bch;
using namespace bch::c_api;

namespace {

ObstacleArrays arrays_of(const bch_obstacle_arrays* given) {
  const bch_obstacle_arrays arrays =
      sized(&required(given, "arrays"), bch_obstacle_arrays BCH_OBSTACLE_ARRAYS_INIT, "arrays");
  ObstacleArrays all;
  static constexpr std::uint64_t none = 0;
  all.polyline_offsets = {&none, 1};
  if (arrays.polyline_count == 0) return all;
  all.polyline_offsets =
      offsets_of(arrays.polyline_offsets, arrays.polyline_count, "arrays->polyline_offsets");
  const std::size_t points = all.polyline_offsets.back();
  all.x = array_of(arrays.x, points, "arrays->x");
  all.y = array_of(arrays.y, points, "arrays->y");
  std::size_t obstacles = arrays.polyline_count;
  if (arrays.obstacle_offsets != nullptr) {
    obstacles = arrays.obstacle_count;
    all.obstacle_offsets = offsets_of(arrays.obstacle_offsets, obstacles, "arrays->obstacle_offsets");
  }
  if (arrays.is_area != nullptr) all.is_area = array_of(arrays.is_area, obstacles, "arrays->is_area");
  if (arrays.bottom != nullptr) all.bottom = array_of(arrays.bottom, obstacles, "arrays->bottom");
  if (arrays.top != nullptr) all.top = array_of(arrays.top, obstacles, "arrays->top");
  return all;
}

/// What a query about obstacles is asked.
template <class Handle>
struct ObstacleCallOn : CallOn<Handle> {
  ObstacleCallOn(const Handle* set, const bch_agents* of, const bch_obstacles* given,
                 const bch_query_options* wanted)
      : CallOn<Handle>(set, of, wanted), obstacles(object_of(given, "obstacles").set) {}

  /// Asks for answers about all agents, which come whole or not at all.
  template <class To, class RunQuery>
  void run_query(To to, RunQuery query_into) const {
    all_or_none(to, [&](const auto& answers) { this->run([&] { query_into(answers); }); });
  }

  const ObstacleSet& obstacles;
};
using ObstacleCall = ObstacleCallOn<bch_shape_set>;

template <class Handle>
bch_status free_of_all(const Handle* set, const bch_agents* agents, const bch_pair* neighbours,
                       std::size_t count, const bch_obstacles* obstacles, std::uint32_t directions,
                       const bch_query_options* options, bch_penetration_depth* depths, bch_touch* touches) {
  return guarded([&] {
    const PairCallOn<Handle> call(set, agents, neighbours, count, options);
    const ObstacleSet* const walls = obstacles == nullptr ? nullptr : &object_of(obstacles, "obstacles").set;
    const auto to = penetrations(depths, call.agents.size());
    const auto ends = touches_of(touches, call.agents.size());
    call.run([&] {
      nearest_free(call.shapes, call.agents, call.pairs, walls, directions, to, call.options, ends);
    });
  });
}

}  // namespace

bch_status bch_obstacles_create(const bch_obstacle_arrays* arrays, bch_obstacles** obstacles) {
  return guarded([&] {
    required(obstacles, "obstacles");
    hand_out(std::make_unique<bch_obstacles>(bch_obstacles{ObstacleSet(arrays_of(arrays))}), obstacles);
  });
}

bch_status bch_obstacles_from_wkt(const char* text, int32_t walkable, double bottom, double top,
                                  bch_obstacles** obstacles) {
  return guarded([&] {
    required(obstacles, "obstacles");
    const Polygons polygons = walkable != 0 ? Polygons::walkable : Polygons::solid;
    hand_out(std::make_unique<bch_obstacles>(
                 bch_obstacles{obstacles_from_wkt(&required(text, "text"), polygons, bottom, top)}),
             obstacles);
  });
}

bch_status bch_obstacles_get_counts(const bch_obstacles* obstacles, uint32_t* obstacle_count,
                                    uint32_t* segment_count) {
  return guarded([&] {
    const ObstacleSet& set = object_of(obstacles, "obstacles").set;
    if (obstacle_count != nullptr) *obstacle_count = set.obstacle_count();
    if (segment_count != nullptr) *segment_count = set.segment_count();
  });
}

bch_status bch_obstacles_get_owner(const bch_obstacles* obstacles, uint32_t segment, uint32_t* obstacle) {
  return guarded([&] {
    const ObstacleSet& set = object_of(obstacles, "obstacles").set;
    check_index(segment, set.segment_count(), "segment");
    required(obstacle, "obstacle") = set.obstacle_of(segment);
  });
}

bch_status bch_obstacles_free(bch_obstacles* obstacles) {
  return free_object(obstacles, "obstacles");
}

bch_status bch_obstacles_collide(const bch_shape_set* set, const bch_agents* agents,
                                 const bch_obstacles* obstacles, const bch_query_options* options,
                                 uint8_t* hits) {
  return guarded([&] {
    const ObstacleCall call(set, agents, obstacles, options);
    const auto to = array_of(hits, call.agents.size(), "hits");
    call.run_query(to,
                   [&](auto into) { collide(call.shapes, call.agents, call.obstacles, into, call.options); });
  });
}

bch_status bch_obstacles_within(const bch_shape_set* set, const bch_agents* agents,
                                const bch_obstacles* obstacles, const double* distances,
                                size_t distance_count, const bch_query_options* options, uint8_t* answers) {
  return guarded([&] {
    const ObstacleCall call(set, agents, obstacles, options);
    const auto near = array_of(distances, distance_count, "distances");
    const auto to = array_of(answers, call.agents.size(), "answers");
    call.run_query(to, [&](auto into) {
      within(call.shapes, call.agents, call.obstacles, near, into, call.options.distance_leaves,
             call.options.implementation);
    });
  });
}

bch_status bch_obstacles_clearance(const bch_shape_set* set, const bch_agents* agents,
                                   const bch_obstacles* obstacles, const bch_query_options* options,
                                   const bch_clearance_out* out) {
  return guarded([&] {
    const ObstacleCall call(set, agents, obstacles, options);
    const ClearanceAnswers to = clearance_answers(out, call.agents.size());
    call.run_query(to, [&](const auto& into) {
      clearance(call.shapes, call.agents, call.obstacles, into, call.options);
    });
  });
}

bch_status bch_obstacles_penetration(const bch_shape_set* set, const bch_agents* agents,
                                     const bch_obstacles* obstacles, const bch_query_options* options,
                                     bch_penetration_depth* depths) {
  return guarded([&] {
    const ObstacleCall call(set, agents, obstacles, options);
    const auto to = penetrations(depths, call.agents.size());
    call.run_query(
        to, [&](auto into) { penetration(call.shapes, call.agents, call.obstacles, into, call.options); });
  });
}

bch_status bch_obstacles_time_of_impact(const bch_shape_set* set, const bch_agents* agents,
                                        const bch_obstacles* obstacles, const double* x, const double* y,
                                        const bch_query_options* options, float* times) {
  return guarded([&] {
    const ObstacleCall call(set, agents, obstacles, options);
    const std::size_t count = call.agents.size();
    const Displacements displacements{array_of(x, count, "x"), array_of(y, count, "y")};
    const auto to = array_of(times, count, "times");
    call.run_query(to, [&](auto into) {
      time_of_impact(call.shapes, call.agents, displacements, call.obstacles, into, call.options);
    });
  });
}

bch_status bch_obstacles_collide_bodies(const bch_body_set* set, const bch_agents* agents,
                                        const bch_obstacles* obstacles, const bch_query_options* options,
                                        uint8_t* hits) {
  return guarded([&] {
    const ObstacleCallOn<bch_body_set> call(set, agents, obstacles, options);
    const auto to = array_of(hits, call.agents.size(), "hits");
    call.run_query(to,
                   [&](auto into) { collide(call.shapes, call.agents, call.obstacles, into, call.options); });
  });
}

bch_status bch_obstacles_within_bodies(const bch_body_set* set, const bch_agents* agents,
                                       const bch_obstacles* obstacles, const double* distances,
                                       size_t distance_count, const bch_query_options* options,
                                       uint8_t* answers) {
  return guarded([&] {
    const ObstacleCallOn<bch_body_set> call(set, agents, obstacles, options);
    const auto near = array_of(distances, distance_count, "distances");
    const auto to = array_of(answers, call.agents.size(), "answers");
    call.run_query(
        to, [&](auto into) { within(call.shapes, call.agents, call.obstacles, near, into, call.options); });
  });
}

bch_status bch_obstacles_clearance_bodies(const bch_body_set* set, const bch_agents* agents,
                                          const bch_obstacles* obstacles, const bch_query_options* options,
                                          const bch_body_clearance_out* out) {
  return guarded([&] {
    const ObstacleCallOn<bch_body_set> call(set, agents, obstacles, options);
    const BodyClearanceAnswers to = clearance_answers(out, call.agents.size());
    call.run_query(to, [&](const auto& into) {
      clearance(call.shapes, call.agents, call.obstacles, into, call.options);
    });
  });
}

bch_status bch_nearest_free_of_all(const bch_shape_set* set, const bch_agents* agents,
                                   const bch_pair* neighbours, size_t count, const bch_obstacles* obstacles,
                                   uint32_t directions, const bch_query_options* options,
                                   bch_penetration_depth* depths, bch_touch* touches) {
  return free_of_all(set, agents, neighbours, count, obstacles, directions, options, depths, touches);
}

bch_status bch_nearest_free_of_all_bodies(const bch_body_set* set, const bch_agents* agents,
                                          const bch_pair* neighbours, size_t count,
                                          const bch_obstacles* obstacles, uint32_t directions,
                                          const bch_query_options* options, bch_penetration_depth* depths,
                                          bch_touch* touches) {
  return free_of_all(set, agents, neighbours, count, obstacles, directions, options, depths, touches);
}
