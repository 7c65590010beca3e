// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>

#include <bch/pairs.hpp>
#include <bch/scene_plan.hpp>

#include "kernel/c_api/arguments.hpp"
#include "kernel/c_api/objects.hpp"
#include "kernel/c_api/posing.hpp"

struct bch_scene_plan {
  bch::ScenePlan plan;
  std::vector<bch_pose_id> shapes;
};

namespace bch::c_api {
namespace {

/// The agents of a scene. Each has its number in place of a density, by which its depth is asked for.
std::vector<ScenePlan::Agent> scene_agents_of(const bch_scene_agents& given) {
  const auto poses = array_of(given.poses, given.count, "agents->poses");
  std::vector<ScenePlan::Agent> agents(given.count);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    agents[i].pose.at = {poses[i].clip, poses[i].seconds};
    if (given.character != nullptr) agents[i].pose.character = given.character[i];
    agents[i].density = static_cast<double>(i);
  }
  return agents;
}

SceneRequirements requirements_of(const bch_scene_requirements& given) {
  return {.outlines = given.outlines != 0,
          .heights = given.heights != 0,
          .pose_step = given.pose_step,
          .pairs_per_shape = given.pairs_per_shape};
}

std::unique_ptr<bch_scene_plan> plan_of(const bch_scene_agents& agents, const bch_scene_requirements& given) {
  SceneRequirements requirements = requirements_of(given);
  if (agents.depth != nullptr)
    requirements.density_depth = [&](double agent) { return agents.depth[static_cast<std::size_t>(agent)]; };
  auto made = std::make_unique<bch_scene_plan>();
  made->plan = plan_scene(scene_agents_of(agents), requirements);
  for (const PoseId& shape : made->plan.shapes)
    made->shapes.push_back({shape.character, {shape.at.clip, shape.at.seconds}});
  return made;
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

bch_status bch_scene_plan_create(const bch_scene_agents* agents, const bch_scene_requirements* requirements,
                                 bch_scene_plan** plan) {
  return guarded([&] {
    required(plan, "plan");
    hand_out(
        plan_of(sized(&required(agents, "agents"), bch_scene_agents BCH_SCENE_AGENTS_INIT, "agents"),
                sized<bch_scene_requirements>(requirements, BCH_SCENE_REQUIREMENTS_INIT, "requirements")),
        plan);
  });
}

bch_status bch_scene_plan_get_set(const bch_scene_plan* handle, bch_plan* set) {
  return guarded([&] {
    const ShapeSetPlan& of = object_of(handle, "plan").plan.set;
    bch_plan all = BCH_PLAN_INIT;
    all.outlines = of.outlines, all.culling = of.culling, all.heights = of.heights;
    all.depths = of.depths.data(), all.depth_count = of.depths.size();
    fill(set, all, "set");
  });
}

bch_status bch_scene_plan_get_shapes(const bch_scene_plan* plan, const bch_pose_id** shapes, size_t* count) {
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
