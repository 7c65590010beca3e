// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/vertex_blend.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "layout/base/number_class.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {
namespace {

using Row = VertexBlend::Row;
using Simd = BaseLanes;
using Float = Simd::Float;

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
  Float axis[axes];
};

constexpr std::size_t axes_of(const Vec3*) {
  return 3;
}
constexpr std::size_t axes_of(const SpaceRow*) {
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
    const Float point = Float::load_aligned(weighted[k].at);
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const Float product = point * Float::load_aligned(rows[first_row[k] + axis].at);
      if (k == 0)
        sum.axis[axis] = product;
      else
        sum.axis[axis] = sum.axis[axis] + product;
    }
  }
  return sum;
}

/// Lanes 0 and 2, and 1 and 3, of both.
Float halves(Float x, Float y) {
  return Simd::shuffle<0, 4, 1, 5>(x, y) + Simd::shuffle<2, 6, 3, 7>(x, y);
}

/// Returns a position. The last lane is finite if the third is.
Float position_of(const Products<3>& sum) {
  const auto& [x, y, z] = sum.axis;
  const Float xy = halves(x, y), zz = z + Simd::shuffle<2, 3, 2, 3>(z, z);
  return Simd::shuffle<0, 1, 4, 5>(xy, zz) + Simd::shuffle<2, 3, 5, 4>(xy, zz);
}

// These write two positions. They return what is NaN in some lane if one is not finite.
Float put(const Products<3>& p, const Products<3>& q, Vec3& at_p, Vec3& at_q) {
  const auto put_one = [](const Products<3>& sum, Vec3& at) {
    const Float all = position_of(sum);
    at = {Simd::lane(all, 0), Simd::lane(all, 1), Simd::lane(all, 2)};
    return all - all;
  };
  return put_one(p, at_p) | put_one(q, at_q);
}
Float put(const Products<3>& p, const Products<3>& q, SpaceRow& at_p, SpaceRow& at_q) {
  const Float first = position_of(p), second = position_of(q);
  first.store_aligned(&at_p.x);
  second.store_aligned(&at_q.x);
  return (first - first) | (second - second);
}
Float put(const Products<2>& p, const Products<2>& q, Vec2& at_p, Vec2& at_q) {
  const Float first = halves(p.axis[0], p.axis[1]), second = halves(q.axis[0], q.axis[1]);
  const Float both = Simd::shuffle<0, 1, 4, 5>(first, second) + Simd::shuffle<2, 3, 6, 7>(first, second);
  Simd::store_pair(&at_p, both, 0);
  Simd::store_pair(&at_q, both, 1);
  return both - both;
}

/// Vertices of equally many bones, from an influence on, two at a time. `fixed`: how many bones, so that there is no loop
/// over them, or 0. `work` is a copy, which no position that is written can be part of.
/// Returns: NaN in some lane if a position is not finite.
template <class Position, std::uint32_t fixed>
Float blend_run(const Work<Position> work, std::size_t begin, std::size_t end, std::size_t influence,
                std::uint32_t bones) {
  constexpr std::size_t axes = axes_of(static_cast<Position*>(nullptr));
  if (fixed != 0) bones = fixed;
  const Row* weighted = work.weighted + influence;
  const std::uint32_t* first_row = work.first_row + influence;
  Float not_finite(0.0f);
  const auto position = [&](std::size_t i) -> Position& { return work.positions[work.vertex[i]]; };
  std::size_t i = begin;
  for (; i + 1 < end; i += 2, weighted += 2 * bones, first_row += 2 * bones) {
    const auto p = add_up<axes>(work.rows, weighted, first_row, bones);
    const auto q = add_up<axes>(work.rows, weighted + bones, first_row + bones, bones);
    not_finite = not_finite | put(p, q, position(i), position(i + 1));
  }
  if (i == end) return not_finite;
  const auto last = add_up<axes>(work.rows, weighted, first_row, bones);
  return not_finite | put(last, last, position(i), position(i));
}

template <class Position>
bool position_is_finite(const Position& position) {
  return detail::is_finite(position.x) && detail::is_finite(position.y) && detail::is_finite(position.z);
}
bool position_is_finite(const Vec2& position) {
  return detail::is_finite(position.x) && detail::is_finite(position.y);
}

}  // namespace

std::vector<PointInfluence> influences_of(const Character& character) {
  std::vector<PointInfluence> all;
  for (std::size_t v = 0; v < character.vertices.size(); ++v)
    for (std::uint32_t i = character.influence_begin[v]; i < character.influence_begin[v + 1]; ++i)
      all.push_back({character.influences[i].bone, character.influences[i].weight, character.vertices[v]});
  return all;
}

VertexBlend::VertexBlend(const Character& character)
    : VertexBlend(character.influence_begin, influences_of(character)) {}

VertexBlend::VertexBlend(std::span<const std::uint32_t> begin, std::span<const PointInfluence> influences)
    : vertex_(begin.size() - 1) {
  std::iota(vertex_.begin(), vertex_.end(), 0);
  const auto count = [&](std::uint32_t v) { return begin[v + 1] - begin[v]; };
  std::sort(vertex_.begin(), vertex_.end(), [&](std::uint32_t v, std::uint32_t w) {
    return count(v) != count(w) ? count(v) < count(w) : v < w;
  });

  for (const PointInfluence& influence : influences) bones_.push_back(influence.bone);
  std::sort(bones_.begin(), bones_.end());
  bones_.erase(std::unique(bones_.begin(), bones_.end()), bones_.end());
  rows_.resize(3 * bones_.size());

  for (const std::uint32_t v : vertex_) {
    if (runs_.empty() || runs_.back().bones != count(v))
      runs_.push_back({count(v), runs_.empty() ? 0 : runs_.back().end});
    ++runs_.back().end;
    for (std::uint32_t i = begin[v]; i < begin[v + 1]; ++i) {
      const auto& [bone, weight, at] = influences[i];
      weighted_.push_back({{weight * at.x, weight * at.y, weight * at.z, weight}});
      const auto found = std::lower_bound(bones_.begin(), bones_.end(), bone);
      first_row_.push_back(static_cast<std::uint32_t>(3 * (found - bones_.begin())));
    }
  }
}

template <class Position>
std::optional<std::uint32_t> VertexBlend::blend_all(std::span<const Affine3d> maps,
                                                    std::span<Position> positions) {
  for (std::size_t b = 0; b < maps.size(); ++b)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 4; ++j) rows_[3 * b + i].at[j] = static_cast<float>(maps[b].rows[i][j]);

  const Work<Position> work{rows_.data(), weighted_.data(), first_row_.data(), vertex_.data(),
                            positions.data()};
  Float not_finite(0.0f);
  std::size_t influence = 0, begin = 0;
  for (const auto [bones, end] : runs_) {
    constexpr decltype(&blend_run<Position, 0>) of_few[] = {blend_run<Position, 0>, blend_run<Position, 1>,
                                                            blend_run<Position, 2>, blend_run<Position, 3>,
                                                            blend_run<Position, 4>};
    const auto run = bones < std::size(of_few) ? of_few[bones] : blend_run<Position, 0>;
    not_finite = not_finite | run(work, begin, end, influence, bones);
    influence += (end - begin) * bones;
    begin = end;
  }
  if (!xsimd::any(xsimd::isnan(not_finite))) return {};
  const auto first = std::find_if(positions.begin(), positions.end(),
                                  [](const Position& position) { return !position_is_finite(position); });
  return static_cast<std::uint32_t>(first - positions.begin());
}

std::optional<std::uint32_t> VertexBlend::blend(std::span<const Affine3d> maps, std::span<Vec3> positions) {
  return blend_all(maps, positions);
}

std::optional<std::uint32_t> VertexBlend::blend(std::span<const Affine3d> maps,
                                                std::span<SpaceRow> positions) {
  return blend_all(maps, positions);
}

std::optional<std::uint32_t> VertexBlend::blend(std::span<const Affine3d> maps, std::span<Vec2> positions) {
  return blend_all(maps, positions);
}

}  // namespace bch::detail
