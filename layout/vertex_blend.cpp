// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/vertex_blend.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <iterator>
#include <numeric>

namespace bch {
namespace {

/// The sums of the lanes of x, y and z, and something in the last lane that is finite if the third is.
__m128 sums(__m128 x, __m128 y, __m128 z) {
  const __m128 xy = _mm_add_ps(_mm_unpacklo_ps(x, y), _mm_unpackhi_ps(x, y));
  const __m128 zz = _mm_add_ps(z, _mm_movehl_ps(z, z));
  return _mm_add_ps(_mm_movelh_ps(xy, zz), _mm_shuffle_ps(xy, zz, _MM_SHUFFLE(0, 1, 3, 2)));
}

using Row = VertexBlend::Row;

struct Work {
  const Row* rows;
  const Row* weighted;
  const std::uint32_t* first_row;
  const std::uint32_t* vertex;
  Eigen::Vector3f* positions;
};

/// Vertices of equally many bones, from an influence on. `fixed`: how many, so that there is no loop over them, or 0.
/// Returns: NaN in some lane if a position is not finite.
template <std::uint32_t fixed>
__m128 blend_run(const Work& work, std::size_t begin, std::size_t end, std::size_t influence,
                 std::uint32_t bones) {
  if (fixed != 0) bones = fixed;
  const Row* weighted = work.weighted + influence;
  const std::uint32_t* first_row = work.first_row + influence;
  __m128 not_finite = _mm_setzero_ps();
  for (std::size_t i = begin; i < end; ++i, weighted += bones, first_row += bones) {
    __m128 sum[3] = {};
    for (std::uint32_t k = 0; k < bones; ++k) {
      const __m128 point = _mm_load_ps(weighted[k].at);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const __m128 product = _mm_mul_ps(point, _mm_load_ps(work.rows[first_row[k] + axis].at));
        sum[axis] = k == 0 ? product : _mm_add_ps(sum[axis], product);
      }
    }
    const __m128 position = sums(sum[0], sum[1], sum[2]);
    not_finite = _mm_or_ps(not_finite, _mm_sub_ps(position, position));
    float* const to = work.positions[work.vertex[i]].data();
    _mm_storel_pi(reinterpret_cast<__m64*>(to), position);
    _mm_store_ss(to + 2, _mm_movehl_ps(position, position));
  }
  return not_finite;
}

}  // namespace

VertexBlend::VertexBlend(const Character& character) : vertex_(character.vertices.size()) {
  const auto& begin = character.influence_begin;
  std::iota(vertex_.begin(), vertex_.end(), 0);
  const auto count = [&](std::uint32_t v) { return begin[v + 1] - begin[v]; };
  std::sort(vertex_.begin(), vertex_.end(), [&](std::uint32_t v, std::uint32_t w) {
    return count(v) != count(w) ? count(v) < count(w) : v < w;
  });

  for (const Influence& influence : character.influences) bones_.push_back(influence.bone);
  std::sort(bones_.begin(), bones_.end());
  bones_.erase(std::unique(bones_.begin(), bones_.end()), bones_.end());
  rows_.resize(3 * bones_.size());

  for (const std::uint32_t v : vertex_) {
    if (runs_.empty() || runs_.back().bones != count(v))
      runs_.push_back({count(v), runs_.empty() ? 0 : runs_.back().end});
    ++runs_.back().end;
    const Eigen::Vector3f& at = character.vertices[v];
    for (std::uint32_t i = begin[v]; i < begin[v + 1]; ++i) {
      const auto [bone, weight] = character.influences[i];
      weighted_.push_back({{weight * at.x(), weight * at.y(), weight * at.z(), weight}});
      const auto found = std::lower_bound(bones_.begin(), bones_.end(), bone);
      first_row_.push_back(static_cast<std::uint32_t>(3 * (found - bones_.begin())));
    }
  }
}

std::optional<std::uint32_t> VertexBlend::blend(std::span<const AffineRows> maps,
                                                std::span<Eigen::Vector3f> positions) {
  for (std::size_t b = 0; b < maps.size(); ++b)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 4; ++j) rows_[3 * b + i].at[j] = static_cast<float>(maps[b].row[i][j]);

  const Work work{rows_.data(), weighted_.data(), first_row_.data(), vertex_.data(), positions.data()};
  __m128 not_finite = _mm_setzero_ps();
  std::size_t influence = 0, begin = 0;
  for (const auto [bones, end] : runs_) {
    constexpr decltype(&blend_run<0>) of_few[] = {blend_run<0>, blend_run<1>, blend_run<2>, blend_run<3>,
                                                  blend_run<4>};
    const auto run = bones < std::size(of_few) ? of_few[bones] : blend_run<0>;
    not_finite = _mm_or_ps(not_finite, run(work, begin, end, influence, bones));
    influence += (end - begin) * bones;
    begin = end;
  }
  if (_mm_movemask_ps(_mm_cmpunord_ps(not_finite, not_finite)) == 0) return {};
  const auto first = std::find_if(positions.begin(), positions.end(),
                                  [](const Eigen::Vector3f& position) { return !position.allFinite(); });
  return static_cast<std::uint32_t>(first - positions.begin());
}

}  // namespace bch
