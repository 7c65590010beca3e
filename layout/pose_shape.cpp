// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/pose_shape.hpp"

#include <utility>

#include "layout/union_outline.hpp"

namespace bch {

Shape pose_shape(Skinner& skinner, PoseTime at, float threshold) {
  Outline outline = union_outline(skinner.pose(at), skinner.character().triangles);
  Hierarchy hierarchy = contour_hierarchy(outline, threshold);
  return {std::move(outline), std::move(hierarchy)};
}

}  // namespace bch
