// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/poses.hpp>

#include <stdexcept>
#include <string>

#include "layout/base/floating_point_state.hpp"
#include "layout/character/skinning.hpp"

namespace bch {

using namespace detail;

Affine3d Transforms::operator[](std::size_t i) const noexcept {
  Affine3d map;
  const auto read = [&](const auto* first) {
    first += i * stride_;
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 4; ++column)
        map.rows[row][column] = static_cast<double>(first[row * row_ + column * column_]);
  };
  is_double_ ? read(static_cast<const double*>(first_)) : read(static_cast<const float*>(first_));
  return map;
}

std::uint32_t find_joint(const Character& character, std::string_view name) {
  std::size_t found = character.joints.size(), count = 0;
  for (std::size_t j = 0; j < character.joints.size(); ++j)
    if (character.joints[j].name == name) found = j, ++count;
  if (count == 1) return static_cast<std::uint32_t>(found);
  throw std::invalid_argument("character '" + character.name + "': expected one joint '" + std::string(name) +
                              "', found " + std::to_string(count));
}

std::vector<Affine3d> joint_transforms(const Character& character, PoseTime at, JointFrame frame) {
  const FloatingPointStateGuard floats;
  Skinner skinner(character);
  const auto joints = skinner.joints(at, frame);
  return {joints.begin(), joints.end()};
}

std::vector<Affine3d> blend(const Character& character, std::span<const WeightedPose> poses) {
  const FloatingPointStateGuard floats;
  Skinner skinner(character);
  const auto joints = skinner.blend(poses);
  return {joints.begin(), joints.end()};
}

std::vector<Vec3> pose_vertices(const Character& character, const Pose& pose) {
  const FloatingPointStateGuard floats;
  Skinner skinner(character);
  const auto positions = skinner.pose(pose);
  return {positions.begin(), positions.end()};
}

}  // namespace bch
