// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cmath>
#include <numbers>

#include "layout/parametric_motion.hpp"

namespace bch {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;

/// An angle over one stride, from heel contact to the next heel contact of the same foot, at every 5 %.
using Curve = std::array<double, 20>;

// Mean sagittal angles in degrees at natural cadence, read to about a degree from the tables of D. A. Winter,
// "The biomechanics and motor control of human gait", 2nd ed., 1991: hip flexion, knee flexion,
// dorsiflexion of the ankle. The extension of the toes while the heel rises is set against the foot's pitch.
constexpr Curve hip_flexion{20.5, 19.5,  16.5, 13,  9,   5,  1.5,  -2,   -5.5, -9,
                            -11,  -10.5, -6,   1.5, 9.5, 16, 20.5, 22.5, 22,   21};
constexpr Curve knee_flexion{4,  10, 16, 20, 19, 16,   12, 8.5, 7,  8.5,
                             14, 24, 38, 53, 63, 63.5, 55, 40,  22, 7.5};
constexpr Curve dorsiflexion{0,   -4.5, -5,  -1.5, 2,   4.5, 6.5, 8, 9.3, 9.5,
                             6.5, -2,   -13, -19,  -15, -8,  -3,  0, 1.5, 1};
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

LegAngles leg_angles(double phase, double reach) {
  const double hip_mean = 5.5;
  // Knee and ankle follow the hip's excursion only in part: a short step still clears the ground.
  const double part = 0.5 + 0.5 * reach;
  LegAngles angles{};
  angles.hip = (hip_mean + reach * (at(hip_flexion, phase) - hip_mean)) * degree;
  angles.knee = part * at(knee_flexion, phase) * degree;
  angles.ankle = part * at(dorsiflexion, phase) * degree;
  angles.toes = part * at(toe_extension, phase) * degree;
  return angles;
}

}  // namespace

/// Phase 0 is the left heel's contact. Pelvic rotation of 4 degrees and list of 4 degrees after J. B.
/// Saunders, V. T. Inman, H. D. Eberhart, "The major determinants in normal and pathological gait", J. Bone
/// Joint Surg. 35A, 1953; thorax against pelvis and the arms' excursion after M. P. Murray, A. B. Drillis, R.
/// C. Kory, "Walking patterns of normal men", J. Bone Joint Surg. 46A, 1964, and M. P. Murray, "Gait as a
/// total pattern of movement", Am. J. Phys. Med. 46, 1967.
Motion walking(const Manner& manner, const Gait& gait) {
  return [manner, gait](double seconds) {
    const double phase = seconds * gait.strides_per_second * manner.cadence;
    const double beat = 2 * pi * phase;
    const double reach = gait.reach * manner.stride;
    const Eigen::Quaterniond heading = about_z(gait.turn_rate * seconds);
    // The body leans into a curve as far as its speed asks for.
    const double lean = -0.25 * gait.turn_rate * reach;

    HumanPose pose;
    const double rotation = -4.5 * degree * reach * std::cos(beat);
    const double list = 4 * degree * reach * std::sin(beat - 0.15);
    pose.pelvis.z() = manner.joints[0].z();
    pose[BodyJoint::pelvis] = heading * about_z(rotation) * about_x(list + 0.4 * lean) * about_y(3 * degree);
    const Eigen::Quaterniond thorax =
        heading * about_z(-0.9 * rotation) * about_x(-0.25 * list + 0.6 * lean) * about_y(3.5 * degree);
    const Eigen::Quaterniond waist = pose[BodyJoint::pelvis].conjugate() * thorax;
    pose[BodyJoint::spine] = Eigen::Quaterniond::Identity().slerp(0.5, waist);
    pose[BodyJoint::chest] = pose[BodyJoint::spine];
    const double glance = 0.5 * gait.turn_rate + 0.06 * std::sin(0.9 * seconds);
    const Eigen::Quaterniond face = thorax.conjugate() * heading * about_z(glance) * about_y(2 * degree);
    pose[BodyJoint::neck] = Eigen::Quaterniond::Identity().slerp(0.5, face);
    pose[BodyJoint::head] = pose[BodyJoint::neck];

    for (const Side side : {Side::left, Side::right}) {
      const double own = phase + (side == Side::left ? 0 : 0.5);
      LegAngles angles = leg_angles(own, reach);
      // The feet come closer to the line of walking than the hips are.
      angles.abduction = -1.8 * degree;
      set_leg(pose, side, angles, heading * about_z((side == Side::left ? 1 : -1) * 4 * degree));
      const double swing = std::cos(2 * pi * own);
      const double excursion = manner.arm_swing * reach;
      set_arm(
          pose, manner.joints, side,
          swinging_arm((-4 - 18 * excursion * swing) * degree,
                       (24 - 13 * excursion * std::cos(2 * pi * own - 0.35)) * degree, manner.arm_abduction));
    }
    return pose;
  };
}

}  // namespace bch
