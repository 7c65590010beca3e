// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <optional>
#include <span>
#include <vector>

#include <bch/outline_builder.hpp>

#include "layout/outline/plane_cuts.hpp"
#include "layout/outline/topology.hpp"
#include "layout/outline/union_boundary.hpp"

namespace bch::detail {

/// Finds what outline() returns, of one mesh in pose after pose. Only one thread may use an object at a time.
class MeshOutliner {
 public:
  /// Prepares the mesh. `bind_pose`: as OutlineBuilder takes it.
  /// Errors:  throws std::invalid_argument as OutlineBuilder does, and on heights that are NaN or do not ascend.
  MeshOutliner(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const Vec3> bind_pose,
               const OutlineOptions& options);

  /// Returns the outline of a pose.
  /// Errors:  throws std::invalid_argument as OutlineBuilder::build() does.
  Outline outline(std::span<const Vec3> positions);

 private:
  Outline with_holes(std::span<const Vec3> positions);
  void add_triangles(std::uint32_t triangle, std::vector<GridTriangle>& to) const;

  std::vector<float> planes_;
  std::size_t slab_ = 0;
  std::optional<OutlineBuilder> builder_;  ///< this, or what follows
  OutlineTopology topology_;
  std::vector<GridPoint> points_;
  PlaneCuts cuts_;
};

}  // namespace bch::detail
