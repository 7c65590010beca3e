// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <Eigen/Geometry>

#include <cstdint>
#include <span>
#include <vector>

#include <bch/characters.hpp>
#include <bch/poses.hpp>

#include "baselines/capsule_fit.hpp"

namespace bch::baselines {

/// Holds the skin of a character in several poses, as joints see it.
class PosedSkin {
 public:
  /// Takes the character, which must outlive this, and the transforms of all joints, as of WorldPose, in each pose.
  PosedSkin(const Character& character, std::span<const std::vector<Affine3d>> poses);

  const Character& character() const { return character_; }
  std::size_t poses() const { return positions_.size(); }
  std::size_t vertices() const { return areas_.size(); }
  /// Returns a third of the area of all triangles at a vertex, where bind positions are.
  double area(std::size_t vertex) const { return areas_[vertex]; }
  /// Returns whether a vertex is seen from outside in the first pose.
  bool visible(std::size_t vertex) const { return visible_[vertex]; }
  /// Returns the joint that moves a vertex most.
  std::uint32_t joint(std::size_t vertex) const { return joint_of_vertex_[vertex]; }

  /// Returns the transform of a joint in a pose.
  const Eigen::Affine3d& map(std::size_t pose, std::uint32_t joint) const { return maps_[pose][joint]; }
  /// Returns where a joint sees vertices in all poses, pose by pose: in metres, as they are in the first pose.
  std::vector<SkinPoint> in_frame_of(std::uint32_t joint, std::span<const std::uint32_t> vertices) const;
  SkinPoint point(std::size_t pose, std::size_t vertex) const {
    return {positions_[pose][vertex], normals_[pose][vertex], areas_[vertex]};
  }

 private:
  const Character& character_;
  std::vector<double> areas_;
  std::vector<bool> visible_;
  std::vector<std::uint32_t> joint_of_vertex_;
  std::vector<std::vector<Eigen::Affine3d>> maps_;
  std::vector<std::vector<Eigen::Vector3d>> positions_, normals_;
};

}  // namespace bch::baselines
