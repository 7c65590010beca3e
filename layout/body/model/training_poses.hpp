// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/characters.hpp>

#include "layout/base/space_point.hpp"
#include "layout/body/model/skin_pieces.hpp"
#include "layout/character/skinning.hpp"

namespace bch::detail {

/// Holds the skin of a character in poses in which spheres are chosen: where its points are, and where its bones take the centres of
/// spheres.
class TrainingPoses {
 public:
  /// Takes a skin in poses of a character.
  TrainingPoses(const Character& character, const SkinPieces& skin, std::span<const PoseTime> poses);

  std::size_t size() const noexcept { return poses_.size(); }
  std::span<const SpacePoint> points(std::size_t pose) const noexcept { return poses_[pose].points; }
  /// Returns where a bone that moves a vertex takes the frame of its inverse_bind.
  const Affine3d& map(std::size_t pose, std::uint32_t bone) const noexcept { return poses_[pose].maps[bone]; }
  SpacePoint centre(std::size_t pose, std::span<const SphereInfluence> influences) const;

 private:
  struct Posed {
    std::vector<SpacePoint> points;
    std::vector<Affine3d> maps;  ///< by bone
    SpacePoint middle;
  };

  std::vector<Posed> poses_;
};

}  // namespace bch::detail
