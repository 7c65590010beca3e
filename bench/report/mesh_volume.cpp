// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/mesh_volume.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "layout/character/eigen.hpp"

namespace bch::report {

bool is_closed(std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int>
      balance;  // of passes from the lower to the higher index
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = t[i], to = t[(i + 1) % 3];
      const std::pair<std::uint32_t, std::uint32_t> edge = std::minmax(from, to);
      balance[edge] += from < to ? 1 : -1;
    }
  return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

double enclosed_volume(std::span<const Vec3> positions,
                       std::span<const std::array<std::uint32_t, 3>> triangles) {
  double volume = 0;  // of the tetrahedra that triangles make with the origin
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3d p = detail::to_eigen(positions[a]).cast<double>(),
                          q = detail::to_eigen(positions[b]).cast<double>(),
                          r = detail::to_eigen(positions[c]).cast<double>();
    volume += p.x() * (q.y() * r.z() - q.z() * r.y()) + p.y() * (q.z() * r.x() - q.x() * r.z()) +
              p.z() * (q.x() * r.y() - q.y() * r.x());
  }
  return volume / 6;
}

}  // namespace bch::report
