// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <optional>

#include "layout/character/skinning.hpp"
#include "layout/hierarchy/builder.hpp"
#include "layout/outline/builder.hpp"
#include "layout/outline/extreme_vertices.hpp"
#include "layout/shape_set/shape_set.hpp"

namespace bch {

/// The whole way from a pose to a shape: skinning, the outline of the union of its triangles, the contour
/// hierarchy that splits at the centroid. `threshold`, in metres, is the radius below which a disc is not
/// divided. PoseShaper makes the same shapes many times faster where there are several of a character.
/// Errors:  as Skinner::pose(), union_outline() and contour_hierarchy() throw.
Shape pose_shape(Skinner& skinner, PoseTime at, float threshold = 0.01f);

/// Makes shapes of one character in pose after pose. Learns its mesh when it is made and keeps its memory:
/// nothing is allocated for a pose once the largest shape has been made. Not for two threads at a time.
class PoseShaper {
 public:
  /// The character must outlive this and must be valid (see validate()); the threshold is that of
  /// pose_shape(). `deepest`: the largest of a plan's depths; hierarchies end there. `outlines`: whether to produce outlines
  /// at depth 0, where no query needs them. Without, that depth takes the outermost vertices alone, a third of the time, and
  /// shapes have no outlines; see ExtremeVertices for what is the same.
  explicit PoseShaper(const Character& character, float threshold = 0.01f, std::uint32_t deepest = all_depths,
                      bool outlines = true);

  /// The most nodes of a hierarchy, 2^22 unless told: shapes of more throw std::length_error.
  void limit_nodes(std::size_t most) { hierarchy_builder_.limit_nodes(most); }

  /// Returns: the shape that pose_shape() makes, down to the deepest depth, until the next call; with primitives where that is
  /// all_depths, because exact leaves need them.
  /// Errors:  as pose_shape(), but that heights may be anything; the shape made before is lost.
  const Shape& shape(PoseTime at);

  /// Makes the shape in two steps, for callers that need the outline alone or take the time of each:
  /// make_outline() is about a pose, make_hierarchy() about the outline made last.
  /// Preconditions: the shaper makes outlines.
  const Outline& make_outline(PoseTime at);
  const Shape& make_hierarchy();

 private:
  const Shape& make_root(PoseTime at);

  float threshold_;
  std::uint32_t deepest_;
  Skinner skinner_;
  std::optional<OutlineBuilder> outline_builder_;  ///< this or the next
  std::optional<ExtremeVertices> extremes_;
  HierarchyBuilder hierarchy_builder_;
  Shape shape_;
};

}  // namespace bch
