// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <Eigen/Geometry>

#include "layout/default_character/body_joints.hpp"

namespace bch::detail {

/// Represents a pose of a parametric body: where the pelvis is, and how each joint is turned against its parent. No
/// joint is turned at rest, so a turn is written in the axes of the rest pose: x forwards, y to the left, z
/// up.
struct HumanPose {
  Eigen::Vector3d pelvis = Eigen::Vector3d::Zero();
  std::array<Eigen::Quaterniond, body_joint_count> turn;

  HumanPose() { turn.fill(Eigen::Quaterniond::Identity()); }
  Eigen::Quaterniond& operator[](BodyJoint joint) { return turn[joint_index(joint)]; }
};

Eigen::Quaterniond about_x(double angle);
Eigen::Quaterniond about_y(double angle);
Eigen::Quaterniond about_z(double angle);

/// Represents an arm as seen in the chest's axes, written for the left side; the right one mirrors it.
struct ArmPose {
  Eigen::Vector3d upper{0, 0, -1};  ///< direction from shoulder to elbow
  Eigen::Vector3d fore{0, 0, -1};   ///< direction from elbow to wrist
  double roll = 0;                  ///< pronation: turns the thumb inwards, radians
  double wrist = 0;                 ///< flexion of the hand towards the palm, radians
  double fingers = 0.2;             ///< flexion of the fingers, radians
};

ArmPose blend(const ArmPose& a, const ArmPose& b, double t);

/// Returns an arm that swings in the walking direction, by its angles in radians.
ArmPose swinging_arm(double flexion, double elbow, double abduction);

/// Returns the arm that brings its wrist to a point and its elbow towards `pole`. `wrist`: in the frame of the body
/// at rest, on the left side; a point out of reach is approached. The chest's turns carry the point along.
ArmPose reaching_arm(const JointPositions& joints, const Eigen::Vector3d& wrist, const Eigen::Vector3d& pole);

void set_arm(HumanPose& pose, const JointPositions& joints, Side side, const ArmPose& arm);

/// Holds the angles of a leg, radians, in the direction of walking: flexion of hip and knee, the ankle's
/// dorsiflexion, the toes' extension, and the thigh's abduction.
struct LegAngles {
  double hip, knee, ankle, toes, abduction;
};

/// Turns the joints of a leg; the thigh is turned in the axes of `heading`, so that lists and turns of the pelvis do not move the legs.
void set_leg(HumanPose& pose, Side side, const LegAngles& angles, const Eigen::Quaterniond& heading);

/// Sets the height of the pelvis such that the leg which has to reach farthest is nearly straight. `ankles`:
/// left, right, in the frame of the ground. The pelvis must be turned and over its place.
void settle(HumanPose& pose, const JointPositions& joints, const std::array<Eigen::Vector3d, 2>& ankles);

/// Bends a leg so that its ankle comes to a point and its foot has a direction, both in the frame of the
/// ground, with the knee over the toes. A point out of reach is approached.
void plant_foot(HumanPose& pose, const JointPositions& joints, Side side, const Eigen::Vector3d& ankle,
                const Eigen::Quaterniond& foot);

/// Returns the transform from each joint to the ground.
std::array<Eigen::Affine3d, body_joint_count> place(const HumanPose& pose, const JointPositions& joints);

}  // namespace bch::detail
