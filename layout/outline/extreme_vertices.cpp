// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/extreme_vertices.hpp"

#include <algorithm>
#include <cmath>

#include "layout/enclosing_disc/disc_pivoting.hpp"
#include "layout/outline/grid_snap.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {
namespace {

using Simd = BaseLanes;
using Float = Simd::Float;

/// Vertices whose squares fill a register.
constexpr std::size_t block = Simd::width;
/// A square, in float of coordinates that float holds, is off by less than this fraction of it.
constexpr double slack = 0x1p-20;
static_assert(slack >= (2 + 1 + 1) * 0x1p-24, "the differences, their squares, the sum");
/// Looks for a farthest vertex end when it is no farther than that square over the disc's, which leaves a tenth of its
/// radius; more would take longer than the few vertices that they leave out.
constexpr double close_ratio = 1.01;
constexpr int max_iterations = 4;

/// The squares of four points' distances.
Float squares_of(const GridPoint* points, Float from_x, Float from_y) {
  Float x, y;
  Simd::load_pairs([=](std::size_t i) { return points + i; }, x, y);
  x = xsimd::to_float(xsimd::bitwise_cast<Simd::Ints>(x)) - from_x;
  y = xsimd::to_float(xsimd::bitwise_cast<Simd::Ints>(y)) - from_y;
  return x * x + y * y;
}

}  // namespace

ExtremeVertices::ExtremeVertices(std::span<const std::array<std::uint32_t, 3>> triangles,
                                 std::size_t vertices) {
  std::vector<bool> is_used(vertices);
  for (const auto& triangle : triangles)
    for (const std::uint32_t vertex : triangle) is_used[vertex] = true;
  for (std::uint32_t v = 0; v < vertices; ++v)
    if (is_used[v]) used_.push_back(v);
  grid_.resize((used_.size() + block - 1) / block * block);
  for (auto* squares : {&from_origin_, &from_middle_}) squares->resize(grid_.size());
}

/// The disc's radius R is at least that of the disc around any of the vertices. For any point at m from its centre, some
/// vertex is at least sqrt(R^2 + m^2) away, so the farthest one bounds m, and the vertices on the disc's boundary are at
/// least R - m away. All others may be left out, but those as far from the origin as the first, as far as floats tell.
void ExtremeVertices::find(std::span<const Vec2> positions) {
  step_ = snap_to_grid(positions, used_, std::span(grid_).first(used_.size()));
  std::fill(grid_.begin() + static_cast<std::ptrdiff_t>(used_.size()), grid_.end(), grid_[used_.size() - 1]);
  const std::size_t first = farthest_from(0, 0, from_origin_);
  const auto point = [&](std::size_t i) { return PlanePoint{1.0 * grid_[i].x, 1.0 * grid_[i].y}; };
  const PlanePoint a = point(first), b = point(farthest_from(a.x, a.y, from_middle_));
  pivoting::Basis now = pivoting::basis(a, b);
  double at_most = 0;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const std::size_t last = farthest_from(now.centre.x, now.centre.y, from_middle_);
    at_most = (1 + slack) * static_cast<double>(from_middle_[last]);
    if (at_most <= close_ratio * now.square_radius) break;
    now = pivoting::pivot(now, point(last));
  }
  const double at_least = (1 - slack) * now.square_radius;
  const double nearest = std::sqrt(at_least) - std::sqrt(std::max(0.0, at_most - at_least));
  keep(static_cast<float>((1 - slack) * (nearest > 0 ? nearest * nearest : 0)),
       static_cast<float>((1 - slack) * static_cast<double>(from_origin_[first])));
}

/// Which is the farthest, as far as floats tell.
std::size_t ExtremeVertices::farthest_from(double x, double y, std::vector<float>& squares) const {
  const Float from_x(static_cast<float>(x)), from_y(static_cast<float>(y));
  Float largest(0.0f);
  for (std::size_t i = 0; i < grid_.size(); i += block) {
    const Float four = squares_of(&grid_[i], from_x, from_y);
    Simd::store(&squares[i], four);
    largest = Simd::max(largest, four);
  }
  const float most = -Simd::least(-largest);
  std::size_t i = 0;
  while (Simd::bits(Simd::load(&squares[i]) == Float(most)) == 0) i += block;
  while (squares[i] != most) ++i;
  return i;
}

/// Those that are as far as that from the middle or from the origin.
void ExtremeVertices::keep(float from_middle, float from_origin) {
  points_.clear();
  const Float middle(from_middle), origin(from_origin);
  for (std::size_t i = 0; i < grid_.size(); i += block) {
    const std::uint32_t bits =
        Simd::bits((Simd::load(&from_middle_[i]) >= middle) | (Simd::load(&from_origin_[i]) >= origin));
    if (bits == 0) continue;
    for (std::size_t k = 0; k < block; ++k)
      if ((bits >> k & 1) != 0)
        points_.push_back(
            {static_cast<float>(grid_[i + k].x * step_), static_cast<float>(grid_[i + k].y * step_)});
  }
}

}  // namespace bch::detail
