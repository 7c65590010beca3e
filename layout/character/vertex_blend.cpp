// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/vertex_blend.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace bch::detail {
namespace {

using Row = VertexBlend::Row;

template <class Position>
struct Work {
  const Row* rows;
  const Row* weighted;
  const std::uint32_t* first_row;
  const std::uint32_t* vertex;
  Position* positions;
};

/// Four lanes to add up for each coordinate.
template <std::size_t axes>
struct Products {
  __m128 axis[axes];
};

constexpr std::size_t axes_of(const Vec3*) {
  return 3;
}
constexpr std::size_t axes_of(const Vec2*) {
  return 2;
}

/// Returns the sum of the weighted products of the bones from an influence on.
template <std::size_t axes>
Products<axes> add_up(const Row* rows, const Row* weighted, const std::uint32_t* first_row,
                      std::uint32_t bones) {
  Products<axes> sum = {};
  for (std::uint32_t k = 0; k < bones; ++k) {
    const __m128 point = _mm_load_ps(weighted[k].at);
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const __m128 product = _mm_mul_ps(point, _mm_load_ps(rows[first_row[k] + axis].at));
      sum.axis[axis] = k == 0 ? product : _mm_add_ps(sum.axis[axis], product);
    }
  }
  return sum;
}

/// Lanes 0 and 2, and 1 and 3, of both.
__m128 halves(__m128 x, __m128 y) {
  return _mm_add_ps(_mm_unpacklo_ps(x, y), _mm_unpackhi_ps(x, y));
}

/// Writes two positions. Returns: what is NaN in some lane if one is not finite.
__m128 put(const Products<3>& p, const Products<3>& q, Vec3& at_p, Vec3& at_q) {
  const auto put_one = [](const Products<3>& sum, Vec3& at) {
    const auto& [x, y, z] = sum.axis;
    const __m128 xy = halves(x, y), zz = _mm_add_ps(z, _mm_movehl_ps(z, z));
    // The last lane is finite if the third is.
    const __m128 all = _mm_add_ps(_mm_movelh_ps(xy, zz), _mm_shuffle_ps(xy, zz, _MM_SHUFFLE(0, 1, 3, 2)));
    _mm_storel_pi(reinterpret_cast<__m64*>(&at), all);
    _mm_store_ss(&at.z, _mm_movehl_ps(all, all));
    return _mm_sub_ps(all, all);
  };
  return _mm_or_ps(put_one(p, at_p), put_one(q, at_q));
}
__m128 put(const Products<2>& p, const Products<2>& q, Vec2& at_p, Vec2& at_q) {
  const __m128 first = halves(p.axis[0], p.axis[1]), second = halves(q.axis[0], q.axis[1]);
  const __m128 both = _mm_add_ps(_mm_movelh_ps(first, second), _mm_movehl_ps(second, first));
  _mm_storel_pi(reinterpret_cast<__m64*>(&at_p), both);
  _mm_storeh_pi(reinterpret_cast<__m64*>(&at_q), both);
  return _mm_sub_ps(both, both);
}

/// Vertices of equally many bones, from an influence on, two at a time. `fixed`: how many bones, so that there is no loop
/// over them, or 0. `work` is a copy, which no position that is written can be part of.
/// Returns: NaN in some lane if a position is not finite.
template <class Position, std::uint32_t fixed>
__m128 blend_run(const Work<Position> work, std::size_t begin, std::size_t end, std::size_t influence,
                 std::uint32_t bones) {
  constexpr std::size_t axes = axes_of(static_cast<Position*>(nullptr));
  if (fixed != 0) bones = fixed;
  const Row* weighted = work.weighted + influence;
  const std::uint32_t* first_row = work.first_row + influence;
  __m128 not_finite = _mm_setzero_ps();
  const auto position = [&](std::size_t i) -> Position& { return work.positions[work.vertex[i]]; };
  std::size_t i = begin;
  for (; i + 1 < end; i += 2, weighted += 2 * bones, first_row += 2 * bones) {
    const auto p = add_up<axes>(work.rows, weighted, first_row, bones);
    const auto q = add_up<axes>(work.rows, weighted + bones, first_row + bones, bones);
    not_finite = _mm_or_ps(not_finite, put(p, q, position(i), position(i + 1)));
  }
  if (i == end) return not_finite;
  const auto last = add_up<axes>(work.rows, weighted, first_row, bones);
  return _mm_or_ps(not_finite, put(last, last, position(i), position(i)));
}

bool is_finite(const Vec3& position) {
  return std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z);
}
bool is_finite(Vec2 position) {
  return std::isfinite(position.x) && std::isfinite(position.y);
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
    const Vec3& at = character.vertices[v];
    for (std::uint32_t i = begin[v]; i < begin[v + 1]; ++i) {
      const auto [bone, weight] = character.influences[i];
      weighted_.push_back({{weight * at.x, weight * at.y, weight * at.z, weight}});
      const auto found = std::lower_bound(bones_.begin(), bones_.end(), bone);
      first_row_.push_back(static_cast<std::uint32_t>(3 * (found - bones_.begin())));
    }
  }
}

template <class Position>
std::optional<std::uint32_t> VertexBlend::blend_all(std::span<const AffineRows> maps,
                                                    std::span<Position> positions) {
  for (std::size_t b = 0; b < maps.size(); ++b)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 4; ++j) rows_[3 * b + i].at[j] = static_cast<float>(maps[b].row[i][j]);

  const Work<Position> work{rows_.data(), weighted_.data(), first_row_.data(), vertex_.data(),
                            positions.data()};
  __m128 not_finite = _mm_setzero_ps();
  std::size_t influence = 0, begin = 0;
  for (const auto [bones, end] : runs_) {
    constexpr decltype(&blend_run<Position, 0>) of_few[] = {blend_run<Position, 0>, blend_run<Position, 1>,
                                                            blend_run<Position, 2>, blend_run<Position, 3>,
                                                            blend_run<Position, 4>};
    const auto run = bones < std::size(of_few) ? of_few[bones] : blend_run<Position, 0>;
    not_finite = _mm_or_ps(not_finite, run(work, begin, end, influence, bones));
    influence += (end - begin) * bones;
    begin = end;
  }
  if (_mm_movemask_ps(_mm_cmpunord_ps(not_finite, not_finite)) == 0) return {};
  const auto first = std::find_if(positions.begin(), positions.end(),
                                  [](const Position& position) { return !is_finite(position); });
  return static_cast<std::uint32_t>(first - positions.begin());
}

std::optional<std::uint32_t> VertexBlend::blend(std::span<const AffineRows> maps, std::span<Vec3> positions) {
  return blend_all(maps, positions);
}

std::optional<std::uint32_t> VertexBlend::blend(std::span<const AffineRows> maps, std::span<Vec2> positions) {
  return blend_all(maps, positions);
}

}  // namespace bch::detail
