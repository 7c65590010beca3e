// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/vertex_blend.hpp"

#include <algorithm>
#include <numeric>

#include "layout/base/build_implementation.hpp"
#include "layout/base/number_class.hpp"
#include "layout/character/blend_loops.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t row = 8;  ///< floats: four for either point of a pair

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

VertexBlend::VertexBlend(std::span<const std::uint32_t> begin, std::span<const PointInfluence> influences) {
  for (const PointInfluence& influence : influences) bones_.push_back(influence.bone);
  std::sort(bones_.begin(), bones_.end());
  bones_.erase(std::unique(bones_.begin(), bones_.end()), bones_.end());
  maps_.resize(3 * row * bones_.size());

  const auto of = [&](std::uint32_t v) { return influences.subspan(begin[v], begin[v + 1] - begin[v]); };
  const auto has_less_bones = [&](std::uint32_t v, std::uint32_t w) {
    const auto of_v = of(v), of_w = of(w);
    if (of_v.size() != of_w.size()) return of_v.size() < of_w.size();
    return std::lexicographical_compare(
        of_v.begin(), of_v.end(), of_w.begin(), of_w.end(),
        [](const PointInfluence& a, const PointInfluence& b) { return a.bone < b.bone; });
  };
  std::vector<std::uint32_t> order(begin.size() - 1);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::uint32_t v, std::uint32_t w) {
    return has_less_bones(v, w) || (!has_less_bones(w, v) && v < w);
  });
  for (std::size_t i = 0; i < order.size(); i += pairs_.back().number[0] == pairs_.back().number[1] ? 1 : 2) {
    const std::uint32_t v = order[i];
    const std::uint32_t w = i + 1 < order.size() && !has_less_bones(v, order[i + 1]) ? order[i + 1] : v;
    pairs_.push_back({{v, w}});
    const auto count = static_cast<std::uint32_t>(of(v).size());
    if (runs_.empty() || runs_.back().bones != count) runs_.push_back({count, 0});
    runs_.back().end = static_cast<std::uint32_t>(pairs_.size());
    for (std::uint32_t k = 0; k < count; ++k) {
      for (const std::uint32_t point : {v, w}) {
        const auto& [bone, weight, at] = of(point)[k];
        weighted_.insert(weighted_.end(), {weight * at.x, weight * at.y, weight * at.z, weight});
      }
      const auto found = std::lower_bound(bones_.begin(), bones_.end(), of(v)[k].bone);
      first_.push_back(
          static_cast<std::uint32_t>(3 * row * static_cast<std::size_t>(found - bones_.begin())));
    }
  }
}

template <class Position>
std::optional<std::uint32_t> VertexBlend::blend_all(std::span<const Affine3d> maps,
                                                    std::span<Position> positions,
                                                    bool (*loop)(const BlendPairs&, Position*) noexcept) {
  float* to = maps_.data();
  for (const Affine3d& map : maps)
    for (const auto& of_map : map.rows)
      for (int twice = 0; twice < 2; ++twice)
        for (const double number : of_map) *to++ = static_cast<float>(number);

  if (loop({runs_.data(), runs_.size(), maps_.data(), first_.data(), weighted_.data(), pairs_.data()},
           positions.data()))
    return {};
  const auto first = std::find_if(positions.begin(), positions.end(),
                                  [](const Position& position) { return !position_is_finite(position); });
  return static_cast<std::uint32_t>(first - positions.begin());
}

std::optional<std::uint32_t> VertexBlend::blend(std::span<const Affine3d> maps, std::span<Vec3> positions) {
  return blend_all(maps, positions, best_build_implementation().loops.blend.to_vertices);
}

std::optional<std::uint32_t> VertexBlend::blend(std::span<const Affine3d> maps,
                                                std::span<SpaceRow> positions) {
  return blend_all(maps, positions, best_build_implementation().loops.blend.to_space);
}

std::optional<std::uint32_t> VertexBlend::blend(std::span<const Affine3d> maps, std::span<Vec2> positions) {
  return blend_all(maps, positions, best_build_implementation().loops.blend.to_ground);
}

}  // namespace bch::detail
