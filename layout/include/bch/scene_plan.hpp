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

/// Names the character and pose of a shape that a scene needs.
struct PoseId {
  std::uint32_t character = 0;  ///< index in the scene's list of characters
  PoseTime at;
};

/// Describes the queries and levels of detail that a scene is planned for.
struct SceneUse {
  /// Says whether to keep outlines, as ShapeSetPlan does.
  bool outlines = true;
  /// Gives the cut depth of agents at a distance, for level of detail; none: all_depths.
  /// It returns all_depths where the distance does not matter.
  std::function<std::uint32_t(double metres)> depth = {};
  /// Gives the cut depth by the density around agents, for example depth_at_density().
  /// If both functions give a depth, the coarser counts.
  std::function<std::uint32_t(double people_per_square_metre)> density_depth = {};
  /// Says whether agents stand at different heights; see Agents::z.
  bool heights = false;
  /// Gives the step, in seconds, to which times within a clip are rounded down.
  /// Agents then share shapes; 0: agents share only equal poses.
  float pose_step = 0;
  /// Gives the expected number of pairs tested per shape in its lifetime.
  /// From 500 on, shapes get culling data: from there it saves more time than building it takes.
  double pairs_per_shape = std::numeric_limits<double>::infinity();
};

/// Lists the shapes to build for a scene, each once, and the shape and level of each agent.
struct ScenePlan {
  /// Describes an agent of a scene to plan.
  struct Agent {
    PoseId pose;
    double distance = 0;  ///< metres, from the viewer
    double density = 0;   ///< people per square metre around the agent, as from local_densities()
  };

  ShapeSetPlan set;
  std::vector<PoseId> shapes;              ///< in the order in which agents first show them
  std::vector<std::uint32_t> agent_shape;  ///< one per agent: Agents::shape
  std::vector<std::uint8_t> agent_level;   ///< one per agent: Agents::level
};

/// Returns 0, the single cylinder, at a density at which its false collisions stop a walking person at most
/// once a second, else all_depths. Depths between save memory, but little time. It was measured
/// (`bch_lab report --experiment detail`).
std::uint32_t depth_at_density(double people_per_square_metre);

/// Plans which shapes a scene needs, each once, at which depths and with which further data.
/// Errors:  throws std::invalid_argument on a distance or density that is negative or not finite, naming the
///          agent, a time that is not finite, a pose step that is negative or not finite, a number of pairs
///          that is negative or NaN, and on more than 255 different depths.
ScenePlan plan_scene(std::span<const ScenePlan::Agent> agents, const SceneUse& use = {});

/// Measures the density around each agent, in people per square metre.
/// That is the number of agents within `radius`, itself included, over the area of that circle. It is lower
/// at the edge of a crowd. Takes n log n steps for n agents, plus one for each neighbour.
/// Sizes:   x.size() == y.size(); one number per agent.
/// Units:   metres.
/// Errors:  throws std::invalid_argument on sizes that differ, a position that is not finite or beyond 1e9 m,
///          naming the agent, and a radius that is not positive and finite.
std::vector<double> local_densities(std::span<const double> x, std::span<const double> y, double radius = 2);

}  // namespace bch
