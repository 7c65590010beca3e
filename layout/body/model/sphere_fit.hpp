// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "layout/base/aligned_vector.hpp"
#include "layout/body/model/skin_pieces.hpp"
#include "layout/body/model/sphere_choice.hpp"
#include "layout/body/model/training_poses.hpp"

namespace bch::detail {

/// Keeps spheres and their pieces in all training poses up to date while these change.
class SphereFit {
 public:
  static constexpr std::size_t poses = 24;
  using PerPose = std::array<float, poses>;

  /// Holds a sphere, and where it is in each pose.
  struct Ball {
    std::vector<SphereInfluence> influences;
    std::vector<std::uint32_t> pieces;
    PerPose x, y, z, squared_radius, radius;
    std::array<std::uint32_t, poses> farthest;  ///< corner
  };

  /// Takes a choice in a training of 24 poses.
  SphereFit(const SkinPieces& skin, const TrainingPoses& training, const SphereChoice& choice);

  std::vector<Ball> balls;
  std::vector<std::uint32_t> owner;  ///< of each piece

  /// Finds the places of a sphere after its influences changed.
  void place(Ball& ball) const;
  /// Finds the radii of a sphere after its place or its pieces changed.
  void refit(Ball& ball);
  /// Says whether a sphere holds a piece in all poses without growing.
  bool contains(const Ball& ball, std::uint32_t piece) const;
  using Corners = std::array<std::uint32_t, 3>;
  /// Returns by how much a sphere grows when it takes a triangle, metres, in the mean of all poses.
  float growth(const Ball& ball, const Corners& triangle) const;
  /// Makes a sphere hold one triangle more.
  void grow(Ball& ball, const Corners& triangle) const;
  /// Gives a piece to another sphere, which holds it already (see grow()). The radius of the earlier owner is not refitted.
  void hand_over(std::uint32_t piece, std::uint32_t to);
  std::array<float, 3> at(std::uint32_t point, std::size_t pose) const;
  std::size_t point_count() const { return tracks_.size(); }
  /// Says whether a point is made by a cut.
  bool is_cut(std::uint32_t point) const { return point >= tracks_.size() - skin_->cuts.size(); }
  const Corners& corners(std::uint32_t piece) const { return skin_->pieces[piece]; }
  const TrainingPoses& training() const { return *training_; }
  SphereChoice choice() const;

 private:
  /// Holds the places of one point in all poses.
  struct Track {
    PerPose x, y, z;
  };
  void measure(const Ball& ball, std::uint32_t point, PerPose& squared) const;

  const SkinPieces* skin_;
  const TrainingPoses* training_;
  std::vector<Track> tracks_;        ///< by point
  std::vector<std::uint32_t> seen_;  ///< by point: the last refit that met it
  std::uint32_t refits_ = 0;
};

}  // namespace bch::detail
