// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "kernel/c_api/objects.hpp"

namespace bch::c_api {

/// Returns the shape that a shape builder made last.
inline const Shape& made_by(const bch_shape_builder& shape_builder) {
  if (shape_builder.made == nullptr) throw Failure(BCH_INVALID_ARGUMENT, "shape_builder has made no shape");
  return *shape_builder.made;
}

/// Checks that a character has the clip of a pose.
inline void check_pose(const Character& character, const bch_pose& pose, std::size_t i) {
  if (pose.clip != BCH_REST_POSE && pose.clip >= character.clips.size())
    throw Failure(BCH_OUT_OF_RANGE, "poses[" + std::to_string(i) + "].clip is " + std::to_string(pose.clip) +
                                        " of " + std::to_string(character.clips.size()));
}

/// Checks that a character has the clips of all poses.
inline void check_poses(const Character& character, std::span<const bch_pose> poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) check_pose(character, poses[i], i);
}

/// Returns a time of a clip as a pose.
inline Pose pose_of(const bch_pose& pose) {
  return {pose.clip, pose.seconds};
}

/// Holds poses of the caller's own.
class CustomPoses {
 public:
  /// Errors:  throws Failure naming the member, where `poses` of them cannot be in memory.
  CustomPoses(const bch_pose_arrays* given, std::size_t poses);
  Pose operator[](std::size_t i) const;

 private:
  bch_pose_arrays arrays_;
  std::size_t stride_;  ///< in numbers
};

/// Makes the shape of a pose.
/// Errors:  names the pose.
inline const Shape& shape_of_pose(ShapeBuilder& shape_builder, const Pose& pose, std::size_t i) {
  try {
    return shape_builder.shape(pose);
  } catch (const std::logic_error& error) {
    const bool large = dynamic_cast<const std::length_error*>(&error) != nullptr;
    throw Failure(large ? BCH_TOO_LARGE : BCH_INVALID_ARGUMENT,
                  "poses[" + std::to_string(i) + "]: " + error.what());
  }
}

}  // namespace bch::c_api
