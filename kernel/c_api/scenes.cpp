// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>

#include <bch/collide.hpp>
#include <bch/scene_plan.hpp>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/objects.hpp"
#include "kernel/c_api/posing.hpp"

struct bch_scene_plan {
  bch::ScenePlan plan;
  std::vector<bch_shape_source> shapes;
};

namespace bch::c_api {
namespace {

/// The agents of a scene. Each has its number in place of a density, by which its depth is asked for.
std::vector<SceneAgent> scene_agents_of(const bch_scene_agents& given) {
  const auto poses = array_of(given.poses, given.count, "agents->poses");
  std::vector<SceneAgent> agents(given.count);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    agents[i].shows.at = {poses[i].clip, poses[i].seconds};
    if (given.character != nullptr) agents[i].shows.character = given.character[i];
    if (given.distance != nullptr) agents[i].distance = given.distance[i];
    agents[i].density = static_cast<double>(i);
  }
  return agents;
}

SceneUse use_of(const bch_scene_use& given) {
  const auto slices = array_of(given.slices, given.slice_count, "use->slices");
  return {.outlines = given.outlines != 0,
          .slices = {slices.begin(), slices.end()},
          .whole_from = given.whole_from,
          .heights = given.heights != 0,
          .pose_step = given.pose_step,
          .pairs_per_shape = given.pairs_per_shape};
}

std::unique_ptr<bch_scene_plan> plan_of(const bch_scene_agents& agents, const bch_scene_use& given) {
  SceneUse use = use_of(given);
  if (agents.depth != nullptr)
    use.density_depth = [&](double agent) { return agents.depth[static_cast<std::size_t>(agent)]; };
  auto made = std::make_unique<bch_scene_plan>();
  made->plan = plan_scene(scene_agents_of(agents), use);
  for (const ShapeSource& shape : made->plan.shapes)
    made->shapes.push_back({shape.character, {shape.at.clip, shape.at.seconds}, shape.whole});
  return made;
}

/// The bodies that planes are chosen for, cut at all of them.
std::vector<Shape> bodies_of(std::span<const bch_character* const> characters,
                             std::span<const bch_pose> poses, std::span<const float> planes) {
  const ShapeSetPlan plan{.slices = {planes.begin(), planes.end()}};
  std::vector<Shape> bodies;
  std::optional<PoseShaper> shaper;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Character& of = *object_of(characters[i], "a character of characters").character;
    check_pose(of, poses[i], i);
    if (i == 0 || characters[i] != characters[i - 1]) shaper.emplace(of, plan);
    bodies.push_back(shape_of_pose(*shaper, pose_of(poses[i]), i));
  }
  return bodies;
}

}  // namespace
}  // namespace bch::c_api

using namespace bch;
using namespace bch::c_api;

bch_status bch_local_densities(const double* x, const double* y, size_t count, double radius,
                               double* densities) {
  return guarded([&] {
    const auto to = array_of(densities, count, "densities");
    const std::vector<double> found =
        local_densities(array_of(x, count, "x"), array_of(y, count, "y"), radius);
    std::copy(found.begin(), found.end(), to.begin());
  });
}

bch_status bch_depth_at_density(double people_per_square_metre, uint32_t* depth) {
  return guarded([&] {
    const std::uint32_t found = depth_at_density(people_per_square_metre);
    required(depth, "depth") = found;
  });
}

bch_status bch_standing_slices(uint32_t slabs, float* slices) {
  return guarded([&] {
    const std::vector<float> planes = standing_slices(slabs);
    const auto to = array_of(slices, planes.size(), "slices");
    std::copy(planes.begin(), planes.end(), to.begin());
  });
}

bch_status bch_best_slices(const bch_character* const* characters, const bch_pose* poses, size_t count,
                           const float* planes, size_t plane_count, uint32_t slabs, float* slices,
                           size_t* slice_count) {
  return guarded([&] {
    required(slice_count, "slice_count");
    const auto among = array_of(planes, plane_count, "planes");
    const std::vector<Shape> bodies =
        bodies_of(array_of(characters, count, "characters"), array_of(poses, count, "poses"), among);
    const std::vector<float> best = best_slices(bodies, among, slabs);
    const auto to = array_of(slices, best.size(), "slices");
    std::copy(best.begin(), best.end(), to.begin());
    *slice_count = best.size();
  });
}

bch_status bch_scene_plan_create(const bch_scene_agents* agents, const bch_scene_use* use,
                                 bch_scene_plan** plan) {
  return guarded([&] {
    required(plan, "plan");
    hand_out(plan_of(sized(&required(agents, "agents"), bch_scene_agents BCH_SCENE_AGENTS_INIT, "agents"),
                     sized<bch_scene_use>(use, BCH_SCENE_USE_INIT, "use")),
             plan);
  });
}

bch_status bch_scene_plan_get_set(const bch_scene_plan* handle, bch_plan* set) {
  return guarded([&] {
    const ShapeSetPlan& of = object_of(handle, "plan").plan.set;
    bch_plan all = BCH_PLAN_INIT;
    all.outlines = of.outlines, all.culling = of.culling, all.heights = of.heights;
    all.depths = of.depths.data(), all.depth_count = of.depths.size();
    all.slices = of.slices.data(), all.slice_count = of.slices.size();
    fill(set, all, "set");
  });
}

bch_status bch_scene_plan_get_shapes(const bch_scene_plan* plan, const bch_shape_source** shapes,
                                     size_t* count) {
  return guarded([&] {
    const auto& all = object_of(plan, "plan").shapes;
    required(shapes, "shapes"), required(count, "count");
    *shapes = all.data(), *count = all.size();
  });
}

bch_status bch_scene_plan_get_agents(const bch_scene_plan* handle, const uint32_t** shape,
                                     const uint8_t** level, size_t* count) {
  return guarded([&] {
    const ScenePlan& plan = object_of(handle, "plan").plan;
    required(shape, "shape"), required(level, "level"), required(count, "count");
    *shape = plan.agent_shape.data(), *level = plan.agent_level.data(), *count = plan.agent_shape.size();
  });
}

bch_status bch_scene_plan_free(bch_scene_plan* plan) {
  return free_object(plan, "plan");
}
