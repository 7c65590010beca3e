// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <numbers>

#include "layout/default_character/parametric_motion.hpp"

namespace bch::detail {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

using std::numbers::pi;
constexpr double ball = 0.13;  ///< metres from the ankle to the ball of the foot, about which the heel rises
constexpr double heel = 0.05;  ///< and to the heel, about which the toes rise
constexpr double natural_step = 0.415;  ///< of the stature

/// A foot at a fraction of its stride, from its heel's contact on.
struct Foot {
  double x;      ///< ahead of the pelvis, metres
  double lift;   ///< metres
  double pitch;  ///< radians; above 0 the toes point down
};

/// How a body strides at a speed.
struct Measures {
  double stride;  ///< metres
  double vigour;  ///< the step over a natural one, 1 at most
  double stance;  ///< fraction of the stride that a foot is on the ground

  Measures(const Manner& manner, const Stride& of)
      : stride(of.speed / of.strides_per_second),
        vigour(std::min(1.0, 0.5 * stride / (natural_step * manner.stature))),
        stance(0.76 - 0.14 * vigour) {}
};

/// Heel and toes rise about a seventh of the turn of natural walking for each seventh of its step: about 30 degrees before the toes leave
/// the ground, 15 at the heel's contact.
Foot foot_at(const Measures& of, double fraction) {
  const double ahead = 0.5 * of.stance * of.stride;
  const double off = 32 * degree * of.vigour, contact = -14 * degree * of.vigour;
  if (fraction < of.stance) {
    const double t = fraction / of.stance;
    return {ahead - of.stride * fraction, 0, contact * (1 - ease(0, 0.16, t)) + off * ease(0.62, 1, t)};
  }
  const double t = (fraction - of.stance) / (1 - of.stance);
  const double clearance = 0.015 + 0.045 * of.vigour;
  return {-ahead + 2 * ahead * ease(0, 1, t), clearance * std::sin(pi * t),
          off + (contact - off) * ease(0, 0.75, t)};
}

/// The height of an ankle above that of a flat foot: the foot turns about its ball or its heel.
double rise(const Foot& foot) {
  return foot.lift + (foot.pitch > 0 ? ball : -heel) * std::sin(foot.pitch);
}

void set_trunk(HumanPose& pose, const Measures& of, double beat, double shoulders) {
  const double rotation = -4 * degree * of.vigour * std::cos(beat);
  const double list = 2.5 * degree * of.vigour * std::sin(beat - 0.15);
  pose[BodyJoint::pelvis] = about_z(0.3 * shoulders + rotation) * about_x(list) * about_y(3 * degree);
  const Quaterniond thorax =
      about_z(shoulders - 0.9 * rotation) * about_x(-0.25 * list) * about_y(3.5 * degree);
  const Quaterniond waist = pose[BodyJoint::pelvis].conjugate() * thorax;
  pose[BodyJoint::spine] = Quaterniond::Identity().slerp(0.5, waist);
  pose[BodyJoint::chest] = pose[BodyJoint::spine];
  const Quaterniond face = thorax.conjugate() * about_y(2 * degree);
  pose[BodyJoint::neck] = Quaterniond::Identity().slerp(0.5, face);
  pose[BodyJoint::head] = pose[BodyJoint::neck];
}

}  // namespace

/// Shares of stance and swing, the turns of pelvis and thorax, and the arms' excursion are those of walking(), in proportion to the
/// step; a step shorter than natural is taken with the foot longer on the ground and lifted less.
Motion striding(const Manner& manner, const Stride& stride) {
  const Measures of(manner, stride);
  return [manner, stride, of](double seconds) {
    const double phase = seconds * stride.strides_per_second;
    const double beat = 2 * pi * phase;
    HumanPose pose;
    set_trunk(pose, of, beat, stride.shoulders);
    pose.pelvis = {stride.speed * seconds, 0.012 * std::sin(beat), 0};
    std::array<Vector3d, 2> ankles;
    std::array<Foot, 2> feet;
    const double height = manner.joints[joint_index(BodyJoint::ankle)].z();
    for (const Side side : {Side::left, Side::right}) {
      const auto f = static_cast<std::size_t>(side);
      const double own = phase + (side == Side::left ? 0 : 0.5), sign = side == Side::left ? 1 : -1;
      feet[f] = foot_at(of, own - std::floor(own));
      ankles[f] = {pose.pelvis.x() + feet[f].x, sign * 0.5 * manner.foot_spacing, height + rise(feet[f])};
      const double swing = of.vigour * manner.arm_swing * std::cos(2 * pi * own);
      set_arm(pose, manner.joints, side,
              swinging_arm((-4 - 18 * swing) * degree, (24 - 13 * swing) * degree, manner.arm_abduction));
    }
    settle(pose, manner.joints, ankles);
    for (const Side side : {Side::left, Side::right}) {
      const auto f = static_cast<std::size_t>(side);
      plant_foot(pose, manner.joints, side, ankles[f],
                 about_z((side == Side::left ? 1 : -1) * 5 * degree) * about_y(feet[f].pitch));
      pose.turn[joint_index(BodyJoint::toes, side)] = about_y(-std::max(0.0, 0.7 * feet[f].pitch));
    }
    return pose;
  };
}

}  // namespace bch::detail
