// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/mesh_detail.hpp"

#include "layout/character/eigen.hpp"
#include "tests/support/test.hpp"

namespace bch::bench {
namespace {

TEST(MeshDetail, ReliefStandsOutOfTheSurface) {
  const Character man = default_male(), flat = finer(man, 1), relief = with_relief(man, 1);
  ASSERT_EQ(relief.vertices.size(), flat.vertices.size());
  EXPECT_EQ(relief.triangles, flat.triangles);
  float farthest = 0;
  for (std::size_t v = 0; v < flat.vertices.size(); ++v) {
    const float moved = (detail::to_eigen(relief.vertices[v]) - detail::to_eigen(flat.vertices[v])).norm();
    EXPECT_TRUE(v >= man.vertices.size() || moved == 0) << v;
    farthest = std::max(farthest, moved);
  }
  EXPECT_GT(farthest, 0.003f);
  EXPECT_LT(farthest, 0.03f);
  EXPECT_EQ(with_relief(man, 1).vertices, relief.vertices);
}

}  // namespace
}  // namespace bch::bench
