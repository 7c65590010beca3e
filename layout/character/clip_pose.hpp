// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <bch/characters.hpp>
#include <bch/poses.hpp>

#include "layout/character/eigen.hpp"

namespace bch::detail {

/// Makes the joint transforms of one character's clips and of blends of them, without allocating after the first time.
class ClipPose {
 public:
  /// Takes a character, which must outlive this and must be valid (see validate()).
  explicit ClipPose(const Character& character);

  /// Writes each joint relative to its parent at a time of a clip, keys interpolated as the channels' curves say, times clamped to the
  /// first and last key. Only the parts that a channel animates replace those of the rest transform.
  /// Errors:  throws std::invalid_argument on a clip or a time that is not there.
  void place(PoseTime at, std::span<Affine3d> local);

  /// Writes each joint relative to its parent in a blend(). Where all poses but one have no weight, it is that pose, bit for bit.
  void blend(std::span<const WeightedPose> poses, std::span<Affine3d> local);

 private:
  /// Represents a joint relative to its parent where no clip moves it, and its linear part's factors.
  struct Rest {
    Affine3d whole, rotation, scaling;
    Eigen::Quaterniond turn;
  };
  /// Holds what a clip moves of a joint at a time.
  struct Moved {
    std::optional<Eigen::Quaterniond> rotation;
    std::optional<Eigen::Vector3d> scale, position;
  };
  /// Holds sums over the poses of a blend, weighted.
  struct Sum {
    Eigen::Vector4d rotation;
    Eigen::Matrix3d scaling;
    Eigen::Vector3d position;
    bool is_moved;
  };

  void find_channels(PoseTime at);
  std::size_t prefetch(float seconds) const;
  Moved moved(std::size_t joint, float seconds, std::size_t& guess) const;
  void add(std::size_t joint, const Moved& by, double fraction);

  const Character* character_;
  std::vector<Rest> rest_;
  std::vector<const Channel*> channel_of_joint_;
  std::vector<Sum> sums_;
};

}  // namespace bch::detail
