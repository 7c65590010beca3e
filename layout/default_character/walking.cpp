// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <numbers>

#include "layout/default_character/parametric_motion.hpp"

namespace bch::detail {
namespace {

using std::numbers::pi;

/// An angle over one stride, from heel contact to the next heel contact of the same foot, at every 5 %.
using Curve = std::array<double, 20>;

// Sagittal angles in degrees after the means at natural cadence in D. A. Winter, "The biomechanics and motor
// control of human gait", 1987 and 1991: flexion of hip and knee, dorsiflexion of the ankle. They are
// rounded, and moved by a few degrees where a rigid sole on a level floor asks for it: the knee bends a
// little less under load and the ankle a little more in the swing. The extension of the toes follows the
// pitch of the foot.
constexpr Curve hip_flexion{20.5, 19.5,  16.5, 13,  9,   5,  1.5,  -2,   -5.5, -9,
                            -11,  -10.5, -6,   1.5, 9.5, 16, 20.5, 22.5, 22,   21};
constexpr Curve knee_flexion{4,  9,  13, 16, 15.5, 13.5, 11, 8.5, 7,  8.5,
                             14, 24, 38, 53, 63,   64.5, 58, 43,  24, 8};
constexpr Curve dorsiflexion{0,   -4.5, -5,  -1.5, 2,  4.5, 6.5, 8, 9.3, 9.5,
                             6.5, -2,   -13, -17,  -8, 0,   4,   5, 4,   2};
constexpr Curve toe_extension{12, 4, 0, 0, 0, 0, 0, 0, 2, 8, 18, 29, 30, 16, 6, 4, 6, 9, 12, 13};

/// Periodic Catmull-Rom interpolation.
double at(const Curve& curve, double phase) {
  const double place = (phase - std::floor(phase)) * static_cast<double>(curve.size());
  const auto i = static_cast<std::size_t>(place);
  const double t = place - static_cast<double>(i);
  const auto value = [&](std::size_t k) { return curve[(i + k + curve.size() - 1) % curve.size()]; };
  const double a = value(0), b = value(1), c = value(2), d = value(3);
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

LegAngles leg_angles(double phase, double amplitude) {
  const double hip_mean = 5.5;
  // Knee and ankle keep their excursion in a short step: the foot has to clear the ground all the same.
  const double part = std::max(1.0, 0.5 + 0.5 * amplitude);
  LegAngles angles{};
  angles.hip = (hip_mean + amplitude * (at(hip_flexion, phase) - hip_mean)) * degree;
  angles.knee = (part + 0.35 * std::max(0.0, 1 - amplitude)) * at(knee_flexion, phase) * degree;
  angles.ankle = part * at(dorsiflexion, phase) * degree;
  // Between loading and heel rise the sole lies flat, which tables of three joints, each rounded and averaged
  // by itself, give only to some degrees.
  const double fraction = phase - std::floor(phase);
  const double flat = ease(0.05, 0.12, fraction) - ease(0.36, 0.46, fraction);
  angles.ankle += flat * (angles.knee - angles.hip - angles.ankle);
  angles.toes = part * at(toe_extension, phase) * degree;
  return angles;
}

}  // namespace

/// Phase 0 is the left heel's contact. Pelvic rotation of 4 degrees and a list (half of the published 5
/// degrees) after J. B. Saunders, V. T. Inman, H. D. Eberhart, "The major determinants in normal and
/// pathological gait", J. Bone Joint Surg. 35A, 1953; thorax against pelvis and the arms' excursion after M.
/// P. Murray, A. B. Drillis, R. C. Kory, "Walking patterns of normal men", J. Bone Joint Surg. 46A, 1964, and
/// M. P. Murray, "Gait as a total pattern of movement", Am. J. Phys. Med. 46, 1967.
Motion walking(const Manner& manner, const Gait& gait) {
  return [manner, gait](double seconds) {
    const double phase = seconds * gait.strides_per_second * manner.cadence;
    const double beat = 2 * pi * phase;
    const double amplitude = gait.amplitude * manner.stride;
    const Eigen::Quaterniond heading = about_z(gait.turn_rate * seconds);
    // The body leans into a curve as far as its speed asks for.
    const double lean = -0.25 * gait.turn_rate * amplitude;

    HumanPose pose;
    const double rotation = -4 * degree * amplitude * std::cos(beat);
    const double list = 2.5 * degree * amplitude * std::sin(beat - 0.15);
    pose.pelvis.z() = manner.joints[0].z();
    pose[BodyJoint::pelvis] = heading * about_z(rotation) * about_x(list + 0.15 * lean) * about_y(3 * degree);
    const Eigen::Quaterniond thorax =
        heading * about_z(-0.9 * rotation) * about_x(-0.25 * list + lean) * about_y(3.5 * degree);
    const Eigen::Quaterniond waist = pose[BodyJoint::pelvis].conjugate() * thorax;
    pose[BodyJoint::spine] = Eigen::Quaterniond::Identity().slerp(0.5, waist);
    pose[BodyJoint::chest] = pose[BodyJoint::spine];
    const double glance = 0.5 * gait.turn_rate + 0.06 * std::sin(0.9 * seconds);
    const Eigen::Quaterniond face = thorax.conjugate() * heading * about_z(glance) * about_y(2 * degree);
    pose[BodyJoint::neck] = Eigen::Quaterniond::Identity().slerp(0.5, face);
    pose[BodyJoint::head] = pose[BodyJoint::neck];

    for (const Side side : {Side::left, Side::right}) {
      const double own = phase + (side == Side::left ? 0 : 0.5);
      LegAngles angles = leg_angles(own, amplitude);
      // The feet come closer to the line of walking than the hips are.
      angles.abduction = -1.8 * degree;
      set_leg(pose, side, angles, heading * about_z((side == Side::left ? 1 : -1) * 4 * degree));
      const double swing = std::cos(2 * pi * own);
      const double excursion = manner.arm_swing * amplitude;
      set_arm(
          pose, manner.joints, side,
          swinging_arm((-4 - 18 * excursion * swing) * degree,
                       (24 - 13 * excursion * std::cos(2 * pi * own - 0.35)) * degree, manner.arm_abduction));
    }
    return pose;
  };
}

}  // namespace bch::detail
