// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/default_character/parametric_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bch::detail {
namespace {

using enum BodyJoint;
using Eigen::Vector3d;
using Loop = BodySurface::Loop;

using std::numbers::pi;
constexpr std::size_t trunk_columns = 11;  // of the left half, both ends on the plane y = 0
constexpr std::size_t leg_corners = 14;    // the trunk's columns and three corners of the crotch
constexpr std::size_t arm_corners = 12;    // the corners of the arm's hole: 4 by 2 quads

SkinTag tag(BodyJoint joint, double softness = 0) {
  return {joint_index(joint), joint_index(joint), 0, softness};
}

double signed_power(double value, double exponent) {
  return std::copysign(std::pow(std::abs(value), exponent), value);
}

/// A curve with a half axis of its own in each of four directions.
struct Oval {
  Vector3d middle, front, back, outer, inner;

  /// The angle runs from the front over the outer side.
  Vector3d at(double angle) const {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return middle + (c > 0 ? c * front : -c * back) + (s > 0 ? s * outer : -s * inner);
  }
};

Vector3d trunk_point(const TrunkSection& s, double stature, std::size_t column) {
  const double angle = pi * static_cast<double>(column) / (trunk_columns - 1);
  const bool midline = column == 0 || column + 1 == trunk_columns;
  const double c = midline ? (column == 0 ? 1.0 : -1.0) : std::cos(angle);
  const double breadth = midline ? 0.0 : std::pow(std::sin(angle), s.roundness);
  const double end = c > 0 ? s.front_height : s.back_height;
  return {(c > 0 ? s.front : s.back) * signed_power(c, s.roundness),
          s.half_breadth * breadth * (1 - s.taper * std::max(c, 0.0)),
          stature * (s.side_height + (end - s.side_height) * c * c)};
}

/// Sections near the roots of arms and legs are drawn by hand only roughly; smoothing joins them.
double trunk_softness(std::size_t section, std::size_t column) {
  if (section <= 2) return 0.6 - 0.2 * static_cast<double>(section);
  const bool shoulder = section + 1 >= arm_hole_bottom && section <= arm_hole_top + 2;
  if (!shoulder) return 0;
  return column >= arm_hole_front - 1 && column <= arm_hole_back + 1 ? 0.6 : 0.2;
}

std::vector<Loop> add_trunk(BodySurface& surface, const BodyShape& shape) {
  std::vector<Loop> rings;
  for (std::size_t i = 0; i < shape.trunk.size(); ++i) {
    Loop ring;
    for (std::size_t column = 0; column < trunk_columns; ++column) {
      const bool in_hole =
          i > arm_hole_bottom && i < arm_hole_top && column > arm_hole_front && column < arm_hole_back;
      const Vector3d p = trunk_point(shape.trunk[i], shape.stature, column);
      BodyJoint joint = shape.trunk[i].joint;
      if (joint == clavicle && column != std::clamp(column, arm_hole_front - 1, arm_hole_back + 1))
        joint = chest;
      ring.push_back(in_hole ? 0 : surface.add(p, tag(joint, trunk_softness(i, column))));
    }
    if (i > 0) {
      const bool hole = i > arm_hole_bottom && i <= arm_hole_top;
      surface.strip(rings.back(), ring, false, hole ? arm_hole_front : 0, hole ? arm_hole_back : 0);
    }
    rings.push_back(ring);
  }
  const std::uint32_t crown = surface.add({0.004, 0, shape.stature}, tag(head));
  const Loop& last = rings.back();
  for (std::size_t i = 0; i + 1 < last.size(); ++i)
    surface.faces.push_back({last[i], last[i + 1], crown, crown});
  return rings;
}

Oval foot_section(const BodyShape& shape, const FootSection& s, const Vector3d& ankle_at) {
  const double toe_out = 0.07;
  const Vector3d top(ankle_at.x() + s.top_x, ankle_at.y() + toe_out * s.top_x, s.top_z);
  const Vector3d sole(ankle_at.x() + s.sole_x, ankle_at.y() + toe_out * s.sole_x, s.sole_z);
  // The great toe, on the inner side, reaches farther than the little one.
  const double slant = s.toes > 0.5 ? 0.014 * shape.foot / 0.286 : 0.0;
  return {(top + sole) / 2, (top - sole) / 2, (sole - top) / 2, Vector3d(-slant, s.outer, 0),
          Vector3d(slant, -s.inner, 0)};
}

/// A foot's sole is flat and nearly as wide as its ball, where an oval would touch the ground in a line.
Vector3d foot_point(const Oval& oval, double angle) {
  const double c = signed_power(std::cos(angle), std::cos(angle) < 0 ? 0.5 : 1.0);
  const double s = signed_power(std::sin(angle), std::cos(angle) < 0 ? 0.8 : 1.0);
  return oval.middle + (c > 0 ? c * oval.front : -c * oval.back) + (s > 0 ? s * oval.outer : -s * oval.inner);
}

double leg_angle(std::size_t corner) {
  return pi / 2 + 2 * pi * (static_cast<double>(corner) - (trunk_columns - 1) / 2.0) / leg_corners;
}

void add_leg(BodySurface& surface, const BodyShape& shape, const Loop& hips) {
  const JointPositions joints = joint_positions(shape);
  const Vector3d front = surface.positions[hips.front()];
  const Vector3d back = surface.positions[hips.back()];
  Loop above = hips;
  for (const double fraction : {0.75, 0.5, 0.25}) {
    Vector3d p = front + fraction * (back - front);
    p.z() = shape.stature * (0.466 - 0.006 * std::sin(pi * fraction));
    above.push_back(surface.add(p, tag(pelvis, 0.5)));
  }
  for (std::size_t i = 0; i < shape.leg.size(); ++i) {
    const LimbSection& s = shape.leg[i];
    const Vector3d middle(s.forward, shape.hip_half_breadth, s.along * shape.stature);
    const Oval oval{middle, Vector3d(s.front, 0, 0), Vector3d(-s.back, 0, 0), Vector3d(0, s.outer, 0),
                    Vector3d(0, -s.inner, 0)};
    Loop ring;
    for (std::size_t corner = 0; corner < leg_corners; ++corner)
      ring.push_back(
          surface.add(oval.at(leg_angle(corner)), {joint_index(s.joint), joint_index(s.next), s.mix,
                                                   i == 0   ? 0.5
                                                   : i == 1 ? 0.25
                                                            : 0}));
    surface.strip(ring, above, true);
    above = ring;
  }
  for (const FootSection& s : shape.feet) {
    const Oval oval = foot_section(shape, s, joints[joint_index(ankle)]);
    Loop ring;
    for (std::size_t corner = 0; corner < leg_corners; ++corner)
      ring.push_back(surface.add(foot_point(oval, leg_angle(corner)),
                                 {joint_index(ankle), joint_index(toes), s.toes, 0}));
    surface.strip(ring, above, true);
    above = ring;
  }
  std::reverse(above.begin(), above.end());
  // Turned so that the cap's quads run across the toes, from the instep to the sole.
  std::rotate(above.begin(), above.begin() + 5, above.end());
  surface.cap(above);
}

/// The corners of the arm's hole from the top over the front, the arm pit and the back.
Loop arm_hole(const std::vector<Loop>& trunk) {
  const Loop& bottom = trunk[arm_hole_bottom];
  const Loop& middle = trunk[arm_hole_bottom + 1];
  const Loop& top = trunk[arm_hole_top];
  Loop hole{top[5], top[4], top[3], middle[arm_hole_front]};
  for (std::size_t column = arm_hole_front; column <= arm_hole_back; ++column) hole.push_back(bottom[column]);
  hole.insert(hole.end(), {middle[arm_hole_back], top[7], top[6]});
  return hole;
}

/// An arm points along `along`; `outer` is the side of the back of the hand.
struct ArmFrame {
  Vector3d shoulder_at, along, outer;
};

Loop arm_ring(BodySurface& surface, const ArmFrame& frame, const LimbSection& s, double tilt,
              const SkinTag& skin) {
  const Vector3d middle = frame.shoulder_at + s.along * frame.along;
  const Vector3d outer = (frame.outer - std::tan(tilt) * frame.along);
  const Oval oval{middle, Vector3d(s.front, 0, 0), Vector3d(-s.back, 0, 0), s.outer * outer,
                  -s.inner * outer};
  Loop ring;
  for (std::size_t corner = 0; corner < arm_corners; ++corner)
    ring.push_back(surface.add(oval.at(pi / 2 - 2 * pi * static_cast<double>(corner) / arm_corners), skin));
  return ring;
}

/// Palm, four fingers and a thumb below the wrist. The fingers are a little bent, as in a hand at ease.
void add_hand(BodySurface& surface, const BodyShape& shape, const ArmFrame& frame, const Loop& wrist_ring) {
  const double unit = shape.hand / 0.203;  // lengths below are of the man's hand
  const double start = shape.upper_arm + shape.forearm;
  const auto palm = [&](double along, double half_width, double half_thickness, BodyJoint joint) {
    const LimbSection s{start + along * unit,
                        half_width * unit,
                        half_width * unit,
                        half_thickness * unit,
                        half_thickness * unit,
                        joint,
                        joint};
    return arm_ring(surface, frame, s, 0, tag(joint));
  };
  const Loop heel = palm(0.026, 0.036, 0.019, wrist);
  const Loop middle = palm(0.062, 0.043, 0.018, wrist);
  const Loop knuckles = palm(0.102, 0.044, 0.015, wrist);
  surface.strip(wrist_ring, heel, true);
  surface.strip(heel, middle, true, 2, 4);
  surface.strip(middle, knuckles, true);

  const Loop thumb{heel[2], heel[3], heel[4], middle[4], middle[3], middle[2]};
  const Vector3d x = Vector3d::UnitX();
  Loop tip = surface.extrude(thumb, unit * (0.022 * x + 0.018 * frame.along - 0.006 * frame.outer), 0.72,
                             tag(wrist));
  tip =
      surface.extrude(tip, unit * (0.012 * x + 0.036 * frame.along - 0.008 * frame.outer), 0.62, tag(wrist));
  surface.cap(tip);

  const Loop& k = knuckles;
  const std::array<Loop, 4> roots{Loop{k[1], k[2], k[3], k[4], k[5]}, Loop{k[0], k[1], k[5], k[6]},
                                  Loop{k[11], k[0], k[6], k[7]}, Loop{k[7], k[8], k[9], k[10], k[11]}};
  const std::array<double, 4> lengths{0.088, 0.098, 0.090, 0.070};
  const std::array<double, 4> spread{0.10, 0.03, -0.04, -0.11};
  for (std::size_t f = 0; f < roots.size(); ++f) {
    const Vector3d straight = frame.along + spread[f] * x;
    const double length = unit * lengths[f];
    tip = surface.extrude(roots[f], 0.52 * length * (straight - 0.16 * frame.outer).normalized(), 0.82,
                          tag(fingers));
    tip = surface.extrude(tip, 0.48 * length * (straight - 0.42 * frame.outer).normalized(), 0.66,
                          tag(fingers));
    surface.cap(tip);
  }
}

void add_arm(BodySurface& surface, const BodyShape& shape, const std::vector<Loop>& trunk) {
  const double a = shape.arm_angle;
  const ArmFrame frame{joint_positions(shape)[joint_index(shoulder)], Vector3d(0, std::sin(a), -std::cos(a)),
                       Vector3d(0, std::cos(a), std::sin(a))};
  Loop before = arm_hole(trunk);
  for (std::size_t i = 0; i < shape.arm.size(); ++i) {
    const LimbSection& s = shape.arm[i];
    // The first rings lean from the upright hole in the trunk towards the arm's own direction.
    const double tilt = i == 0 ? 0.45 : i == 1 ? 0.2 : 0.0;
    const Loop ring = arm_ring(surface, frame, s, tilt,
                               {joint_index(s.joint), joint_index(s.next), s.mix,
                                i == 0   ? 0.5
                                : i == 1 ? 0.25
                                         : 0});
    surface.strip(before, ring, true);
    before = ring;
  }
  add_hand(surface, shape, frame, before);
}

void bulge(BodySurface& surface, const std::vector<Bulge>& bulges) {
  for (Vector3d& p : surface.positions) {
    Vector3d moved = p;
    for (const Bulge& b : bulges) {
      const double distance = (p - b.centre).cwiseQuotient(b.spread).squaredNorm();
      moved += std::exp(-0.5 * distance) * b.by;
    }
    if (p.y() == 0) moved.y() = 0;
    p = moved;
  }
}

}  // namespace

BodySurface parametric_body(const BodyShape& shape) {
  BodySurface left;
  const std::vector<Loop> trunk = add_trunk(left, shape);
  add_leg(left, shape, trunk.front());
  add_arm(left, shape, trunk);
  bulge(left, shape.bulges);
  BodySurface body = mirrored(left);
  smooth(body, 3);
  return body;
}

}  // namespace bch::detail
