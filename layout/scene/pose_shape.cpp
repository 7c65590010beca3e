// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <optional>
#include <utility>
#include <vector>

#include <bch/outline_builder.hpp>
#include <bch/pose_shape.hpp>

#include "layout/base/floating_point_state.hpp"
#include "layout/character/skinning.hpp"
#include "layout/hierarchy/builder.hpp"
#include "layout/outline/extreme_vertices.hpp"

namespace bch {

using namespace detail;

struct PoseShaper::State {
  ShapeSetPlan plan;
  float threshold;
  Skinner skinner;
  std::optional<OutlineBuilder> outline_builder;  ///< this or the next
  std::optional<ExtremeVertices> extremes;
  HierarchyBuilder hierarchy_builder;
  std::vector<Outline> slab_outlines;
  Shape shape;

  void make_outlines(const Pose& pose, bool whole);
  void make_hierarchy(Shape& of);
};

void PoseShaper::State::make_outlines(const Pose& pose, bool whole) {
  if (extremes) return extremes->find(skinner.ground_pose(pose));
  if (plan.slices.empty() && !plan.heights)
    return outline_builder->build(skinner.ground_pose(pose), shape.outline);
  const std::span<const float> planes = whole ? std::span<const float>() : plan.slices;
  const std::size_t slabs = planes.size() + 1;
  // Outlines change places with those of the shape, so that both keep their memory.
  slab_outlines.resize(slabs);
  shape.slabs.resize(planes.empty() ? 0 : slabs);
  shape.heights = outline_builder->build(skinner.pose(pose), planes, slab_outlines);
  if (planes.empty()) return std::swap(shape.outline, slab_outlines[0]);
  for (std::size_t i = 0; i < slabs; ++i) std::swap(shape.slabs[i].outline, slab_outlines[i]);
}

void PoseShaper::State::make_hierarchy(Shape& of) {
  if (extremes) {
    require_threshold(threshold);
    return hierarchy_builder.root(extremes->points(), extremes->grid_step(), of.hierarchy);
  }
  if (of.outline.contours() == 0) return of.hierarchy.nodes.clear();
  hierarchy_builder.contour(of.outline, threshold, SplitRule::centroid, of.hierarchy, plan.depths.back());
  if (plan.depths.back() == all_depths) hierarchy_builder.add_primitives(of.hierarchy);
}

PoseShaper::PoseShaper(const Character& character, const ShapeSetPlan& plan, float threshold) {
  const FloatingPointStateGuard floats;
  validate(plan);
  state_.reset(new State{plan, threshold, Skinner(character), {}, {}, {}, {}, {}});
  if (plan.depths.back() == 0 && plan.slices.empty() && !plan.heights)
    state_->extremes.emplace(character.triangles, character.vertices.size());
  else
    state_->outline_builder.emplace(character.triangles, character.vertices.size(), character.vertices);
}

PoseShaper::PoseShaper(PoseShaper&&) noexcept = default;
PoseShaper& PoseShaper::operator=(PoseShaper&&) noexcept = default;
PoseShaper::~PoseShaper() = default;

void PoseShaper::limit_nodes(std::size_t most) {
  state_->hierarchy_builder.limit_nodes(most);
}

const Shape& PoseShaper::shape(const Pose& pose, bool whole) {
  make_outlines(pose, whole);
  return make_hierarchies();
}

const Shape& PoseShaper::make_outlines(const Pose& pose, bool whole) {
  const FloatingPointStateGuard floats;
  state_->make_outlines(pose, whole);
  return state_->shape;
}

const Shape& PoseShaper::make_hierarchies() {
  const FloatingPointStateGuard floats;
  Shape& shape = state_->shape;
  if (shape.slabs.empty()) state_->make_hierarchy(shape);
  for (Shape& slab : shape.slabs) state_->make_hierarchy(slab);
  return shape;
}

std::span<const Affine3d> PoseShaper::joint_transforms(PoseTime at, JointFrame frame) {
  const FloatingPointStateGuard floats;
  return state_->skinner.joints(at, frame);
}

std::span<const Affine3d> PoseShaper::blend(std::span<const WeightedPose> poses) {
  const FloatingPointStateGuard floats;
  return state_->skinner.blend(poses);
}

std::span<const Vec3> PoseShaper::pose_vertices(const Pose& pose) {
  const FloatingPointStateGuard floats;
  return state_->skinner.pose(pose);
}

}  // namespace bch
