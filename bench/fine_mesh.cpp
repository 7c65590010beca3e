// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/fine_mesh.hpp"

#include <algorithm>
#include <map>

namespace bch::bench {

FineMesh::FineMesh(std::vector<std::array<std::uint32_t, 3>> triangles, std::size_t vertices,
                   std::int64_t times)
    : triangles_(std::move(triangles)), vertices_(vertices) {
  for (std::int64_t i = 0; i < times; ++i) cut();
}

void FineMesh::cut() {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_of;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const std::pair<std::uint32_t, std::uint32_t> edge = std::minmax(a, b);
    const auto [found, is_new] = middle_of.insert({edge, static_cast<std::uint32_t>(this->vertices())});
    if (is_new) middles_.push_back(edge);
    return found->second;
  };
  std::vector<std::array<std::uint32_t, 3>> finer;
  for (const auto& [a, b, c] : triangles_) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  triangles_ = std::move(finer);
}

std::vector<Eigen::Vector3f> FineMesh::finer(std::span<const Eigen::Vector3f> positions) const {
  std::vector<Eigen::Vector3f> result(positions.begin(), positions.end());
  for (const auto& [a, b] : middles_) result.emplace_back(0.5f * (result[a] + result[b]));
  return result;
}

}  // namespace bch::bench
