// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/model/training_poses.hpp"

namespace bch::detail {

TrainingPoses::TrainingPoses(const Character& character, const SkinPieces& skin,
                             std::span<const PoseTime> poses) {
  Skinner skinner(character);
  for (const PoseTime& at : poses) {
    Posed& posed = poses_.emplace_back();
    for (const Vec3& p : place_points(skinner.pose(Pose(at)), skin.cuts))
      posed.points.push_back(space_point(p));
    posed.maps.resize(character.bones.size());
    for (std::size_t i = 0; i < skinner.bones().size(); ++i)
      posed.maps[skinner.bones()[i]] = skinner.bone_maps()[i];
    posed.middle = {double{skinner.middle().x}, double{skinner.middle().y}, 0};
  }
}

SpacePoint TrainingPoses::centre(std::size_t pose, std::span<const SphereInfluence> influences) const {
  const Posed& posed = poses_[pose];
  double sum[3] = {-posed.middle.x, -posed.middle.y, 0};
  for (const auto& [bone, weight, centre] : influences) {
    const auto& rows = posed.maps[bone].rows;
    for (int i = 0; i < 3; ++i)
      sum[i] += double{weight} * (rows[i][0] * double{centre.x} + rows[i][1] * double{centre.y} +
                                  rows[i][2] * double{centre.z} + rows[i][3]);
  }
  return {sum[0], sum[1], sum[2]};
}

}  // namespace bch::detail
