// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/visible_skin.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

namespace bch::baselines {
namespace {

using Eigen::Vector3d;
using Corners = std::array<std::uint32_t, 3>;

constexpr double min_hit_distance = 0.001;  // metres: of what is nearer, a vertex is a part
constexpr int rays_around = 8, rays_needed = 3;

/// Source: T. Moeller, B. Trumbore, "Fast, minimum storage ray-triangle intersection", Journal of Graphics Tools 2, 1997.
bool meets(const Vector3d& from, const Vector3d& along, const Vector3d& a, const Vector3d& b,
           const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, p = along.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0) return false;
  const Vector3d to = from - a, q = to.cross(ab);
  const double u = to.dot(p) / determinant, v = along.dot(q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && ac.dot(q) / determinant > min_hit_distance;
}

}  // namespace

std::vector<bool> visible_vertices(std::span<const Corners> triangles, std::span<const Vector3d> positions,
                                   std::span<const Vector3d> normals) {
  const auto escapes = [&](std::size_t vertex, const Vector3d& along) {
    return std::none_of(triangles.begin(), triangles.end(), [&](const Corners& corners) {
      return std::find(corners.begin(), corners.end(), vertex) == corners.end() &&
             meets(positions[vertex], along, positions[corners[0]], positions[corners[1]],
                   positions[corners[2]]);
    });
  };
  std::vector<bool> visible;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vector3d aside = normals[v].unitOrthogonal();
    int seen = escapes(v, normals[v]) ? 1 : 0;
    for (int i = 0; i < rays_around && seen < rays_needed; ++i) {
      const Eigen::AngleAxisd turn(i * 2 * std::numbers::pi / rays_around, normals[v]);
      seen += escapes(v, normals[v] + turn * aside) ? 1 : 0;
    }
    visible.push_back(seen >= rays_needed);
  }
  return visible;
}

}  // namespace bch::baselines
