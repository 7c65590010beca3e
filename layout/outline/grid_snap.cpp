// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/grid_snap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/base/number_class.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {
namespace {

constexpr int grid_bits = 23;

using Simd = BaseLanes;
using Float = Simd::Float;

/// Two pairs (x, y).
Float join(const void* p, const void* q) {
  return xsimd::bitwise_cast<Float>(Simd::of<double>(Simd::pair(p), Simd::pair(q)));
}

/// (x, y) of some of the vertices, in the order of their numbers.
template <class Position>
class Chosen {
 public:
  Chosen(std::span<const Position> positions, std::span<const std::uint32_t> used)
      : positions_(positions), used_(used) {}

  std::size_t size() const { return used_.size(); }
  Float two(std::size_t i) const { return join(at(i), at(i + 1)); }
  Float one_twice(std::size_t i) const { return join(at(i), at(i)); }

 private:
  const Position* at(std::size_t i) const { return &positions_[used_[i]]; }

  std::span<const Position> positions_;
  std::span<const std::uint32_t> used_;
};

/// (x, y) of all vertices, without heights between.
class All {
 public:
  explicit All(std::span<const Vec2> positions) : positions_(positions) {}

  std::size_t size() const { return positions_.size(); }
  Float two(std::size_t i) const { return Simd::load(&positions_[i].x); }
  Float one_twice(std::size_t i) const { return join(&positions_[i], &positions_[i]); }

 private:
  std::span<const Vec2> positions_;
};

/// The largest |x| or |y|, or NaN if there is one. In several chains, because each waits for its last maximum.
template <class Vertices>
float largest_coordinate(const Vertices& vertices) {
  Float largest[2] = {Float(0.0f), Float(0.0f)};
  Simd::Mask not_a_number(false);
  const auto offer = [&](Float first, Float second) {
    not_a_number = not_a_number | xsimd::isnan(first) | xsimd::isnan(second);
    largest[0] = Simd::max(xsimd::abs(first), largest[0]);
    largest[1] = Simd::max(xsimd::abs(second), largest[1]);
  };
  std::size_t i = 0;
  for (; i + 3 < vertices.size(); i += 4) offer(vertices.two(i), vertices.two(i + 2));
  for (; i < vertices.size(); ++i) offer(vertices.one_twice(i), vertices.one_twice(i));
  if (Simd::bits(not_a_number) != 0) return std::numeric_limits<float>::quiet_NaN();
  return -Simd::least(-Simd::max(largest[0], largest[1]));
}

bool is_in_domain(float max_extent) {
  return static_cast<double>(max_extent) >= rounding::smallest_extent &&
         static_cast<double>(max_extent) <= rounding::largest_extent;
}

template <class Position>
[[noreturn]] void reject(std::span<const Position> positions, std::span<const std::uint32_t> used,
                         float max_extent) {
  for (const std::uint32_t v : used)
    if (!is_finite(positions[v].x) || !is_finite(positions[v].y))
      throw std::invalid_argument("outline: vertex " + std::to_string(v) + " is not finite");
  throw std::invalid_argument("outline: expected an extent of 1e-6 to 1e6 m, found " + shortest(max_extent));
}

/// Writes the points of a grid of so many steps a metre: at least 8 and a power of two, so that the products are exact;
/// the conversion rounds halves to even.
template <class Vertices>
void snap(const Vertices& vertices, double steps_per_metre, std::span<GridPoint> points) {
  const Float scale(static_cast<float>(steps_per_metre));
  const std::size_t last = vertices.size() - 1;
  for (std::size_t i = 0; i < last; i += 2)
    Simd::store(&points[i].x, xsimd::nearbyint_as_int(vertices.two(i) * scale));
  const auto end = xsimd::nearbyint_as_int(vertices.one_twice(last) * scale);
  Simd::store_pair(&points[last], xsimd::bitwise_cast<Float>(end), 0);
}

template <class Vertices, class Position>
double snap_to_grid(const Vertices& vertices, std::span<const Position> positions,
                    std::span<const std::uint32_t> used, std::span<GridPoint> points) {
  const float max_extent = largest_coordinate(vertices);
  if (!is_in_domain(max_extent)) reject(positions, used, max_extent);
  const double step = std::ldexp(1.0, std::ilogb(max_extent) + 1 - grid_bits);
  snap(vertices, 1 / step, points);
  return step;
}

}  // namespace

double snap_to_grid(std::span<const Vec3> positions, std::span<const std::uint32_t> used,
                    std::span<GridPoint> points) {
  return snap_to_grid(Chosen(positions, used), positions, used, points);
}

double snap_to_grid(std::span<const Vec2> positions, std::span<const std::uint32_t> used,
                    std::span<GridPoint> points) {
  return used.size() == positions.size() ? snap_to_grid(All(positions), positions, used, points)
                                         : snap_to_grid(Chosen(positions, used), positions, used, points);
}

}  // namespace bch::detail
