// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

namespace bch::detail {

/// Lists the skeleton of a parametric body. A parent stands before its children; the joints of the right side
/// follow those of the left in the same order. Swing and twist of the long bones are separate joints (the
/// shoulder swings and the upper arm, half-way down, twists), because linear blend skinning wrings a skin
/// that takes a whole twist at one place.
enum class BodyJoint : std::uint32_t {
  pelvis,
  spine,
  chest,
  neck,
  head,
  clavicle,
  shoulder,
  upper_arm,
  elbow,
  forearm,
  wrist,
  fingers,
  hip,
  knee,
  ankle,
  toes
};

inline constexpr std::uint32_t midline_joints = 5;
inline constexpr std::uint32_t side_joints = 11;
inline constexpr std::uint32_t body_joint_count = midline_joints + 2 * side_joints;

enum class Side : std::uint32_t { left, right };

/// Returns the index of a joint among all of a body; the side is ignored on the midline.
constexpr std::uint32_t joint_index(BodyJoint joint, Side side = Side::left) {
  const auto index = static_cast<std::uint32_t>(joint);
  return index < midline_joints || side == Side::left ? index : index + side_joints;
}

/// Returns the index of a joint's parent; the pelvis, joint 0, has none and must not be asked for.
constexpr std::uint32_t parent_index(std::uint32_t joint) {
  using enum BodyJoint;
  constexpr std::array<BodyJoint, midline_joints + side_joints> parents{
      pelvis,    pelvis, spine,   chest, neck,   chest, clavicle, shoulder,
      upper_arm, elbow,  forearm, wrist, pelvis, hip,   knee,     ankle};
  const bool right = joint >= midline_joints + side_joints;
  return joint_index(parents[right ? joint - side_joints : joint], right ? Side::right : Side::left);
}

/// Holds the positions of the joints in the rest pose, in metres, z up, facing +x, the left side at positive y. No
/// joint is turned at rest.
using JointPositions = std::array<Eigen::Vector3d, body_joint_count>;

}  // namespace bch::detail
