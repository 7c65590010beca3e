// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <numbers>

#include "layout/default_character/parametric_motion.hpp"

namespace bch::detail {
namespace {

using Eigen::Vector3d;

/// The place of a foot: the ankle's point on the ground and the foot's direction.
struct Footing {
  Vector3d at = Vector3d::Zero();
  double yaw = 0;
};

/// Both feet at a time, and how far each is in its swing: 0 on the ground, between 0 and 1 in the air.
struct Feet {
  std::array<Footing, 2> foot;
  std::array<double, 2> swing{};
};

/// Steps of one rhythm: in each period the leading foot moves first, the other follows.
struct Rhythm {
  double period;
  double step;  ///< seconds that a foot is in the air
  std::size_t leader;
};

Footing between(const Footing& a, const Footing& b, double t) {
  return {a.at + t * (b.at - a.at), a.yaw + t * (b.yaw - a.yaw)};
}

/// `stand(k, foot)` is the footing of a foot after k periods.
template <class Stand>
Feet feet_at(const Rhythm& rhythm, double seconds, const Stand& stand) {
  const double period = std::floor(seconds / rhythm.period);
  const double t = seconds - period * rhythm.period;
  Feet feet;
  for (std::size_t f = 0; f < 2; ++f) {
    const double begin = f == rhythm.leader ? 0.04 : 0.5 * rhythm.period + 0.04;
    const double fraction = std::clamp((t - begin) / rhythm.step, 0.0, 1.0);
    feet.swing[f] = fraction;
    feet.foot[f] = between(stand(period, f), stand(period + 1, f), ease(0, 1, fraction));
  }
  return feet;
}

/// Seconds by which the load leaves a foot before its step and comes back after it.
double load(const Rhythm& rhythm, std::size_t foot, double seconds) {
  const double period = std::floor(seconds / rhythm.period);
  const double t = seconds - period * rhythm.period;
  const double middle = 0.04 + 0.5 * rhythm.step + (foot == rhythm.leader ? 0 : 0.5 * rhythm.period);
  double distance = std::abs(t - middle);
  distance = std::min(distance, rhythm.period - distance);
  return 0.3 + 0.7 * ease(0.15 * rhythm.period, 0.36 * rhythm.period, distance);
}

/// Puts the pelvis over the feet and the feet where they belong.
void stand_on(HumanPose& pose, const Manner& manner, const Feet& feet, const std::array<double, 2>& loads) {
  const JointPositions& joints = manner.joints;
  const Vector3d& ankle = joints[joint_index(BodyJoint::ankle)];
  const double total = loads[0] + loads[1];
  pose.pelvis = (loads[0] * feet.foot[0].at + loads[1] * feet.foot[1].at) / total;
  std::array<Vector3d, 2> ankles;
  std::array<double, 2> lift{};
  for (std::size_t f = 0; f < 2; ++f) {
    lift[f] = std::sin(std::numbers::pi * feet.swing[f]);
    ankles[f] = feet.foot[f].at + Vector3d(0, 0, ankle.z() + 0.055 * lift[f]);
  }
  settle(pose, joints, ankles);
  for (const Side side : {Side::left, Side::right}) {
    const auto f = static_cast<std::size_t>(side);
    plant_foot(pose, joints, side, ankles[f], about_z(feet.foot[f].yaw) * about_y(12 * degree * lift[f]));
  }
}

}  // namespace

double ease(double begin, double end, double t) {
  const double fraction = std::clamp((t - begin) / (end - begin), 0.0, 1.0);
  return fraction * fraction * (3 - 2 * fraction);
}

ArmPose hanging_arm(const Manner& manner) {
  return swinging_arm(-2 * degree, 22 * degree, manner.arm_abduction);
}

/// Head before trunk before feet, as in K. Hase, R. B. Stein, "Turning strategies during human walking",
/// J. Neurophysiol. 81, 1999, and the step turns described there: the inner foot opens, the outer one closes.
Motion turning(const Manner& manner, double direction) {
  return [manner, direction](double seconds) {
    const double angle = 48 * degree * direction;
    const Rhythm rhythm{1.4, 0.52, direction > 0 ? 0u : 1u};
    const double half = 0.5 * manner.foot_spacing;
    const Feet feet = feet_at(rhythm, seconds, [&](double k, std::size_t f) {
      const double side = f == 0 ? 1 : -1;
      const double yaw = k * angle;
      return Footing{about_z(yaw) * Vector3d(-0.03, side * half, 0), yaw + side * 7 * degree};
    });
    const double yaw = 0.5 * (feet.foot[0].yaw + feet.foot[1].yaw);
    const double ahead = seconds / rhythm.period * angle + 0.3 * angle;
    const double twist = std::clamp(ahead - yaw, -22 * degree, 22 * degree);

    HumanPose pose;
    pose[BodyJoint::pelvis] = about_z(yaw + 0.25 * twist) * about_y(2 * degree);
    pose[BodyJoint::spine] = about_z(0.2 * twist);
    pose[BodyJoint::chest] = about_z(0.25 * twist);
    pose[BodyJoint::neck] = about_z(0.3 * twist);
    pose[BodyJoint::head] = about_z(0.5 * twist) * about_y(2 * degree);
    stand_on(pose, manner, feet, {load(rhythm, 0, seconds), load(rhythm, 1, seconds)});
    for (const Side side : {Side::left, Side::right}) {
      // The arms trail behind the trunk: one is swung outwards in front, the other behind.
      const double trail = (side == Side::left ? -1 : 1) * twist;
      set_arm(pose, manner.joints, side,
              swinging_arm(-2 * degree - 0.5 * trail, 26 * degree, 1.25 * manner.arm_abduction));
    }
    return pose;
  };
}

Motion side_stepping(const Manner& manner, double direction) {
  return [manner, direction](double seconds) {
    const double length = 0.175 * manner.stature * manner.stride;
    const Rhythm rhythm{1.3, 0.5, direction > 0 ? 0u : 1u};
    const double half = 0.5 * manner.foot_spacing;
    const Feet feet = feet_at(rhythm, seconds, [&](double k, std::size_t f) {
      const double side = f == 0 ? 1 : -1;
      return Footing{Vector3d(-0.03, side * half + direction * k * length, 0), side * 5 * degree};
    });
    const double beat = 2 * std::numbers::pi * seconds / rhythm.period;

    HumanPose pose;
    const double list = 2.5 * degree * direction * std::sin(beat);
    pose[BodyJoint::pelvis] = about_x(list) * about_y(3 * degree);
    pose[BodyJoint::spine] = about_x(-0.7 * list) * about_y(1 * degree);
    pose[BodyJoint::chest] = about_x(-0.5 * list);
    pose[BodyJoint::neck] = about_z(direction * 0.25);
    pose[BodyJoint::head] = about_z(direction * (0.3 + 0.1 * std::sin(0.7 * seconds)));
    stand_on(pose, manner, feet, {load(rhythm, 0, seconds), load(rhythm, 1, seconds)});
    for (const Side side : {Side::left, Side::right}) {
      const double open = 0.5 - 0.5 * std::cos(beat);
      set_arm(pose, manner.joints, side,
              swinging_arm(3 * degree, 32 * degree, (1.3 + 0.5 * open) * manner.arm_abduction));
    }
    return pose;
  };
}

}  // namespace bch::detail
