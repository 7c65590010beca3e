// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <numbers>
#include <vector>

#include <bch/geometry.hpp>
#include <bch/pose.hpp>

namespace bch {

/// Describes the axes and units of another program, by the way to ours: x forwards, y to the left, z up, metres, headings in radians,
/// counter-clockwise.
///
///     agents.x[i] = unity_axes.position(at.x, at.y, at.z)[0];
///     shaper.shape(WorldPose{unity_axes.transforms(Transforms::column_major(matrices, joints))});
struct AxisSystem {
  double rows[3][3];  ///< rows * (x, y, z) is one of its points along our axes, in its unit
  double metres = 1;  ///< in its unit of length
  double yaw = 1;     ///< in its unit of turns about the vertical, radians counter-clockwise

  /// Returns Character::to_ground of a character whose vertices and joints are in these axes: its LocalPose needs no conversion.
  Affine3 to_ground() const;
  Vec3 point(const Vec3& theirs) const;
  std::array<double, 3> position(double x, double y, double z) const;
  double heading(double theirs) const { return yaw * theirs; }
  /// Returns a transform between two frames that both change to our axes.
  Affine3d transform(const Affine3d& theirs) const;
  std::vector<Affine3d> transforms(const Transforms& theirs) const;
};

/// Unity: y up, z forwards, left-handed, metres; degrees about y, clockwise seen from above.
inline constexpr AxisSystem unity_axes{{{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}}, 1, -std::numbers::pi / 180};
/// Unreal: z up, x forwards, left-handed, centimetres; degrees about z, clockwise seen from above.
inline constexpr AxisSystem unreal_axes{{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}, 0.01, -std::numbers::pi / 180};
/// glTF: y up, z forwards, right-handed, metres; radians.
inline constexpr AxisSystem gltf_axes{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
/// Godot: y up, nodes look along -z, right-handed, metres; radians. A model of a glTF file looks along z there, as by gltf_axes.
inline constexpr AxisSystem godot_axes{{{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}}};
/// ROS (REP 103): our own axes and units.
inline constexpr AxisSystem ros_axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Returns Character::to_ground times maps: a WorldPose or a SkinningPalette from joints or bone matrices that a program computes in
/// the character's own frame.
std::vector<Affine3d> grounded(const Character& character, const Transforms& maps);

}  // namespace bch
