// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace bch::bench {

/// A mesh with every triangle cut into four at the middles of its edges, over and over.
class FineMesh {
 public:
  FineMesh(std::vector<std::array<std::uint32_t, 3>> triangles, std::size_t vertices, std::int64_t times);

  std::span<const std::array<std::uint32_t, 3>> triangles() const { return triangles_; }
  std::size_t vertices() const { return vertices_ + middles_.size(); }
  /// A pose of the mesh, with the positions of the new vertices after those of the old.
  std::vector<Eigen::Vector3f> finer(std::span<const Eigen::Vector3f> positions) const;

 private:
  void cut();

  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::size_t vertices_;                                          ///< of the mesh as it was
  std::vector<std::pair<std::uint32_t, std::uint32_t>> middles_;  ///< of which vertices, a new vertex each
};

}  // namespace bch::bench
