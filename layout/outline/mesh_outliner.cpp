// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/mesh_outliner.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"
#include "layout/outline/grid_snap.hpp"
#include "layout/outline/union_rings.hpp"

namespace bch::detail {

MeshOutliner::MeshOutliner(std::span<const std::array<std::uint32_t, 3>> triangles,
                           std::span<const Vec3> bind_pose, const OutlineOptions& options) {
  const auto [bottom, top] = options.between;
  if (!(bottom < top))
    throw std::invalid_argument("outline: between " + shortest(bottom) + " and " + shortest(top) +
                                " m there is nothing");
  if (is_finite(bottom)) planes_.push_back(bottom), slab_ = 1;
  if (is_finite(top)) planes_.push_back(top);
  if (!options.holes) {
    builder_.emplace(triangles, bind_pose.size(), bind_pose);
    return;
  }
  topology_ = outline_topology(triangles, bind_pose.size(), bind_pose);
  points_.resize(topology_.used.size());
}

Outline MeshOutliner::outline(std::span<const Vec3> positions) {
  if (!builder_) return with_holes(positions);
  Outline outline;
  if (planes_.empty()) {
    builder_->build(positions, outline);
    return outline;
  }
  std::vector<Outline> slabs(planes_.size() + 1);
  builder_->build(positions, planes_, slabs);
  return std::move(slabs[slab_]);
}

Outline MeshOutliner::with_holes(std::span<const Vec3> positions) {
  const double step = snap_to_grid(positions, topology_.used, points_);
  if (!planes_.empty()) cuts_.cut(topology_, positions, points_, step, planes_);
  std::vector<GridTriangle> triangles;
  for (std::uint32_t t = 0; t < topology_.triangles.size(); ++t) add_triangles(t, triangles);
  Outline outline;
  outline.grid_step = static_cast<float>(step);
  for (const GridRing& ring : rings_of(union_boundary(triangles))) {
    for (const GridPoint& p : ring)
      outline.points.push_back({static_cast<float>(p.x * step), static_cast<float>(p.y * step)});
    outline.contour_begin.push_back(static_cast<std::uint32_t>(outline.points.size()));
  }
  return outline;
}

/// Adds what of a triangle lies in the slab: where planes cut it, the fan about a piece's first corner, as PlaneCuts says.
void MeshOutliner::add_triangles(std::uint32_t triangle, std::vector<GridTriangle>& to) const {
  const auto& corners = topology_.triangles[triangle];
  const auto slab_of = [&](std::size_t k) { return planes_.empty() ? 0 : cuts_.slab(corners[k % 3]); };
  if (planes_.empty() || !cuts_.is_cut(triangle)) {
    if (slab_of(0) == slab_) to.push_back({points_[corners[0]], points_[corners[1]], points_[corners[2]]});
    return;
  }
  std::vector<GridPoint> piece;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax({slab_of(k), slab_of(k + 1)});
    if (slab_ < low || high < slab_) continue;
    for (const GridPoint& end :
         cuts_.piece(corners[k], corners[(k + 1) % 3], static_cast<std::uint32_t>(slab_)))
      if (piece.empty() || !(piece.back() == end)) piece.push_back(end);
  }
  for (std::size_t i = 1; i + 1 < piece.size(); ++i) to.push_back({piece[0], piece[i], piece[i + 1]});
}

}  // namespace bch::detail
