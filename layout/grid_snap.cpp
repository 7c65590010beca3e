// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/grid_snap.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/rounding.hpp"

namespace bch {
namespace {

constexpr int grid_bits = 23;

/// (x, y) of two vertices. Eight bytes of each: behind the last vertex there need not be more than its height.
__m128 two_positions(const Eigen::Vector3f& p, const Eigen::Vector3f& q) {
  const auto load = [](const Eigen::Vector3f& position) {
    return _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(position.data())));
  };
  return _mm_movelh_ps(load(p), load(q));
}

/// The largest |x| or |y|, or NaN if there is one. In several chains, because each waits for its last maximum.
float largest_coordinate(std::span<const Eigen::Vector3f> positions, std::span<const std::uint32_t> used) {
  const __m128 magnitude = _mm_castsi128_ps(_mm_set1_epi32(0x7fffffff));
  __m128 largest[2] = {_mm_setzero_ps(), _mm_setzero_ps()}, not_a_number = _mm_setzero_ps();
  const auto offer = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
    const __m128 first = two_positions(positions[used[i]], positions[used[j]]);
    const __m128 second = two_positions(positions[used[k]], positions[used[l]]);
    not_a_number = _mm_or_ps(not_a_number, _mm_cmpunord_ps(first, second));
    largest[0] = _mm_max_ps(largest[0], _mm_and_ps(first, magnitude));
    largest[1] = _mm_max_ps(largest[1], _mm_and_ps(second, magnitude));
  };
  std::size_t i = 0;
  for (; i + 3 < used.size(); i += 4) offer(i, i + 1, i + 2, i + 3);
  for (; i < used.size(); ++i) offer(i, i, i, i);
  if (_mm_movemask_ps(not_a_number) != 0) return std::numeric_limits<float>::quiet_NaN();
  alignas(16) float lanes[4];
  _mm_store_ps(lanes, _mm_max_ps(largest[0], largest[1]));
  return *std::max_element(std::begin(lanes), std::end(lanes));
}

[[noreturn]] void reject(std::span<const Eigen::Vector3f> positions, std::span<const std::uint32_t> used,
                         float reach) {
  for (const std::uint32_t v : used)
    if (!std::isfinite(positions[v].x()) || !std::isfinite(positions[v].y()))
      throw std::invalid_argument("outline: vertex " + std::to_string(v) + " is not finite");
  throw std::invalid_argument("outline: reach " + std::to_string(reach) + " m is outside 1e-6 to 1e6 m");
}

}  // namespace

double snap_to_grid(std::span<const Eigen::Vector3f> positions, std::span<const std::uint32_t> used,
                    std::span<GridPoint> points) {
  const float reach = largest_coordinate(positions, used);
  if (!(static_cast<double>(reach) >= rounding::smallest_reach &&
        static_cast<double>(reach) <= rounding::largest_reach))
    reject(positions, used, reach);

  const double step = std::ldexp(1.0, std::ilogb(reach) + 1 - grid_bits), steps_per_metre = 1 / step;
  // At least 8 and a power of two, so that the products are exact; the conversion rounds halves to even.
  const __m128 scale = _mm_set1_ps(static_cast<float>(steps_per_metre));
  const auto snapped = [&](std::size_t i, std::size_t j) {
    return _mm_cvtps_epi32(_mm_mul_ps(two_positions(positions[used[i]], positions[used[j]]), scale));
  };
  const std::size_t last = used.size() - 1;
  for (std::size_t i = 0; i < last; i += 2)
    _mm_storeu_si128(reinterpret_cast<__m128i*>(&points[i]), snapped(i, i + 1));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(&points[last]), snapped(last, last));
  return step;
}

}  // namespace bch
