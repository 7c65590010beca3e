// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/outline_builder.hpp>

#include "layout/base/build_implementation.hpp"
#include "layout/character/skinning.hpp"
#include "layout/culling/interior.hpp"
#include "layout/culling/profile.hpp"
#include "layout/enclosing_disc/enclosing_discs.hpp"
#include "layout/hierarchy/builder.hpp"
#include "layout/shape_set/bvh8.hpp"

namespace bch::bench {

/// Runs the way of a character from poses to all that a set stores of shapes, stage by stage: each is made from
/// what the one before it made of the same pose, with memory that is used again.
class BuildStages {
 public:
  /// Takes a character, which must outlive this.
  BuildStages(const Character& character, std::uint32_t poses,
              const detail::BuildImplementation& implementation);

  std::size_t poses() const { return times_.size(); }
  std::span<const Vec2> positions_of(std::size_t pose) const { return positions_[pose]; }
  const Outline& outline_of(std::size_t pose) const { return outlines_[pose]; }

  void skin(std::size_t pose);
  void outline(std::size_t pose);
  void hierarchy(std::size_t pose);
  /// Builds wide trees of four levels, how far they extend from the last profile's centre, and supports of
  /// the deepest.
  void levels(std::size_t pose);
  /// Builds inscribed discs and the profile.
  void interior(std::size_t pose);
  /// Builds flat nodes of four levels from the pose. This is what shapes of one frame need; they have no
  /// culling data.
  void pose(std::size_t pose);
  /// Builds all of these from the pose.
  void all(std::size_t pose);

 private:
  void search_inside(const Outline& outline, double max_extent);
  void make_hierarchy(std::size_t pose);
  void flatten(const Hierarchy& hierarchy, bool culling);

  std::vector<PoseTime> times_;
  std::vector<std::vector<Vec2>> positions_;
  std::vector<Outline> outlines_;
  std::vector<Hierarchy> hierarchies_;

  detail::Skinner skinner_;
  OutlineBuilder outline_builder_;
  detail::HierarchyBuilder hierarchy_builder_;
  detail::Bvh8Builder bvh8_builder_;
  detail::InteriorBuilder interior_builder_;

  // What was made last.
  Outline outline_;
  Hierarchy hierarchy_;
  detail::Bvh8 tree_;
  detail::Interior interior_;
  detail::Profile profile_;
  detail::Supports supports_;
  detail::Outer outer_;
};

struct BuildStage {
  const char* name;
  void (BuildStages::*build)(std::size_t pose);
};
constexpr BuildStage build_stages[] = {
    {"skin", &BuildStages::skin},
    {"outline", &BuildStages::outline},
    {"hierarchy", &BuildStages::hierarchy},
    {"levels", &BuildStages::levels},
    {"interior", &BuildStages::interior},
    {"pose", &BuildStages::pose},
    {"all", &BuildStages::all},
};

}  // namespace bch::bench
