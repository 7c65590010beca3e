// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <numbers>

#include "layout/default_character/motion_clip.hpp"

namespace bch::detail {

constexpr double degree = std::numbers::pi / 180;

/// Says how a person moves, in addition to the lengths of the bones. Angles in radians, lengths in metres.
struct Manner {
  JointPositions joints;
  double stature;
  double stride;         ///< scales the excursion of the hips in walking; 1 is the published one
  double cadence;        ///< scales the strides a second
  double arm_abduction;  ///< of a hanging arm, so that it passes the hips
  double arm_swing;      ///< scales the excursion of the arms
  double foot_spacing;   ///< between the ankles when standing
  double gesture;        ///< how far hands go from the body when talking or waving: 1 is ordinary
};

struct Gait {
  double strides_per_second;
  double amplitude;      ///< scales hip and arms against natural walking
  double turn_rate = 0;  ///< of the heading, radians a second, counter-clockwise
};

Motion walking(const Manner& manner, const Gait& gait);

/// Describes walking at a speed, from standing to a fast walk, by where the feet are: one on the ground stays where it is.
struct Stride {
  double speed;  ///< metres a second
  double strides_per_second;
  double shoulders =
      0;  ///< how far they are turned against the direction of walking, radians, counter-clockwise
};
Motion striding(const Manner& manner, const Stride& stride);

/// Returns a motion of steps about the own axis; `direction` is 1 to the left, -1 to the right.
Motion turning(const Manner& manner, double direction);
Motion side_stepping(const Manner& manner, double direction);

enum class Idle { shift, search_around, akimbo, arms_crossed, phone, wave, talk, think };
Motion idling(const Manner& manner, Idle kind);

/// Returns a natural stance for arms, common to all standing motions.
ArmPose hanging_arm(const Manner& manner);

/// Returns 0 before `begin`, 1 after `end`, and a smooth way between.
double ease(double begin, double end, double t);

}  // namespace bch::detail
