// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distributed/agent_validation.hpp"

#include <sstream>
#include <stdexcept>
#include <string>

#include "kernel/runtime/validation.hpp"

namespace bch::detail {
namespace {

[[noreturn]] void reject(const DistributedCrowd::Agent& agent, const char* field, double value,
                         const char* limits) {
  std::ostringstream message;
  message << "agent " << agent.id << ": expected a " << field << " " << limits << ", found " << value;
  throw std::invalid_argument(message.str());
}

}  // namespace

void require_valid(const DistributedCrowd::Agent& agent, bool heights) {
  const std::string why = misplacement(agent.x, agent.y, {agent.heading}, heights ? agent.z : 0);
  if (!why.empty()) throw std::invalid_argument("agent " + std::to_string(agent.id) + ": " + why);
}

void require_valid(const DistributedCrowd::Agent& agent, const ShapeSet& shapes) {
  if (agent.shape >= shapes.shape_count()) reject(agent, "shape", agent.shape, "of the set");
  if (agent.level >= shapes.level_count()) reject(agent, "level", agent.level, "of the set");
}

void require_valid(const DistributedCrowd::Agent& agent, const PosedShapes& shapes) {
  if (agent.shape >= shapes.characters().size()) reject(agent, "shape", agent.shape, "of the characters");
  if (agent.level >= shapes.plan().depths.size()) reject(agent, "level", agent.level, "of the plan");
  if (agent.pose.clip == PoseTime::rest) return;
  const std::vector<Clip>& clips = shapes.characters()[agent.shape].clips;
  if (agent.pose.clip >= clips.size()) reject(agent, "clip", agent.pose.clip, "of the character");
  if (!(agent.pose.seconds >= 0 && agent.pose.seconds <= clips[agent.pose.clip].seconds))
    reject(agent, "time", static_cast<double>(agent.pose.seconds), "within the clip");
}

}  // namespace bch::detail
