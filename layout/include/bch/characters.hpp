// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <bch/geometry.hpp>

namespace bch {

/// Describes a node of the skeleton. Parents precede their children.
struct Joint {
  std::string name;
  std::int32_t parent = -1;  ///< -1: a root
  Affine3 rest;              ///< the transform in the parent's frame when no clip moves the joint
  friend bool operator==(const Joint&, const Joint&) = default;
};

/// Holds a value at a time, in seconds.
template <class Value>
struct Key {
  float time;
  Value value;
};

/// Selects how values between two keys are computed.
/// Linear blends the two values (rotations spherically), step keeps the earlier one, cubic is a Hermite
/// spline through the keys with the curve's tangents.
enum class Interpolation : std::uint8_t { linear, step, cubic };

/// Describes the interpolation of positions, rotations or scales between their keys.
/// Only cubic curves have tangents, one pair per key.
template <class Value>
struct Curve {
  /// Holds the derivatives of a value at a key, per second: `in` just before the key, `out` just after it.
  struct Tangents {
    Value in, out;
  };

  Interpolation interpolation = Interpolation::linear;
  std::vector<Tangents> tangents;
};

/// Describes the motion of one joint relative to its parent, with keys in order of time.
/// Positions, rotations or scales without keys stay as in Joint::rest.
struct Channel {
  std::uint32_t joint = 0;
  std::vector<Key<Vec3>> positions;
  std::vector<Key<Quaternion>> rotations;
  std::vector<Key<Vec3>> scales;
  Curve<Vec3> position_curve;
  Curve<Quaternion> rotation_curve;  ///< cubic quaternions are normalised after they are blended
  Curve<Vec3> scale_curve;
};

/// Describes a motion of a character that begins at time 0.
struct Clip {
  std::string name;
  float seconds = 0;
  std::vector<Channel> channels;  ///< at most one per joint
};

/// Describes a bone, which moves vertices: a joint and its inverse bind matrix.
/// The matrix maps the mesh's own frame to the joint's frame in the bind pose. The bind pose may differ from
/// the rest pose (Joint::rest).
struct Bone {
  std::uint32_t joint = 0;
  Affine3 inverse_bind;
  friend bool operator==(const Bone&, const Bone&) = default;
};

/// Holds the skinning weight of one bone for a vertex (linear blend skinning).
struct Influence {
  std::uint32_t bone;
  float weight;
  friend bool operator==(const Influence&, const Influence&) = default;
};

/// Holds everything about a character that does not depend on the pose: one mesh, a skeleton, clips.
/// The meshes of a file are concatenated. A mesh without a skin follows the node that it is attached to, as
/// one bone of weight 1.
struct Character {
  std::string name;
  std::vector<Joint> joints;
  std::vector<Bone> bones;
  std::vector<Vec3> vertices;                  ///< in their mesh's frame, from which inverse_bind maps
  std::vector<std::uint32_t> influence_begin;  ///< vertices.size() + 1 offsets into influences
  std::vector<Influence> influences;           ///< weights of a vertex are positive and sum to 1
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Clip> clips;
  Affine3 to_ground;  ///< maps the file's frame to the world: metres, z up
  /// The joint whose (x, y) is a shape's origin, or -1.
  /// -1: a mesh without a skeleton, whose origin is the centre of its bounding rectangle.
  std::int32_t root_joint = -1;
};

/// Checks a character's indices, the order of joints and keys, weights, and that values are finite.
/// Errors:  throws std::invalid_argument naming the character, the place and the value.
void validate(const Character& character);

/// Names a pose of a character: a time in one of its clips, or the rest pose.
struct PoseTime {
  static constexpr std::uint32_t rest = 0xffffffff;
  std::uint32_t clip = rest;
  float seconds = 0;
};

/// Returns the poses at the middles of `count` equal intervals of the character's clips laid end to end.
/// The same arguments give the same poses on every machine. A character without clips has one pose, the rest
/// pose.
std::vector<PoseTime> sample_poses(const Character& character, std::uint32_t count);

/// Returns the built-in man: 1.88 m tall, a closed skin of about 2 850 triangles, 27 joints, 212 s of clips.
/// The clips are walking, turning, side-stepping and idling. He faces +x at rest. "Characters" in
/// layout/README.md compares him with the paper's character. All calls return the same bits.
/// Units:   metres, z up.
/// Cost:    about ten milliseconds.
Character default_male();
/// Returns the built-in woman, 1.74 m tall; see default_male().
Character default_female();
/// Returns a bulky man: default_male() with the volume of the man in the paper's table 1, about 0.137 m3.
Character default_bulky_male();

/// Selects the sex of a pedestrian's body.
enum class Sex { female, male };

/// Returns a pedestrian for recorded and simulated crowds: the built-in man or woman of a given stature.
/// Clip k is one stride (two steps) at k * 0.03 m/s, k = 0 to 73, and loops seamlessly. The shape's origin is
/// the point below the head, which is what cameras track. `shoulders` rotates the line through the shoulders,
/// counter-clockwise, from the perpendicular to the walking direction. "Characters" in layout/README.md has
/// the gait and its sources.
/// Units:   metres, radians; the stature is from 0.8 to 2.4, the rotation from -1 to 1.
/// Errors:  throws std::invalid_argument if the stature or the rotation is out of range.
Character default_pedestrian(Sex sex, double stature, double shoulders = 0);

/// Returns how many strides of two steps a pedestrian takes per second at a walking speed.
double pedestrian_strides_per_second(double metres_per_second);

}  // namespace bch
