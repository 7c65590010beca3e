// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <Eigen/Geometry>

#include "baselines/obb_overlap.hpp"
#include "baselines/obb_tree.hpp"
#include "tests/support/test.hpp"

// The boxes themselves: that the test of two separates. That it misses nothing, the answers of their trees tell.

namespace bch::baselines {
namespace {

/// The corners of a block, as facets, after a rotation.
std::vector<Facet> block(const Eigen::Vector3f& half, const Eigen::Quaternionf& turn) {
  std::vector<Facet> facets;
  for (int i = 0; i < 8; ++i) {
    const auto corner = [&](int bits) {
      return Eigen::Vector3f(turn * Eigen::Vector3f((bits & 1) != 0 ? half.x() : -half.x(),
                                                    (bits & 2) != 0 ? half.y() : -half.y(),
                                                    (bits & 4) != 0 ? half.z() : -half.z()));
    };
    facets.push_back({corner(i), corner(i ^ 1), corner(i ^ 2)});
  }
  return facets;
}

/// A ridge along x below a ridge along y, a millimetre apart or into each other: only the product of those
/// two edges separates them.
TEST(BoxOverlap, FindsWhatOnlyAProductOfEdgesSeparates) {
  const Eigen::Quaternionf about_x(Eigen::AngleAxisf(0.7853982f, Eigen::Vector3f::UnitX()));
  const Eigen::Vector3f half(1.0f, 0.5f, 0.4f);
  for (const double gap : {0.001, -0.001}) {
    std::vector<Facet> lower = block(half, about_x), upper = lower;
    float top = -10;
    for (const Facet& facet : lower)
      for (const Eigen::Vector3f& p : facet) top = std::max(top, p.z());
    for (Facet& facet : upper)
      for (Eigen::Vector3f& p : facet) p.z() += 2 * top + static_cast<float>(gap);
    const ObbTree a = build_obb_tree(lower), b = build_obb_tree(upper);
    const Placement quarter{0, 1, 0, 0};
    EXPECT_EQ(boxes_overlap(a.nodes[0], place(quarter, b.nodes[0])), gap < 0) << gap;
  }
}

/// Blocks of the same direction, moved along an axis to just short of touching and just beyond.
TEST(BoxOverlap, IsTightToTheMargin) {
  const Eigen::Vector3f half(0.5f, 0.3f, 0.2f);
  const ObbTree tree = build_obb_tree(block(half, Eigen::Quaternionf::Identity()));
  for (const double gap : {1e-4, -1e-4}) {
    EXPECT_EQ(boxes_overlap(tree.nodes[0], place({1, 0, 1 + gap, 0}, tree.nodes[0])), gap < 0);
    EXPECT_EQ(boxes_overlap(tree.nodes[0], place({1, 0, 0, 0.6 + gap}, tree.nodes[0])), gap < 0);
    EXPECT_EQ(boxes_overlap(tree.nodes[0], place({0, 1, 0, 0.8 + gap}, tree.nodes[0])), gap < 0);
  }
}

TEST(ObbTree, RejectsWhatItCannotHold) {
  const auto message = [](std::vector<Facet> facets) {
    return test::complaint([&] { build_obb_tree(std::move(facets)); });
  };
  const Eigen::Vector3f zero = Eigen::Vector3f::Zero(), one = Eigen::Vector3f::Ones();
  EXPECT_EQ(message({}), "box tree: no facets");
  EXPECT_EQ(message({{zero, one, one}, {zero, NAN * one, one}}), "box tree: facet 1 is not finite");
  EXPECT_EQ(message({{zero, zero, zero}}), "box tree: reach 0 m is outside 1e-6 to 1e6 m");
  EXPECT_EQ(message({{zero, 2e6f * one, one}}),
            "box tree: reach 3464101.6151377545 m is outside 1e-6 to 1e6 m");
}

}  // namespace
}  // namespace bch::baselines
