// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/scene_plan.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>

#include "layout/base/floating_point_state.hpp"
#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"

namespace bch {

using namespace detail;

namespace {

/// The number of pairs per shape from which culling data pays: the time to build it over the time that it saves per pair
/// of a crowd, measured by `ratios.py --table plans`.
constexpr double pairs_for_culling = 500;

constexpr std::size_t max_levels = 255;

[[noreturn]] void reject(std::size_t agent, const std::string& what) {
  throw std::invalid_argument("scene plan: agent " + std::to_string(agent) + ": " + what);
}

void require(const SceneRequirements& requirements) {
  if (!(requirements.pose_step >= 0) || !is_finite(requirements.pose_step))
    throw std::invalid_argument("scene plan: expected a pose step of at least 0 s, found " +
                                shortest(requirements.pose_step));
  if (!(requirements.pairs_per_shape >= 0))
    throw std::invalid_argument("scene plan: expected at least 0 pairs per shape, found " +
                                shortest(requirements.pairs_per_shape));
}

/// Numbers the different shapes of a scene.
class Shapes {
 public:
  explicit Shapes(float pose_step) : step_(static_cast<double>(pose_step)) {}

  std::uint32_t number(PoseId source) {
    if (source.at.clip == PoseTime::rest) source.at.seconds = 0;
    if (step_ > 0) source.at.seconds = stepped(source.at.seconds);
    const auto [found, is_new] =
        numbers_.try_emplace({source.character, source.at.clip, source.at.seconds}, list.size());
    if (is_new) list.push_back(source);
    return static_cast<std::uint32_t>(found->second);
  }

  std::vector<PoseId> list;

 private:
  /// Rounds a time down to a step, but not beyond the time itself, which may be the clip's end.
  float stepped(float seconds) const {
    const double steps = std::floor(static_cast<double>(seconds) / step_);
    return std::min(seconds, static_cast<float>(steps * step_));
  }

  double step_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, float>, std::size_t> numbers_;
};

std::vector<std::uint32_t> depths_of(std::span<const ScenePlan::Agent> agents,
                                     const SceneRequirements& requirements) {
  std::vector<std::uint32_t> depths;
  for (const ScenePlan::Agent& agent : agents)
    depths.push_back(
        std::min(requirements.depth ? requirements.depth(agent.distance) : all_depths,
                 requirements.density_depth ? requirements.density_depth(agent.density) : all_depths));
  return depths;
}

std::vector<std::uint32_t> different(std::vector<std::uint32_t> depths) {
  std::sort(depths.begin(), depths.end());
  depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
  if (depths.empty()) depths.push_back(all_depths);
  if (depths.size() > max_levels)
    throw std::invalid_argument("scene plan: expected at most 255 different depths, found " +
                                std::to_string(depths.size()));
  return depths;
}

}  // namespace

std::uint32_t depth_at_density(double people_per_square_metre) {
  return people_per_square_metre < 1.1 ? 0 : all_depths;
}

ScenePlan plan_scene(std::span<const ScenePlan::Agent> agents, const SceneRequirements& requirements) {
  const FloatingPointStateGuard floats;
  require(requirements);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    if (!(agents[i].distance >= 0) || !is_finite(agents[i].distance))
      reject(i, "expected a distance of at least 0 m, found " + shortest(agents[i].distance));
    if (!(agents[i].density >= 0) || !is_finite(agents[i].density))
      reject(i, "expected a density of at least 0 people per square metre, found " +
                    shortest(agents[i].density));
    if (!is_finite(agents[i].pose.at.seconds))
      reject(i, "expected a finite time, found " + shortest(agents[i].pose.at.seconds));
  }
  const std::vector<std::uint32_t> depths = depths_of(agents, requirements);
  ScenePlan plan;
  plan.set.depths = different(depths);
  plan.set.outlines = requirements.outlines;
  plan.set.heights = requirements.heights;
  plan.set.culling = requirements.pairs_per_shape >= pairs_for_culling;
  Shapes shapes(requirements.pose_step);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    plan.agent_shape.push_back(shapes.number(agents[i].pose));
    const auto level = std::lower_bound(plan.set.depths.begin(), plan.set.depths.end(), depths[i]);
    plan.agent_level.push_back(static_cast<std::uint8_t>(level - plan.set.depths.begin()));
  }
  plan.shapes = std::move(shapes.list);
  validate(plan.set);
  return plan;
}

}  // namespace bch
