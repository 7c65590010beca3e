// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/plane_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "layout/base/number_class.hpp"
#include "layout/base/planes.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t most_corners = 5;

std::uint8_t side_of(GridPoint a, GridPoint b, GridPoint c) {
  const std::int64_t twice_area = cross(b - a, c - a);
  return twice_area > 0 ? counter_clockwise : twice_area < 0 ? clockwise : std::uint8_t{0};
}

}  // namespace

void PlaneCuts::cut(const OutlineTopology& topology, std::span<const Vec3> positions,
                    std::span<const GridPoint> points, double step, std::span<const float> planes) {
  used_ = topology.used.data();
  positions_ = positions, points_ = points;
  steps_per_metre_ = 1 / step;
  vertices_ = static_cast<std::uint32_t>(points.size());
  find_slabs(planes);
  above_.resize(vertices_);
  std::iota(above_.begin(), above_.end(), 0u);
  first_node_.resize(topology.triangles.size(), not_cut);
  for (const std::uint32_t t : cut_triangles_) first_node_[t] = not_cut;
  cut_triangles_.clear(), sides_.clear(), borders_.clear();
  for (std::uint32_t t = 0; t < topology.triangles.size(); ++t) {
    const auto& [a, b, c] = topology.triangles[t];
    if (((slab_[a] ^ slab_[b]) | (slab_[a] ^ slab_[c])) != 0) cut_triangle(t, topology.triangles[t]);
  }
}

void PlaneCuts::find_slabs(std::span<const float> planes) {
  slabs_ = static_cast<std::uint32_t>(planes.size() + 1);
  plane_.clear();
  for (const float plane : planes) plane_.push_back(height_of(plane));
  z_.resize(vertices_);
  heights_ = {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  float not_a_number = 0;
  for (std::uint32_t v = 0; v < vertices_; ++v) {
    const float z = z_[v] = positions_[used_[v]].z;
    heights_.bottom = z < heights_.bottom ? z : heights_.bottom;
    heights_.top = heights_.top < z ? z : heights_.top;
    not_a_number += 0 * z;
  }
  if (not_a_number != 0 || not_a_number != not_a_number) {
    const auto bad = std::find_if(z_.begin(), z_.end(), [](float z) { return !is_finite(z); });
    throw std::invalid_argument("outline: the height of vertex " +
                                std::to_string(used_[static_cast<std::size_t>(bad - z_.begin())]) +
                                " is not finite");
  }
  slab_.assign(vertices_, 0);
  for (const float plane : planes)
    for (std::uint32_t v = 0; v < vertices_; ++v)
      slab_[v] = static_cast<std::uint8_t>(slab_[v] + (plane < z_[v]));
}

/// The order of the ends decides nothing: an edge always goes up.
GridPoint PlaneCuts::crossing(std::uint32_t v, std::uint32_t w, std::uint32_t plane) const {
  if (z_[w] < z_[v]) std::swap(v, w);
  const double low = z_[v], share = (plane_[plane] - low) / (double{z_[w]} - low);
  const auto on_grid = [&](float from, float to) {
    return static_cast<std::int32_t>(
        std::lrint((double{from} + (double{to} - double{from}) * share) * steps_per_metre_));
  };
  const Vec3 &from = positions_[used_[v]], &to = positions_[used_[w]];
  return {on_grid(from.x, to.x), on_grid(from.y, to.y)};
}

std::array<GridPoint, 2> PlaneCuts::piece(std::uint32_t a, std::uint32_t b, std::uint32_t slab) const {
  const auto end = [&](std::uint32_t v, std::uint32_t other) {
    if (slab_[v] == slab) return points_[v];
    return crossing(v, other, slab_[v] < slab ? slab - 1 : slab);
  };
  return {end(a, b), end(b, a)};
}

/// Slab by slab, upwards. An edge that crosses both planes of a slab gives two corners, in the order of the way round.
void PlaneCuts::cut_triangle(std::uint32_t triangle, const std::array<std::uint32_t, 3>& corners) {
  const auto [lowest, highest] = std::minmax({slab_[corners[0]], slab_[corners[1]], slab_[corners[2]]});
  cut_triangles_.push_back(triangle);
  first_node_[triangle] = vertices_ + static_cast<std::uint32_t>(sides_.size()) - lowest;
  std::array<GridPoint, 3> lower{}, upper{};  // of each edge: where it crosses the planes of the slab
  for (std::uint32_t slab = lowest; slab <= highest; ++slab, lower = upper) {
    std::array<GridPoint, most_corners> corner;
    std::array<std::uint8_t, most_corners> in_plane{};  // 1: in the lower one, 2: in the upper one
    std::size_t count = 0;
    const std::uint32_t node = vertices_ + static_cast<std::uint32_t>(sides_.size());
    above_.push_back(node);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = corners[i], w = corners[(i + 1) % 3], from = slab_[v], to = slab_[w];
      const bool crosses_lower = std::min(from, to) < slab && slab <= std::max(from, to);
      const bool crosses_upper = std::min(from, to) <= slab && slab < std::max(from, to);
      if (crosses_upper) upper[i] = crossing(v, w, slab);
      if (from == slab) {
        corner[count++] = points_[v];
        connect(node, v);
      }
      const auto add = [&](bool crosses, GridPoint at, std::uint8_t plane) {
        if (!crosses) return;
        corner[count] = at;
        in_plane[count++] = plane;
      };
      if (from < to) add(crosses_lower, lower[i], 1);
      add(crosses_upper, upper[i], 2);
      if (to < from) add(crosses_lower, lower[i], 1);
    }
    add_piece({corner.data(), count}, {in_plane.data(), count}, slab, node);
  }
}

/// A piece that is a point on the grid still holds a point of the body, maybe the only one in its slab. It becomes a
/// whisker of one step.
void PlaneCuts::add_piece(std::span<const GridPoint> corners, std::span<const std::uint8_t> in_plane,
                          std::uint32_t slab, std::uint32_t node) {
  const std::size_t count = corners.size();
  std::uint8_t common = side_of(corners[0], corners[1], corners[2]);
  for (std::size_t i = 2; i + 1 < count; ++i) {
    const std::uint8_t side = side_of(corners[0], corners[i], corners[i + 1]);
    common = side == common ? side : std::uint8_t{0};
  }
  sides_.push_back(common);
  for (std::size_t i = 0; i < count; ++i)
    if (const std::size_t next = (i + 1) % count; in_plane[i] != 0 && in_plane[i] == in_plane[next])
      borders_.push_back({corners[i], corners[next], slab, node});
  if (common != 0) return;
  for (std::size_t i = 2; i + 1 < count; ++i) borders_.push_back({corners[0], corners[i], slab, node});
  const GridPoint first = corners[0];
  if (std::all_of(corners.begin(), corners.end(), [&](GridPoint p) { return p == first; }))
    borders_.push_back({first, {first.x + (first.x < 0 ? 1 : -1), first.y}, slab, node});
}

void PlaneCuts::connect(std::uint32_t node, std::uint32_t other) {
  const std::uint32_t a = root(node), b = root(other);
  above_[std::max(a, b)] = std::min(a, b);
}

std::uint32_t PlaneCuts::root(std::uint32_t node) {
  while (above_[node] != node) node = above_[node] = above_[above_[node]];
  return node;
}

}  // namespace bch::detail
