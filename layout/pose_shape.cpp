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

PoseShaper::PoseShaper(const Character& character, float threshold, std::uint32_t deepest)
    : threshold_(threshold),
      deepest_(deepest),
      skinner_(character),
      outline_builder_(character.triangles, character.vertices.size(), character.vertices) {}

const Shape& PoseShaper::shape(PoseTime at) {
  make_outline(at);
  return make_hierarchy();
}

const Outline& PoseShaper::make_outline(PoseTime at) {
  outline_builder_.build(skinner_.pose(at), shape_.outline);
  return shape_.outline;
}

const Shape& PoseShaper::make_hierarchy() {
  hierarchy_builder_.contour(shape_.outline, threshold_, SplitRule::centroid, shape_.hierarchy, deepest_);
  return shape_;
}

}  // namespace bch
