// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/default_character/body_weights.hpp"

#include <algorithm>

#include "layout/character/eigen.hpp"

namespace bch::detail {
namespace {

using Weights = std::array<double, body_joint_count>;

std::vector<Weights> diffused(const BodySurface& surface, int rounds) {
  const auto around = neighbours(surface);
  std::vector<Weights> weights(surface.positions.size(), Weights{});
  for (std::size_t v = 0; v < weights.size(); ++v) {
    const SkinTag& tag = surface.tags[v];
    weights[v][tag.joint] += 1 - tag.mix;
    weights[v][tag.next] += tag.mix;
  }
  std::vector<Weights> next(weights.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t v = 0; v < weights.size(); ++v) {
      const double fraction = 0.5 / static_cast<double>(around[v].size());
      for (std::size_t j = 0; j < body_joint_count; ++j) {
        double sum = 0;
        for (const std::uint32_t n : around[v]) sum += weights[n][j];
        next[v][j] = 0.5 * weights[v][j] + fraction * sum;
      }
    }
    weights.swap(next);
  }
  return weights;
}

void append_influences(Character& character, const Weights& weights) {
  const double negligible = 0.01;
  std::vector<std::pair<double, std::uint32_t>> kept;
  for (std::uint32_t j = 0; j < body_joint_count; ++j)
    if (weights[j] > negligible) kept.emplace_back(weights[j], j);
  std::sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  kept.resize(std::min(kept.size(), max_influences));
  double total = 0;
  for (const auto& [weight, joint] : kept) total += weight;
  for (const auto& [weight, joint] : kept)
    character.influences.push_back({joint, static_cast<float>(weight / total)});
}

}  // namespace

void attach_skin(Character& character, const BodySurface& surface, const JointPositions& joints) {
  for (std::uint32_t j = 0; j < body_joint_count; ++j)
    character.bones.push_back({j, translation(-joints[j].cast<float>())});
  character.influence_begin.push_back(0);
  for (const Weights& weights : diffused(surface, 3)) {
    append_influences(character, weights);
    character.influence_begin.push_back(static_cast<std::uint32_t>(character.influences.size()));
  }
  for (const Eigen::Vector3d& p : surface.positions) character.vertices.push_back(vec3(p.cast<float>()));
  character.triangles = triangulated(surface);
}

}  // namespace bch::detail
