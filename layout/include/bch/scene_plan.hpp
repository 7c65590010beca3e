// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include <bch/characters.hpp>
#include <bch/shapes.hpp>

namespace bch {

/// Names a pose of one of the characters of a scene.
struct PoseId {
  std::uint32_t character = 0;  ///< index in the scene's list of characters
  PoseTime at;
};

/// Describes the queries and levels of detail that a scene is planned for.
struct SceneRequirements {
  /// Whether to keep outlines, as in ShapeSetPlan.
  bool outlines = true;
  /// Returns the cut depth for agents at a distance from the viewer; empty: all_depths.
  /// The coarser of this depth and density_depth's is used, so return all_depths, the finest, where the
  /// distance should not matter.
  std::function<std::uint32_t(double metres)> depth = {};
  /// Returns the cut depth for the density around an agent, for example depth_at_density().
  std::function<std::uint32_t(double people_per_square_metre)> density_depth = {};
  /// Whether agents stand at different heights; see Agents::z.
  bool heights = false;
  /// The step, in seconds, to which times within a clip are rounded down, so that agents share shapes.
  /// 0: agents share a shape only if their poses are equal.
  float pose_step = 0;
  /// The expected number of pairs tested per shape in its lifetime.
  /// From 500 pairs on, culling data (see ShapeSetPlan) save more time than they take to build, so shapes get
  /// them.
  double pairs_per_shape = std::numeric_limits<double>::infinity();
};

/// Lists the shapes to build for a scene, each once, and the shape and level of each agent.
struct ScenePlan {
  /// Describes one agent of the scene.
  struct Agent {
    PoseId pose;
    double distance = 0;  ///< metres, from the viewer
    double density = 0;   ///< people per square metre around the agent, as from local_densities()
  };

  ShapeSetPlan set;
  std::vector<PoseId> shapes;              ///< in the order of the first agents that need them
  std::vector<std::uint32_t> agent_shape;  ///< one per agent: Agents::shape
  std::vector<std::uint8_t> agent_level;   ///< one per agent: Agents::level
};

/// Returns the cut depth that pays at a density of people: 0, the single cylinder, or all_depths.
/// It is 0 if, at that density, false collisions of the cylinder stop a walking person at most once per
/// second, as measured by `bch_lab report --experiment detail`. Intermediate depths save memory, but little
/// time.
std::uint32_t depth_at_density(double people_per_square_metre);

/// Plans which shapes a scene needs, each once, at which depths, and whether with culling data.
/// Errors:  throws std::invalid_argument, naming the agent, if a distance or density is negative or not
///          finite or a time is not finite; if the pose step is negative or not finite, if the number of
///          pairs is negative or NaN, and if there are more than 255 different depths.
ScenePlan plan_scene(std::span<const ScenePlan::Agent> agents, const SceneRequirements& requirements = {});

/// Measures the density around each agent, in people per square metre.
/// It is the number of agents within `radius`, the agent included, over the area of that circle; it is lower
/// at the edge of a crowd. Takes n log n steps for n agents, plus one for each neighbour.
/// Sizes:   x.size() == y.size(); the result has one number per agent.
/// Units:   metres.
/// Errors:  throws std::invalid_argument if the sizes differ, if a position is not finite or beyond 1e9 m
///          (naming the agent), or if the radius is not positive and finite.
std::vector<double> local_densities(std::span<const double> x, std::span<const double> y, double radius = 2);

}  // namespace bch
