// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cassert>
#include <optional>

#include <bch/outline_builder.hpp>
#include <bch/pose_shape.hpp>

#include "layout/character/skinning.hpp"
#include "layout/hierarchy/builder.hpp"
#include "layout/outline/extreme_vertices.hpp"

namespace bch {

using namespace detail;

struct PoseShaper::State {
  float threshold;
  std::uint32_t deepest;
  Skinner skinner;
  std::optional<OutlineBuilder> outline_builder;  ///< this or the next
  std::optional<ExtremeVertices> extremes;
  HierarchyBuilder hierarchy_builder;
  Shape shape;

  void make_root(PoseTime at) {
    require_threshold(threshold);
    extremes->find(skinner.ground_pose(at));
    hierarchy_builder.root(extremes->points(), extremes->grid_step(), shape.hierarchy);
  }
};

PoseShaper::PoseShaper(const Character& character, float threshold, std::uint32_t deepest, bool outlines)
    : state_(new State{threshold, deepest, Skinner(character), {}, {}, {}, {}}) {
  if (deepest == 0 && !outlines)
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

const Shape& PoseShaper::shape(PoseTime at) {
  if (state_->extremes) {
    state_->make_root(at);
    return state_->shape;
  }
  make_outline(at);
  return make_hierarchy();
}

const Outline& PoseShaper::make_outline(PoseTime at) {
  assert(state_->outline_builder);
  state_->outline_builder->build(state_->skinner.ground_pose(at), state_->shape.outline);
  return state_->shape.outline;
}

const Shape& PoseShaper::make_hierarchy() {
  State& own = *state_;
  own.hierarchy_builder.contour(own.shape.outline, own.threshold, SplitRule::centroid, own.shape.hierarchy,
                                own.deepest);
  if (own.deepest == all_depths) own.hierarchy_builder.add_primitives(own.shape.hierarchy);
  return own.shape;
}

}  // namespace bch
