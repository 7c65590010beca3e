// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include <bch/character.hpp>
#include <bch/geometry.hpp>

namespace bch {

/// Maps a point as Affine3 does, in double: a joint's transform keeps all digits on its way through the skeleton.
struct Affine3d {
  double rows[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  friend bool operator==(const Affine3d&, const Affine3d&) = default;
};

/// Refers to affine maps in memory of the caller, of float or double, as rows or as columns.
class Transforms {
 public:
  /// Refers to a contiguous range of Affine3 or Affine3d.
  template <class Range>
  requires std::convertible_to<const Range&, std::span<const Affine3>> Transforms(const Range& maps)
      : Transforms(of(std::span<const Affine3>(maps))) {}
  template <class Range>
  requires std::convertible_to<const Range&, std::span<const Affine3d>> Transforms(const Range& maps)
      : Transforms(of(std::span<const Affine3d>(maps))) {}

  /// Refers to maps written row by row: three rows of four numbers. A map begins `stride` numbers after the one before: 16, where a
  /// fourth row follows.
  template <std::floating_point Number>
  static Transforms row_major(const Number* first, std::size_t count, std::size_t stride = 12) {
    return {first, count, stride, 4, 1, std::same_as<Number, double>};
  }
  /// Refers to 4x4 matrices written column by column, as OpenGL, glTF, glm and Eigen keep them.
  template <std::floating_point Number>
  static Transforms column_major(const Number* first, std::size_t count, std::size_t stride = 16) {
    return {first, count, stride, 1, 4, std::same_as<Number, double>};
  }

  std::size_t size() const noexcept { return count_; }
  Affine3d operator[](std::size_t i) const noexcept;

 private:
  Transforms(const void* first, std::size_t count, std::size_t stride, std::size_t row, std::size_t column,
             bool is_double) noexcept
      : first_(first), count_(count), stride_(stride), row_(row), column_(column), is_double_(is_double) {}
  template <class Map>
  static Transforms of(std::span<const Map> maps) {
    return row_major(maps.empty() ? nullptr : maps[0].rows[0], maps.size());
  }

  const void* first_;
  std::size_t count_;
  std::size_t stride_, row_,
      column_;  ///< in numbers: from map to map, from row to row, from column to column
  bool is_double_;
};

/// Poses a character by the transforms of all joints, each in the frame of its parent, and of a joint without parent in the
/// character's own frame, which Character::to_ground maps to the ground.
struct LocalPose {
  Transforms joints;
};

/// Poses a character by the transforms of all joints to the ground: metres, z up. As by a clip, the root joint's point on the ground
/// becomes the origin of the shape.
struct WorldPose {
  Transforms joints;
};

/// Poses a character by the bone matrices of a renderer, in the order of Character::bones: each is the transform of a bone's joint to the
/// ground times the bone's inverse_bind.
struct SkinningPalette {
  Transforms bones;
  /// Names the point on the ground that becomes the origin of the shape. A character without a root joint has the middle of its
  /// rectangle there in any case.
  double x = 0, y = 0;
};

/// Poses a character by where all its vertices are: metres, z up, relative to the origin of the shape.
struct PosedVertices {
  std::span<const Vec3> positions;
};

/// Names a pose in one of the ways above, or by a time in a clip. It refers to the caller's arrays and is used before they change.
class Pose {
 public:
  using Kinds = std::variant<PoseTime, LocalPose, WorldPose, SkinningPalette, PosedVertices>;

  Pose() = default;  ///< the rest pose
  Pose(std::uint32_t clip, float seconds) : kind_(PoseTime{clip, seconds}) {}
  template <class Kind>
  requires(std::same_as<Kind, PoseTime> || std::same_as<Kind, LocalPose> || std::same_as<Kind, WorldPose> ||
           std::same_as<Kind, SkinningPalette> || std::same_as<Kind, PosedVertices>) Pose(const Kind& kind)
      : kind_(kind) {}

  const Kinds& kind() const noexcept { return kind_; }

 private:
  Kinds kind_;
};

/// Names a pose of a clip and its share in a blend.
struct WeightedPose {
  PoseTime at;
  float weight = 1;
};

/// Selects the frame of joint transforms: that of LocalPose or of WorldPose.
enum class JointFrame : std::uint8_t { parent, world };

/// Returns the index of the joint of a name.
/// Errors:  throws std::invalid_argument where no joint or more than one has it.
std::uint32_t find_joint(const Character& character, std::string_view name);

// A PoseShaper has functions of these names that keep their memory.

/// Returns the transforms of all joints at a time of a clip. As a LocalPose or a WorldPose they give the clip's shape, bit for bit.
/// Errors:  throws std::invalid_argument on a clip or a time that does not exist.
std::vector<Affine3d> joint_transforms(const Character& character, PoseTime at,
                                       JointFrame frame = JointFrame::parent);

/// Returns the joint transforms of a mean of poses, in the frames of the parents. Positions and scales are weighted means; rotations
/// are normalised weighted sums of quaternions, each with the sign that is nearer to the sum before it. Weights need not sum to 1.
/// Errors:  throws std::invalid_argument on a weight below 0 or not finite, no weight above 0, a clip or a time that does not exist.
std::vector<Affine3d> blend(const Character& character, std::span<const WeightedPose> poses);

/// Returns the positions of all vertices in a pose: metres, z up, relative to the origin of the shape.
/// Errors:  as PoseShaper::shape().
std::vector<Vec3> pose_vertices(const Character& character, const Pose& pose);

}  // namespace bch
