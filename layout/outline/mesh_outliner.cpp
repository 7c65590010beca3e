// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/mesh_outliner.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/outline/grid_snap.hpp"
#include "layout/outline/mesh_between.hpp"
#include "layout/outline/union_rings.hpp"

namespace bch::detail {
namespace {

/// Triangles that share no corner, on their grid.
struct GridMesh {
  std::span<const Vec3> corners;
  std::vector<GridTriangle> triangles;
  double step;
};

GridMesh grid_mesh(std::span<const std::array<Vec3, 3>> pieces) {
  GridMesh mesh{{pieces.data()->data(), 3 * pieces.size()}, {}, 0};
  std::vector<std::uint32_t> all(mesh.corners.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<GridPoint> points(all.size());
  mesh.step = snap_to_grid(mesh.corners, all, points);
  for (std::size_t i = 0; i < points.size(); i += 3)
    mesh.triangles.push_back({points[i], points[i + 1], points[i + 2]});
  return mesh;
}

bool is_point(const GridTriangle& triangle) {
  return triangle[0] == triangle[1] && triangle[0] == triangle[2];
}

Outline with_holes(const GridMesh& mesh) {
  Outline outline;
  outline.grid_step = static_cast<float>(mesh.step);
  for (const GridRing& ring : rings_of(union_boundary(mesh.triangles))) {
    for (const GridPoint& p : ring)
      outline.points.push_back({static_cast<float>(p.x * mesh.step), static_cast<float>(p.y * mesh.step)});
    outline.contour_begin.push_back(static_cast<std::uint32_t>(outline.points.size()));
  }
  return outline;
}

Outline without_holes(const GridMesh& mesh) {
  Outline outline;
  if (std::all_of(mesh.triangles.begin(), mesh.triangles.end(), is_point)) return outline;
  std::vector<std::array<std::uint32_t, 3>> triangles(mesh.triangles.size());
  std::iota(triangles.data()->data(), triangles.data()->data() + mesh.corners.size(), 0u);
  OutlineBuilder(triangles, mesh.corners.size(), mesh.corners).build(mesh.corners, outline);
  return outline;
}

/// A cut may leave a tip at the origin, which has no outline.
bool is_reached(std::span<const std::array<Vec3, 3>> pieces) {
  return std::any_of(pieces.begin(), pieces.end(), [](const std::array<Vec3, 3>& piece) {
    return std::any_of(piece.begin(), piece.end(), [](const Vec3& p) {
      return std::max(std::abs(p.x), std::abs(p.y)) >= static_cast<float>(rounding::smallest_extent);
    });
  });
}

}  // namespace

MeshOutliner::MeshOutliner(std::span<const std::array<std::uint32_t, 3>> triangles,
                           std::span<const Vec3> bind_pose, const OutlineOptions& options)
    : builder_(triangles, bind_pose.size(), bind_pose),
      triangles_(triangles.begin(), triangles.end()),
      between_(options.between),
      holes_(options.holes) {
  const auto [bottom, top] = between_;
  if (!(bottom < top))
    throw std::invalid_argument("outline: between " + shortest(bottom) + " and " + shortest(top) +
                                " m there is nothing");
}

Outline MeshOutliner::outline(std::span<const Vec3> positions) {
  const bool cuts = between_ != Heights{};
  if (!cuts && !holes_) {
    std::vector<Vec2> seen_from_above;  // heights may have any value
    for (const auto& [x, y, z] : positions) seen_from_above.push_back({x, y});
    Outline outline;
    builder_.build(seen_from_above, outline);
    return outline;
  }
  const std::vector<std::array<Vec3, 3>> pieces = mesh_between(positions, triangles_, between_);
  if (cuts && !is_reached(pieces)) return {};
  const GridMesh mesh = grid_mesh(pieces);
  return holes_ ? with_holes(mesh) : without_holes(mesh);
}

}  // namespace bch::detail
