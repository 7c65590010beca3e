// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include <bch/character.hpp>
#include <bch/shape_set.hpp>

namespace bch {

/// Makes shapes of one character in pose after pose: poses it, finds the outline of the union of its triangles, and builds the
/// contour hierarchy that splits at the centroid. It learns the mesh when it is made and keeps its memory: nothing is
/// allocated for a pose once the largest shape has been made. One thread may use it at a time, and one that was moved from
/// can only be assigned to or destroyed.
class PoseShaper {
 public:
  /// Learns the mesh of a character, which must outlive this and must be valid (see validate()). `threshold`, in metres, is
  /// the radius below which a disc is not divided. `deepest`: the largest of a plan's depths; hierarchies end there.
  /// `outlines`: whether to produce outlines at depth 0, where no query needs them. Without, that depth takes the outermost
  /// vertices alone, a third of the time, and shapes have no outlines; their root discs are the same.
  explicit PoseShaper(const Character& character, float threshold = 0.01f, std::uint32_t deepest = all_depths,
                      bool outlines = true);
  PoseShaper(PoseShaper&&) noexcept;
  PoseShaper& operator=(PoseShaper&&) noexcept;
  ~PoseShaper();

  /// Sets the most nodes of a hierarchy, 2^22 unless told: shapes of more throw std::length_error.
  void limit_nodes(std::size_t most);

  /// Makes the shape of a pose: at a time of a clip, keys interpolated as the channels' curves say, times clamped to the first
  /// and last key. A clip that walks away leaves its shape where it is, while its yaw stays.
  /// Returns: the shape down to the deepest depth, until the next call; with primitives where that is all_depths, because exact
  ///          leaves need them.
  /// Errors:  throws std::invalid_argument on a clip or a time that is not there and as OutlineBuilder and contour_hierarchy()
  ///          do, std::domain_error on a position that is not finite. The shape made before is lost.
  const Shape& shape(PoseTime at);

  /// Makes the outline of a pose, which is the first step of shape(), for callers that need the outline alone or take the time
  /// of each step.
  /// Precondition: the shaper makes outlines.
  const Outline& make_outline(PoseTime at);
  /// Makes the shape of the outline made last, which is the second step.
  const Shape& make_hierarchy();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bch
