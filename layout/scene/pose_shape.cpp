// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/scene/pose_shape.hpp"

#include <cassert>
#include <utility>

#include "layout/outline/union_outline.hpp"

namespace bch {

Shape pose_shape(Skinner& skinner, PoseTime at, float threshold) {
  Outline outline = union_outline(skinner.pose(at), skinner.character().triangles);
  Hierarchy hierarchy = contour_hierarchy(outline, threshold);
  return {std::move(outline), std::move(hierarchy)};
}

PoseShaper::PoseShaper(const Character& character, float threshold, std::uint32_t deepest, bool outlines)
    : threshold_(threshold), deepest_(deepest), skinner_(character) {
  if (deepest == 0 && !outlines)
    extremes_.emplace(character.triangles, character.vertices.size());
  else
    outline_builder_.emplace(character.triangles, character.vertices.size(), character.vertices);
}

const Shape& PoseShaper::shape(PoseTime at) {
  if (extremes_) return make_root(at);
  make_outline(at);
  return make_hierarchy();
}

const Shape& PoseShaper::make_root(PoseTime at) {
  require_threshold(threshold_);
  extremes_->find(skinner_.ground_pose(at));
  hierarchy_builder_.root(extremes_->points(), extremes_->grid_step(), shape_.hierarchy);
  return shape_;
}

const Outline& PoseShaper::make_outline(PoseTime at) {
  assert(outline_builder_);
  outline_builder_->build(skinner_.ground_pose(at), shape_.outline);
  return shape_.outline;
}

const Shape& PoseShaper::make_hierarchy() {
  hierarchy_builder_.contour(shape_.outline, threshold_, SplitRule::centroid, shape_.hierarchy, deepest_);
  if (deepest_ == all_depths) hierarchy_builder_.add_primitives(shape_.hierarchy);
  return shape_;
}

}  // namespace bch
