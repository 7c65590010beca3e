// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/default_character/human_pose.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bch::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

const Vector3d& left(const JointPositions& joints, BodyJoint joint) {
  return joints[joint_index(joint)];
}

/// A turn of the left side for the right one.
Quaterniond on_side(const Quaterniond& q, Side side) {
  return side == Side::left ? q : Quaterniond(q.w(), -q.x(), q.y(), -q.z());
}

/// Orthonormal axes, the first along `first`, the second near `second`.
Matrix3d axes(const Vector3d& first, const Vector3d& second) {
  Matrix3d m;
  m.col(0) = first.normalized();
  m.col(1) = (second - second.dot(m.col(0)) * m.col(0)).normalized();
  m.col(2) = m.col(0).cross(m.col(1));
  return m;
}

/// Directions of the two bones of a limb from its root to `end`, bent towards `pole`.
struct TwoBones {
  Vector3d first, second;
};

TwoBones two_bones(double length_1, double length_2, const Vector3d& end, const Vector3d& pole) {
  // A limb pulled quite straight would snap: its knee moves without bound as the end nears the limit.
  const double distance =
      std::clamp(end.norm(), 1.02 * std::abs(length_1 - length_2), 0.9985 * (length_1 + length_2));
  const Vector3d along = end.normalized();
  const Vector3d across = (pole - pole.dot(along) * along).normalized();
  const double cosine =
      (length_1 * length_1 + distance * distance - length_2 * length_2) / (2 * length_1 * distance);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const Vector3d first = cosine * along + sine * across;
  return {first, (distance * along - length_1 * first).normalized()};
}

}  // namespace

Quaterniond about_x(double angle) {
  return Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitX()));
}
Quaterniond about_y(double angle) {
  return Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
}
Quaterniond about_z(double angle) {
  return Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
}

ArmPose blend(const ArmPose& a, const ArmPose& b, double t) {
  const auto mix = [t](const auto& x, const auto& y) { return x + t * (y - x); };
  ArmPose arm;
  arm.upper = Vector3d(a.upper + t * (b.upper - a.upper)).normalized();
  arm.fore = Vector3d(a.fore + t * (b.fore - a.fore)).normalized();
  arm.roll = mix(a.roll, b.roll);
  arm.wrist = mix(a.wrist, b.wrist);
  arm.fingers = mix(a.fingers, b.fingers);
  return arm;
}

ArmPose swinging_arm(double flexion, double elbow, double abduction) {
  const auto direction = [](double forwards, double outwards) {
    return Vector3d(std::sin(forwards), std::sin(outwards) * std::cos(forwards),
                    -std::cos(outwards) * std::cos(forwards));
  };
  ArmPose arm;
  arm.upper = direction(flexion, abduction);
  arm.fore = direction(flexion + elbow, 0.6 * abduction);
  arm.roll = 0.35;
  return arm;
}

ArmPose reaching_arm(const JointPositions& joints, const Vector3d& wrist, const Vector3d& pole) {
  const Vector3d& shoulder = left(joints, BodyJoint::shoulder);
  const Vector3d& elbow = left(joints, BodyJoint::elbow);
  const TwoBones bones = two_bones((elbow - shoulder).norm(), (left(joints, BodyJoint::wrist) - elbow).norm(),
                                   wrist - shoulder, pole);
  ArmPose arm;
  arm.upper = bones.first;
  arm.fore = bones.second;
  return arm;
}

void set_arm(HumanPose& pose, const JointPositions& joints, Side side, const ArmPose& arm) {
  const Vector3d rest = (left(joints, BodyJoint::elbow) - left(joints, BodyJoint::shoulder)).normalized();
  const Vector3d rest_hinge = rest.cross(Vector3d::UnitX()).normalized();
  // A straight arm has no plane; the little that is added lets it choose the one in which it can bend.
  const Vector3d hinge = arm.upper.cross(arm.fore + 0.05 * Vector3d::UnitX()).normalized();

  const Quaterniond swing = Quaterniond::FromTwoVectors(rest, arm.upper);
  const Quaterniond whole(axes(arm.upper, hinge) * axes(rest, rest_hinge).transpose());
  const Quaterniond twist = swing.conjugate() * whole;
  const double bend = std::acos(std::clamp(arm.upper.dot(arm.fore), -1.0, 1.0));
  // The collar bone takes part once the arm is raised (scapulohumeral rhythm).
  const Quaterniond raise = about_x(0.45 * std::clamp(arm.upper.z() + 0.35, 0.0, 1.0));

  const auto set = [&](BodyJoint joint, const Quaterniond& turn) {
    pose.turn[joint_index(joint, side)] = on_side(turn, side);
  };
  const auto around = [](double angle, const Vector3d& axis) {
    return Quaterniond(Eigen::AngleAxisd(angle, axis));
  };
  set(BodyJoint::clavicle, raise);
  set(BodyJoint::shoulder, raise.conjugate() * swing);
  set(BodyJoint::upper_arm, twist);
  set(BodyJoint::elbow, around(bend, rest_hinge));
  set(BodyJoint::forearm, around(arm.roll, rest));
  set(BodyJoint::wrist, around(-arm.wrist, Vector3d::UnitX()));
  set(BodyJoint::fingers, around(-arm.fingers, Vector3d::UnitX()));
}

void set_leg(HumanPose& pose, Side side, const LegAngles& angles, const Quaterniond& heading) {
  const Quaterniond thigh = heading * on_side(about_x(angles.abduction), side) * about_y(-angles.hip);
  pose.turn[joint_index(BodyJoint::hip, side)] = pose[BodyJoint::pelvis].conjugate() * thigh;
  pose.turn[joint_index(BodyJoint::knee, side)] = about_y(angles.knee);
  pose.turn[joint_index(BodyJoint::ankle, side)] =
      about_y(-angles.ankle) * on_side(about_x(-angles.abduction), side);
  pose.turn[joint_index(BodyJoint::toes, side)] = about_y(-angles.toes);
}

void settle(HumanPose& pose, const JointPositions& joints, const std::array<Vector3d, 2>& ankles) {
  // A standing knee is a few degrees short of straight, which 0.997 of the leg's length gives.
  const double stretch = 0.997;
  double height = std::numeric_limits<double>::infinity();
  for (const Side side : {Side::left, Side::right}) {
    const auto at = [&](BodyJoint joint) { return joints[joint_index(joint, side)]; };
    const Vector3d to_hip = pose[BodyJoint::pelvis] * (at(BodyJoint::hip) - at(BodyJoint::pelvis));
    const Vector3d& ankle = ankles[static_cast<std::size_t>(side)];
    const double across = (pose.pelvis + to_hip - ankle).head<2>().norm();
    const double length = stretch * ((at(BodyJoint::knee) - at(BodyJoint::hip)).norm() +
                                     (at(BodyJoint::ankle) - at(BodyJoint::knee)).norm());
    const double rise = std::sqrt(std::max(0.0, length * length - across * across));
    height = std::min(height, ankle.z() + rise - to_hip.z());
  }
  pose.pelvis.z() = height;
}

void plant_foot(HumanPose& pose, const JointPositions& joints, Side side, const Vector3d& ankle,
                const Quaterniond& foot) {
  const auto at = [&](BodyJoint joint) { return joints[joint_index(joint, side)]; };
  const Quaterniond& pelvis = pose[BodyJoint::pelvis];
  const Vector3d hip_at = pose.pelvis + pelvis * (at(BodyJoint::hip) - at(BodyJoint::pelvis));
  const Vector3d end = pelvis.conjugate() * (ankle - hip_at);
  const Vector3d pole = pelvis.conjugate() * foot * Vector3d::UnitX();
  const Vector3d thigh_rest = at(BodyJoint::knee) - at(BodyJoint::hip);
  const Vector3d shank_rest = at(BodyJoint::ankle) - at(BodyJoint::knee);
  const TwoBones bones = two_bones(thigh_rest.norm(), shank_rest.norm(), end, pole);

  const Quaterniond hip(axes(bones.first, pole.cross(bones.first)) *
                        axes(thigh_rest, Vector3d::UnitY()).transpose());
  const Quaterniond knee = Quaterniond::FromTwoVectors(shank_rest, hip.conjugate() * bones.second);
  pose.turn[joint_index(BodyJoint::hip, side)] = hip;
  pose.turn[joint_index(BodyJoint::knee, side)] = knee;
  pose.turn[joint_index(BodyJoint::ankle, side)] = (pelvis * hip * knee).conjugate() * foot;
}

std::array<Eigen::Affine3d, body_joint_count> place(const HumanPose& pose, const JointPositions& joints) {
  std::array<Eigen::Affine3d, body_joint_count> to_ground;
  to_ground[0] = Eigen::Translation3d(pose.pelvis) * pose.turn[0];
  for (std::uint32_t j = 1; j < body_joint_count; ++j) {
    const std::uint32_t parent = parent_index(j);
    to_ground[j] = to_ground[parent] * Eigen::Translation3d(joints[j] - joints[parent]) * pose.turn[j];
  }
  return to_ground;
}

}  // namespace bch::detail
