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
  Affine3 rest;              ///< the transform in the parent's frame, where a clip does not move the joint
  friend bool operator==(const Joint&, const Joint&) = default;
};

/// Holds a value at a time, which is in seconds.
template <class Value>
struct Key {
  float time;
  Value value;
};

/// Selects how values between two keys are computed: linear blends them (rotations spherically), step keeps the earlier
/// one, cubic is a Hermite spline through the keys with the curve's tangents.
enum class Interpolation : std::uint8_t { linear, step, cubic };

/// Describes the interpolation of one part of a channel between its keys. Only cubic has tangents, one pair per key.
template <class Value>
struct Curve {
  /// Holds the derivatives of a value at a key, per second: `in` just before the key, `out` just after it.
  struct Tangents {
    Value in, out;
  };

  Interpolation interpolation = Interpolation::linear;
  std::vector<Tangents> tangents;
};

/// Describes the motion of one joint relative to its parent, with keys in order of time. A part without keys stays as it is in the
/// joint's rest transform.
struct Channel {
  std::uint32_t joint = 0;
  std::vector<Key<Vec3>> positions;
  std::vector<Key<Quaternion>> rotations;
  std::vector<Key<Vec3>> scales;
  Curve<Vec3> position_curve;
  Curve<Quaternion> rotation_curve;  ///< cubic quaternions are normalised after they are blended
  Curve<Vec3> scale_curve;
};

/// Describes a motion of a character, from time 0 on.
struct Clip {
  std::string name;
  float seconds = 0;
  std::vector<Channel> channels;  ///< at most one per joint
};

/// Describes a bone, which moves vertices: a joint, and its inverse bind matrix, from the mesh's own frame into the joint's frame in the
/// bind pose, which may differ from Joint::rest.
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
/// The meshes of a file are concatenated; a mesh that is only attached to a node follows one bone of
/// weight 1.
struct Character {
  std::string name;
  std::vector<Joint> joints;
  std::vector<Bone> bones;
  std::vector<Vec3> vertices;                  ///< in the spaces that the bones' inverse_bind map from
  std::vector<std::uint32_t> influence_begin;  ///< vertices.size() + 1 offsets into influences
  std::vector<Influence> influences;           ///< weights of a vertex are positive and sum to 1
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Clip> clips;
  Affine3 to_ground;  ///< maps the file's frame to the world: metres, z up
  /// Selects the joint whose (x, y) is a shape's origin. -1: a mesh without skeleton, whose origin is the centre of its
  /// bounding rectangle.
  std::int32_t root_joint = -1;
};

/// Checks all that the types above promise: indices, order of joints and keys, finite values, unit quaternions, tangents, weights.
/// Errors:  throws std::invalid_argument naming the character, the place and the value.
void validate(const Character& character);

/// Names a pose of a character: a time in one of its clips, or the rest pose.
struct PoseTime {
  static constexpr std::uint32_t rest = 0xffffffff;
  std::uint32_t clip = rest;
  float seconds = 0;
};

/// Returns the poses at the middles of `count` equal intervals of the character's clips laid end to end. The same
/// arguments give the same poses everywhere. A character without clips has one pose, the rest pose.
std::vector<PoseTime> sample_poses(const Character& character, std::uint32_t count);

/// Returns the built-in man. He is 1.88 m tall, the woman of default_female() 1.74 m. Each is one
/// closed skin of about 2 850 triangles with 27 joints and 212 s of walking, turning, side-stepping and idling. They stand
/// in for the two characters of the paper's table 1 and were tuned to its statistics: the smallest disc around a pose seen
/// from above has a mean radius of 0.42 m (man) and 0.34 m (woman) and a deviation of about 0.05 m.
///
/// Units:   metres, z up, facing +x at rest. Each call takes about ten milliseconds and returns the same bits.
///
/// Source:  body and motion after published measures (see layout/default_character: body_shape.hpp, walking.cpp, stepping.cpp,
///          idling.cpp); the paper is Stuvel et al., "Hierarchical structures for collision checking between
///          virtual characters", Computer Animation and Virtual Worlds 25, 2014.
Character default_male();
/// Returns the built-in woman; see default_male().
Character default_female();
/// Returns a bulky man. He is like default_male(), but with the volume that the means of the paper's table 1 imply for its man,
/// about 0.137 m3.
Character default_bulky_male();

/// Selects the sex of a pedestrian's body.
enum class Sex { female, male };

/// Returns a pedestrian for recorded and simulated crowds: the built-in man or woman of a given stature. The pedestrian walks at every
/// speed and keeps the arms close. The shape's origin is the point below the head, which is what cameras track. Clip k is one stride (two
/// steps) at 0.03 k m/s, k = 0 to 73: it begins and ends with the left heel's contact, in the same pose, and can be repeated. The step
/// frequency is 1.3 Hz + 0.5 Hz per m/s: about 2 Hz and 0.7 m at 1.4 m/s. The step length goes to 0 with the speed. `shoulders` is the turn
/// of the shoulder line from square to the walking direction, counter-clockwise: people turn them when they pass each other closely.
/// Units:   metres, radians; a stature from 0.8 to 2.4, a turn from -1 to 1.
/// Source:  A. Pachi, T. Ji, "Frequency and velocity of people walking", The Structural Engineer 83, 2005 (2.0 Hz at 1.4 m/s, steps of
///          0.75 m of men and 0.67 m of women); A. Jelic, C. Appert-Rolland, S. Lemercier, J. Pettre, "Properties of pedestrians
///          walking in line: stepping behavior", Phys. Rev. E 86, 2012 (in lines, step lengths are proportional to the speed, and
///          durations vary much less).
/// Errors:  throws std::invalid_argument on another stature or turn.
Character default_pedestrian(Sex sex, double stature, double shoulders = 0);

/// Returns the number of strides, of two steps each, that a pedestrian takes in a second.
double pedestrian_strides_per_second(double metres_per_second);

}  // namespace bch
