// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/build_stages.hpp"

namespace bch::bench {
namespace {

constexpr float threshold = 0.01f;  ///< metres
constexpr std::uint32_t depths[] = {0, 3, 6, all_depths};

/// Keeps what was computed.
template <class Value>
void use(const Value& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

}  // namespace

BuildStages::BuildStages(const Character& character, std::uint32_t poses,
                         const detail::BuildImplementation& implementation)
    : times_(sample_poses(character, poses)),
      skinner_(character),
      outline_builder_(character.triangles, character.vertices.size(), character.vertices, implementation),
      hierarchy_builder_(implementation),
      interior_builder_(implementation) {
  for (std::size_t pose = 0; pose < times_.size(); ++pose) {
    const auto positions = skinner_.ground_pose(times_[pose]);
    positions_.emplace_back(positions.begin(), positions.end());
    outline(pose);
    outlines_.push_back(outline_);
    hierarchy(pose);
    hierarchies_.push_back(hierarchy_);
  }
}

void BuildStages::skin(std::size_t pose) {
  use(skinner_.ground_pose(times_[pose]));
}

void BuildStages::outline(std::size_t pose) {
  outline_builder_.build(positions_[pose], outline_);
}

void BuildStages::hierarchy(std::size_t pose) {
  hierarchy_builder_.contour(outlines_[pose], threshold, detail::SplitRule::centroid, hierarchy_);
}

void BuildStages::levels(std::size_t pose) {
  flatten(hierarchies_[pose], true);
}

void BuildStages::interior(std::size_t pose) {
  search_inside(outlines_[pose], hierarchies_[pose].max_extent);
}

void BuildStages::pose(std::size_t pose) {
  make_hierarchy(pose);
  flatten(hierarchy_, false);
}

void BuildStages::all(std::size_t pose) {
  make_hierarchy(pose);
  search_inside(outline_, hierarchy_.max_extent);
  flatten(hierarchy_, true);
}

void BuildStages::make_hierarchy(std::size_t pose) {
  outline_builder_.build(skinner_.ground_pose(times_[pose]), outline_);
  hierarchy_builder_.contour(outline_, threshold, detail::SplitRule::centroid, hierarchy_);
}

void BuildStages::search_inside(const Outline& outline, double max_extent) {
  interior_ = interior_builder_.build(outline, max_extent);
  profile_ = profile(outline, interior_, max_extent);
  use(profile_);
}

void BuildStages::flatten(const Hierarchy& hierarchy, bool culling) {
  bvh8_builder_.begin(hierarchy);
  for (const std::uint32_t depth : depths) {
    bvh8_builder_.flatten(depth, tree_);
    use(tree_);
    if (!culling || tree_.is_single()) continue;
    outer_ = bvh8_builder_.outer(profile_);
    use(outer_);
  }
  if (!culling) return;
  supports_ = bvh8_builder_.supports();
  use(supports_);
}

}  // namespace bch::bench
