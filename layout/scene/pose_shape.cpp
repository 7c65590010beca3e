// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <optional>
#include <utility>
#include <vector>

#include <bch/outline_builder.hpp>
#include <bch/poses.hpp>

#include "layout/base/floating_point_state.hpp"
#include "layout/character/skinning.hpp"
#include "layout/hierarchy/builder.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "layout/outline/extreme_vertices.hpp"

namespace bch {

using namespace detail;

struct ShapeBuilder::State {
  ShapeSetPlan plan;
  float threshold;
  Skinner skinner;
  std::optional<OutlineBuilder> outline_builder;  ///< this or the next
  std::optional<ExtremeVertices> extremes;
  HierarchyBuilder hierarchy_builder;
  Shape shape;

  void make_outline(const Pose& pose);
  void make_hierarchy();
};

void ShapeBuilder::State::make_outline(const Pose& pose) {
  if (extremes) return extremes->find(skinner.ground_pose(pose));
  if (!plan.heights) return outline_builder->build(skinner.ground_pose(pose), shape.outline);
  shape.heights = outline_builder->build(skinner.pose(pose), shape.outline);
}

void ShapeBuilder::State::make_hierarchy() {
  if (extremes) {
    require_threshold(threshold);
    return hierarchy_builder.root(extremes->points(), extremes->grid_step(), shape.hierarchy);
  }
  hierarchy_builder.contour(shape.outline, threshold, detail::SplitRule::centroid, shape.hierarchy,
                            plan.depths.back());
  if (plan.depths.back() == all_depths) hierarchy_builder.add_primitives(shape.hierarchy);
}

ShapeBuilder::ShapeBuilder(const Character& character, const ShapeSetPlan& plan, float threshold) {
  const FloatingPointStateGuard floats;
  validate(plan);
  state_.reset(new State{plan, threshold, Skinner(character), {}, {}, {}, {}});
  if (plan.depths.back() == 0 && !plan.heights)
    state_->extremes.emplace(character.triangles, character.vertices.size());
  else
    state_->outline_builder.emplace(character.triangles, character.vertices.size(), character.vertices);
}

ShapeBuilder::ShapeBuilder(ShapeBuilder&&) noexcept = default;
ShapeBuilder& ShapeBuilder::operator=(ShapeBuilder&&) noexcept = default;
ShapeBuilder::~ShapeBuilder() = default;

void ShapeBuilder::limit_nodes(std::size_t max) {
  state_->hierarchy_builder.limit_nodes(max);
}

const Shape& ShapeBuilder::shape(const Pose& pose) {
  make_outline(pose);
  return make_hierarchy();
}

const Shape& ShapeBuilder::make_outline(const Pose& pose) {
  const FloatingPointStateGuard floats;
  state_->make_outline(pose);
  return state_->shape;
}

const Shape& ShapeBuilder::make_hierarchy() {
  const FloatingPointStateGuard floats;
  state_->make_hierarchy();
  return state_->shape;
}

std::span<const Affine3d> ShapeBuilder::joint_transforms(PoseTime at, JointFrame frame) {
  const FloatingPointStateGuard floats;
  return state_->skinner.joints(at, frame);
}

std::span<const Affine3d> ShapeBuilder::blend(std::span<const WeightedPose> poses) {
  const FloatingPointStateGuard floats;
  return state_->skinner.blend(poses);
}

std::span<const Vec3> ShapeBuilder::pose_vertices(const Pose& pose) {
  const FloatingPointStateGuard floats;
  return state_->skinner.pose(pose);
}

}  // namespace bch
