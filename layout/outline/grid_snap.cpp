// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/grid_snap.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"

namespace bch::detail {
namespace {

constexpr int grid_bits = 23;

/// Eight bytes: behind the last vertex there need not be more than its height.
template <class Position>
__m128i load(const Position& position) {
  return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&position));
}

/// (x, y) of some of the vertices, in the order of their numbers.
template <class Position>
class Chosen {
 public:
  Chosen(std::span<const Position> positions, std::span<const std::uint32_t> used)
      : positions_(positions), used_(used) {}

  std::size_t size() const { return used_.size(); }
  __m128 two(std::size_t i) const { return join(at(i), at(i + 1)); }
  __m128 one_twice(std::size_t i) const { return join(at(i), at(i)); }

 private:
  const Position& at(std::size_t i) const { return positions_[used_[i]]; }
  static __m128 join(const Position& p, const Position& q) {
    return _mm_castsi128_ps(_mm_unpacklo_epi64(load(p), load(q)));
  }

  std::span<const Position> positions_;
  std::span<const std::uint32_t> used_;
};

/// (x, y) of all vertices, without heights between.
class All {
 public:
  explicit All(std::span<const Vec2> positions) : positions_(positions) {}

  std::size_t size() const { return positions_.size(); }
  __m128 two(std::size_t i) const { return _mm_loadu_ps(&positions_[i].x); }
  __m128 one_twice(std::size_t i) const {
    const __m128i one = load(positions_[i]);
    return _mm_castsi128_ps(_mm_unpacklo_epi64(one, one));
  }

 private:
  std::span<const Vec2> positions_;
};

/// The largest |x| or |y|, or NaN if there is one. In several chains, because each waits for its last maximum.
template <class Vertices>
float largest_coordinate(const Vertices& vertices) {
  const __m128 magnitude = _mm_castsi128_ps(_mm_set1_epi32(0x7fffffff));
  __m128 largest[2] = {_mm_setzero_ps(), _mm_setzero_ps()}, not_a_number = _mm_setzero_ps();
  const auto offer = [&](__m128 first, __m128 second) {
    not_a_number = _mm_or_ps(not_a_number, _mm_cmpunord_ps(first, second));
    largest[0] = _mm_max_ps(largest[0], _mm_and_ps(first, magnitude));
    largest[1] = _mm_max_ps(largest[1], _mm_and_ps(second, magnitude));
  };
  std::size_t i = 0;
  for (; i + 3 < vertices.size(); i += 4) offer(vertices.two(i), vertices.two(i + 2));
  for (; i < vertices.size(); ++i) offer(vertices.one_twice(i), vertices.one_twice(i));
  if (_mm_movemask_ps(not_a_number) != 0) return std::numeric_limits<float>::quiet_NaN();
  alignas(16) float lanes[4];
  _mm_store_ps(lanes, _mm_max_ps(largest[0], largest[1]));
  return *std::max_element(std::begin(lanes), std::end(lanes));
}

bool is_in_domain(float reach) {
  return static_cast<double>(reach) >= rounding::smallest_reach &&
         static_cast<double>(reach) <= rounding::largest_reach;
}

template <class Position>
[[noreturn]] void reject(std::span<const Position> positions, std::span<const std::uint32_t> used,
                         float reach) {
  for (const std::uint32_t v : used)
    if (!std::isfinite(positions[v].x) || !std::isfinite(positions[v].y))
      throw std::invalid_argument("outline: vertex " + std::to_string(v) + " is not finite");
  throw std::invalid_argument("outline: reach " + shortest(reach) + " m is outside 1e-6 to 1e6 m");
}

/// Writes the points of a grid of so many steps a metre: at least 8 and a power of two, so that the products are exact;
/// the conversion rounds halves to even.
template <class Vertices>
void snap(const Vertices& vertices, double steps_per_metre, std::span<GridPoint> points) {
  const __m128 scale = _mm_set1_ps(static_cast<float>(steps_per_metre));
  const std::size_t last = vertices.size() - 1;
  for (std::size_t i = 0; i < last; i += 2)
    _mm_storeu_si128(reinterpret_cast<__m128i*>(&points[i]),
                     _mm_cvtps_epi32(_mm_mul_ps(vertices.two(i), scale)));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(&points[last]),
                   _mm_cvtps_epi32(_mm_mul_ps(vertices.one_twice(last), scale)));
}

template <class Vertices, class Position>
double snap_to_grid(const Vertices& vertices, std::span<const Position> positions,
                    std::span<const std::uint32_t> used, std::span<GridPoint> points) {
  const float reach = largest_coordinate(vertices);
  if (!is_in_domain(reach)) reject(positions, used, reach);
  const double step = std::ldexp(1.0, std::ilogb(reach) + 1 - grid_bits);
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
