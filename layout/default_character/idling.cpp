// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cmath>
#include <numbers>

#include "layout/default_character/parametric_motion.hpp"

namespace bch::detail {
namespace {

using Eigen::Vector3d;

using std::numbers::pi;

/// A slow wander between -1 and 1 that does not repeat within a clip.
double wander(double seconds, double period, double offset) {
  return 0.6 * std::sin(2 * pi * seconds / period + offset) +
         0.4 * std::sin(2 * pi * seconds / (period * 0.618) + 2.3 * offset + 1);
}

/// The stance: the load goes from foot to foot, the hip of the loaded side stands out and up, the knee of
/// the other bends. Sway of a few millimetres after D. A. Winter, "A.B.C. of balance during standing and
/// walking", 1995.
void stand(HumanPose& pose, const Manner& manner, double seconds, double shift) {
  const JointPositions& joints = manner.joints;
  const double half = 0.5 * manner.foot_spacing;
  const double sway = 0.006;
  pose.pelvis = {0.012 + sway * wander(seconds, 3.7, 0.4),
                 0.62 * half * shift + sway * wander(seconds, 5.1, 1.9), 0};
  const double list = 4 * degree * shift;
  pose[BodyJoint::pelvis] =
      about_z(3 * degree * wander(seconds, 11, 0.2)) * about_x(list) * about_y(2 * degree);
  pose[BodyJoint::spine] = about_x(-0.8 * list) * about_y(-1 * degree + 0.01 * wander(seconds, 4.3, 0));
  pose[BodyJoint::chest] =
      about_x(-0.55 * list) * about_y(1 * degree + 0.01 * std::sin(2 * pi * seconds / 3.6));
  // The left foot stands a little in front and turned out.
  const double height = joints[joint_index(BodyJoint::ankle)].z();
  const std::array<Vector3d, 2> ankles{Vector3d(0.010, half, height), Vector3d(-0.035, -half, height)};
  settle(pose, joints, ankles);
  plant_foot(pose, joints, Side::left, ankles[0], about_z(13 * degree));
  plant_foot(pose, joints, Side::right, ankles[1], about_z(-8 * degree));
}

void look(HumanPose& pose, double yaw, double pitch) {
  pose[BodyJoint::neck] = about_z(0.4 * yaw) * about_y(0.4 * pitch);
  pose[BodyJoint::head] = about_z(0.6 * yaw) * about_y(0.6 * pitch);
}

/// Targets of the hands, in parts of the stature from the ground up and metres across, at rest.
struct Reach {
  const Manner& manner;

  ArmPose operator()(double x, double y, double height, const Vector3d& pole, double roll, double wrist = 0,
                     double fingers = 0.3) const {
    ArmPose arm = reaching_arm(manner.joints, Vector3d(x, y, height * manner.stature), pole);
    arm.roll = roll;
    arm.wrist = wrist;
    arm.fingers = fingers;
    return arm;
  }
};

struct Arms {
  ArmPose left, right;
};

/// Both hands move before the belly; the gestures grow and fade.
Arms talking_arms(const Manner& manner, double t) {
  const Reach reach{manner};
  const double g = manner.gesture;
  const double vigour = 0.55 + 0.45 * wander(t, 6.5, 0.7);
  const auto hand = [&](double offset) {
    return reach(0.24 + 0.10 * g * vigour * wander(t, 1.9, offset),
                 manner.joints[joint_index(BodyJoint::shoulder)].y() +
                     g * (0.05 + 0.10 * vigour * wander(t, 2.7, offset + 1)),
                 0.64 + 0.05 * g * vigour * wander(t, 1.5, offset + 2), {-0.5, 0.9, -0.6}, -0.6, -0.1, 0.25);
  };
  const double rest = ease(0.1, 0.5, wander(t, 9, 2));
  return {hand(0), blend(hand(2.6), hanging_arm(manner), rest)};
}

Arms arms(const Manner& manner, Idle kind, double t) {
  const Reach reach{manner};
  const ArmPose hang = hanging_arm(manner);
  const double g = manner.gesture;
  const double s = manner.stature / 1.88;
  const double outwards = manner.joints[joint_index(BodyJoint::shoulder)].y();
  switch (kind) {
    case Idle::akimbo: {
      const ArmPose on_hip = reach(0.02, outwards + 0.045, 0.590, {-0.45, 1, 0.1}, 0.9, -0.7, 0.5);
      const double drop = ease(7, 8.2, t) - ease(11, 12.2, t);
      return {on_hip, blend(on_hip, hang, drop)};
    }
    case Idle::arms_crossed:
      return {reach(0.175 * s, -0.055 * s, 0.685, {0.0, 1, -0.8}, 0.9, 0.25, 0.4),
              reach(0.225 * s, -0.035 * s, 0.712, {0.1, 1, -0.8}, 0.4, 0.25, 0.4)};
    case Idle::phone:
      return {hang, blend(hang, reach(0.09 * s, 0.145 * s, 0.868, {0.8, 0.7, -1}, 0.4, -0.6, 0.6),
                          ease(0.8, 2.0, t) - ease(12.2, 13.4, t))};
    case Idle::wave: {
      const double up = ease(0.6, 1.6, t) - ease(5.6, 6.6, t) + ease(8, 9, t) - ease(11, 12, t);
      const double swing = 0.09 * std::sin(2 * pi * 1.4 * t);
      return {
          hang,
          blend(hang, reach(0.14, outwards + 0.20 * g + swing, 0.935, {-0.2, 0.6, -1}, 0.9, -0.2, 0.05), up)};
    }
    case Idle::talk:
      return talking_arms(manner, t);
    case Idle::think:
      return {reach(0.215 * s, -0.06 * s, 0.640, {-0.1, 1, -0.8}, 0.2, 0.1, 0.4),
              reach(0.165 * s, 0.070 * s, 0.808, {0.35, 0.25, -1}, 0.9, 0.0, 0.9)};
    case Idle::shift:
    case Idle::search_around:
      break;
  }
  return {hang, hang};
}

}  // namespace

Motion idling(const Manner& manner, Idle kind) {
  return [manner, kind](double seconds) {
    HumanPose pose;
    const double period = kind == Idle::shift ? 7.0 : 12.0;
    const double shift = std::tanh(2.2 * wander(seconds, period, static_cast<double>(kind)));
    stand(pose, manner, seconds, kind == Idle::shift ? shift : 0.6 * shift);
    double yaw = 0.2 * wander(seconds, 7.3, 1 + static_cast<double>(kind));
    double pitch = 0.08 + 0.08 * wander(seconds, 8.9, 0.5);
    if (kind == Idle::search_around) {
      yaw = 1.05 * std::tanh(1.8 * wander(seconds, 6.1, 0.3));
      pitch = 0.12 * wander(seconds, 5.3, 0.9);
      pose[BodyJoint::chest] = about_z(0.2 * yaw) * pose[BodyJoint::chest];
    }
    if (kind == Idle::phone) yaw -= 0.1;
    look(pose, yaw, pitch);

    Arms both = arms(manner, kind, seconds);
    const double drift = 0.03 * wander(seconds, 6.7, 0.8);
    for (ArmPose* arm : {&both.left, &both.right}) {
      arm->upper = (arm->upper + Vector3d(drift, 0, 0)).normalized();
      arm->fore = (arm->fore + Vector3d(1.3 * drift, 0, 0)).normalized();
    }
    set_arm(pose, manner.joints, Side::left, both.left);
    set_arm(pose, manner.joints, Side::right, both.right);
    return pose;
  };
}

}  // namespace bch::detail
