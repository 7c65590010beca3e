// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <vector>

#include "layout/default_character/body_joints.hpp"

namespace bch::detail {

/// Represents a closed curve around trunk, neck or head, symmetric to the plane y = 0. Heights are fractions of the
/// stature, lengths metres. The height runs from front over side to back, since a jaw or a collar is not
/// level.
struct TrunkSection {
  double front_height, side_height, back_height;
  double half_breadth;
  double front, back;    ///< distance of the curve from the z axis, both positive
  double roundness = 1;  ///< exponent of the superellipse: 1 an ellipse, less is squarer
  double taper = 0;      ///< part of the breadth that is lost towards the front
  BodyJoint joint = BodyJoint::pelvis;
};

/// Represents a closed curve around an arm or a leg, across its axis: four half axes in metres.
struct LimbSection {
  double along;  ///< arm: metres from the shoulder; leg: height as a fraction of the stature
  double front, back, outer, inner;
  BodyJoint joint;
  BodyJoint next;  ///< the joint whose weight is `mix`
  double mix = 0;
  double forward = 0;  ///< offset of the middle along +x
};

/// Represents a closed curve around a foot, standing on it: from its point on the instep to its point on the sole.
struct FootSection {
  double top_x, top_z, sole_x, sole_z;
  double outer, inner;
  double toes;  ///< weight of the toe joint
};

/// Represents a bulge of the skin: vertices near `centre` move along `by`, falling off as a Gaussian.
struct Bulge {
  Eigen::Vector3d centre, by;  ///< on the left side; the right side mirrors it
  Eigen::Vector3d spread;      ///< standard deviations along x, y, z
};

/// Measures of a person. All that differs between two parametric bodies is in here.
struct BodyShape {
  double stature;
  double shoulder_half_breadth, hip_half_breadth;  ///< between the centres of the joints
  double upper_arm, forearm, hand, foot;           ///< lengths
  double arm_angle;                                ///< between the arm at rest and the vertical, radians
  std::vector<TrunkSection> trunk;                 ///< from the hips up to the crown
  std::vector<LimbSection> arm;                    ///< from the shoulder down to the wrist
  std::vector<LimbSection> leg;                    ///< from the hip down to the ankle
  std::vector<FootSection> feet;                   ///< from the heel to the toes
  std::vector<Bulge> bulges;
};

/// Sections of `trunk` that border the arm's hole, and the columns of its front and back edge.
inline constexpr std::size_t arm_hole_bottom = 8, arm_hole_top = 10;
inline constexpr std::size_t arm_hole_front = 3, arm_hole_back = 7;

/// Returns a man of 1.88 m, a woman of 1.74 m, and a bulky man as tall as the first.
/// Source:  lengths of segments are the fractions of the stature by R. Drillis, R. Contini, "Body segment
///          parameters", NYU TR 1166.03, 1966, as reprinted in D. A. Winter, "Biomechanics and Motor Control
///          of Human Movement". Breadths and depths are drawn by hand, of the size that C. C. Gordon et al.,
///          "2012 Anthropometric Survey of U.S. Army Personnel" (ANSUR II), NATICK/TR-15/007, reports for
///          tall men and women. The bulky man is drawn to a volume instead: see default_bulky_male().
BodyShape male_shape();
BodyShape female_shape();
BodyShape bulky_male_shape();

JointPositions joint_positions(const BodyShape& shape);

}  // namespace bch::detail
