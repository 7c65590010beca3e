// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/workload.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "layout/base/random.hpp"
#include "layout/character/eigen.hpp"

namespace bch::bench {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Adds the middle of two vertices behind the character's others.
void add_middle(Character& character, std::uint32_t a, std::uint32_t b) {
  std::map<std::uint32_t, float> weights;
  for (const std::uint32_t end : {a, b})
    for (std::uint32_t i = character.influence_begin[end]; i < character.influence_begin[end + 1]; ++i)
      weights[character.influences[i].bone] += 0.5f * character.influences[i].weight;
  for (const auto& [bone, weight] : weights) character.influences.push_back({bone, weight});
  character.influence_begin.push_back(static_cast<std::uint32_t>(character.influences.size()));
  character.vertices.push_back(detail::vec3(
      0.5f * (detail::to_eigen(character.vertices[a]) + detail::to_eigen(character.vertices[b]))));
}

/// Returns the normals of the surface at each vertex, at rest.
std::vector<Eigen::Vector3f> normals_of(const Character& character) {
  std::vector<Eigen::Vector3f> normals(character.vertices.size(), Eigen::Vector3f::Zero());
  for (const auto& [a, b, c] : character.triangles) {
    const Eigen::Vector3f at = detail::to_eigen(character.vertices[a]);
    const Eigen::Vector3f normal =
        (detail::to_eigen(character.vertices[b]) - at).cross(detail::to_eigen(character.vertices[c]) - at);
    for (const std::uint32_t v : {a, b, c}) normals[v] += normal;
  }
  return normals;
}

/// Cuts every triangle into four. The middles of edges move along the surface's normal, in or out, by up to so large a
/// share of the edge's length.
void cut(Character& character, double relief, detail::Random& random) {
  const std::vector<Eigen::Vector3f> normals = normals_of(character);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_of;
  const auto middle = [&](std::uint32_t v, std::uint32_t w) {
    const auto [a, b] = std::minmax(v, w);
    const auto [found, is_new] =
        middle_of.try_emplace({a, b}, static_cast<std::uint32_t>(character.vertices.size()));
    if (!is_new) return found->second;
    add_middle(character, a, b);
    if (relief > 0) {
      const float length =
          (detail::to_eigen(character.vertices[a]) - detail::to_eigen(character.vertices[b])).norm();
      const Eigen::Vector3f normal = (normals[a].normalized() + normals[b].normalized()).normalized();
      const auto fraction = static_cast<float>(random.uniform(2 * relief) - relief);
      Vec3& at = character.vertices.back();
      at = detail::vec3(detail::to_eigen(at) + fraction * length * normal);
    }
    return found->second;
  };
  Triangles finer;
  for (const auto [a, b, c] : character.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  character.triangles = std::move(finer);
}

Character cut_times(Character character, int times, double relief) {
  detail::Random random(5);
  for (int i = 0; i < times; ++i) cut(character, relief, random);
  return character;
}

}  // namespace

Character finer(const Character& character, int times) {
  return cut_times(character, times, 0);
}

Character with_relief(const Character& character, int times) {
  return cut_times(character, times, 0.125);
}

}  // namespace bch::bench
