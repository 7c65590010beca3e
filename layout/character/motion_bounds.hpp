// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <vector>

#include <bch/characters.hpp>

namespace bch::detail {

/// Bounds the norm of a quantity that changes in time, and those of its first and second derivatives.
struct MotionBound {
  double value = 0, speed = 0, acceleration = 0;
};

/// Bounds how fast the vertices of a clip accelerate in a shape's frame while no channel passes a key.
///
/// Between two keys a rotation turns at a constant speed w (slerp), so that its matrix R has |R| = 1, |R'| = w and |R''| = w^2; a
/// position and a scale are linear, without a second derivative. The product rule carries these bounds down the skeleton:
/// a joint's linear part is L = L_parent A and its origin t = t_parent + L_parent b. Below the root joint the origin
/// is counted from that joint's, since a shape's frame moves with it; elsewhere the root's motion is added. A bone moves a vertex, which is q in
/// the joint's frame, to L q + t, and weights that sum to 1 take the mean.
class MotionBounds {
 public:
  /// Takes a character, which must outlive this and be valid.
  /// Errors:  throws std::invalid_argument on a clip that is not there, on channels that step, jump or are cubic, and on a character without
  ///          a root joint: their vertices need not move so.
  MotionBounds(const Character& character, std::uint32_t clip);

  /// Returns the times at which a channel has a key, in order, from 0 to the end of the clip.
  const std::vector<float>& key_times() const noexcept { return key_times_; }

  /// Returns the largest acceleration of a vertex between `from` and the next key time, metres per second squared.
  double acceleration(float from);
  /// Returns that of a vertex in space: the frame does not move with the root's height.
  double acceleration_in_space(float from) { return acceleration(from) + root_acceleration_; }

 private:
  struct JointMotion {
    MotionBound linear, origin;
    bool below_root = false;
  };

  MotionBound local_linear(std::size_t joint, float from) const;
  MotionBound local_origin(std::size_t joint, float from) const;

  const Character* character_;
  std::vector<const Channel*> channel_of_joint_;
  std::vector<double> rest_norm_;  ///< of the joints' linear parts; the ground's last
  std::vector<float> key_times_;
  std::vector<JointMotion> joints_;
  double root_acceleration_ = 0;  ///< of the root joint, at the time that was asked for last
  std::vector<double> arm_;       ///< per influence: the vertex's distance from the joint's origin
};

}  // namespace bch::detail
