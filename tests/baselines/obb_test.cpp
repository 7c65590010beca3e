// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "baselines/obb_overlap.hpp"
#include "baselines/obb_tree.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/scenes.hpp"

// The boxes themselves: that the test of two never misses, and that it does separate.

namespace bch::baselines {
namespace {

using test::Random;

constexpr double pi = std::numbers::pi;

std::vector<Facet> random_facets(Random& random, std::size_t count, const Eigen::Vector3f& size) {
  std::vector<Facet> facets(count);
  const auto point = [&] {
    Eigen::Vector3f p;
    for (Eigen::Index i = 0; i < 3; ++i) p[i] = size[i] * static_cast<float>(random.uniform(-1, 1));
    return p;
  };
  for (Facet& facet : facets) facet = {point(), point(), point()};
  return facets;
}

/// Triangles, slabs, needles, segments on the ground, points; some turned into oblique directions.
std::vector<Facet> facets_of_some_kind(Random& random) {
  const Eigen::Vector3f sizes[] = {
      {1, 1, 1}, {1, 1, 1e-4f}, {1, 1e-5f, 1e-5f}, {0.3f, 0.2f, 0}, {0.5f, 0, 0}};
  std::vector<Facet> facets = random_facets(random, 1 + random.below(12), sizes[random.below(5)]);
  if (random.below(3) == 0)
    for (Facet& facet : facets) facet[2] = facet[1];
  if (random.below(2) == 0) {
    const Eigen::Quaternionf turn(Eigen::AngleAxisf(
        static_cast<float>(random.uniform(-pi, pi)),
        Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), 0.1).normalized().cast<float>()));
    for (Facet& facet : facets)
      for (Eigen::Vector3f& p : facet) p = turn * p;
  }
  return facets;
}

/// Two trees placed so that a corner of one lies on a corner of the other: no pair of boxes that hold them
/// may be found apart. Headings are random or turn by quarters, so that edges are parallel in many.
TEST(BoxOverlap, NeverMissesACommonPoint) {
  Random random(1996);
  for (std::uint32_t i = 0; i < test::samples(100'000); ++i) {
    std::vector<Facet> facets_a = facets_of_some_kind(random), facets_b = facets_of_some_kind(random);
    const Eigen::Vector3f p = facets_a[random.below(static_cast<std::uint32_t>(facets_a.size()))][0];
    Eigen::Vector3f& q = facets_b[random.below(static_cast<std::uint32_t>(facets_b.size()))][1];
    q.z() = p.z();
    const double turn = random.below(2) == 0 ? random.uniform(-pi, pi) : random.below(4) * pi / 2;
    Placement at{std::cos(turn), std::sin(turn), 0, 0};
    const Point2 turned = at.place({q.x(), q.y()});
    at.x = static_cast<double>(p.x()) - turned.x;
    at.y = static_cast<double>(p.y()) - turned.y;
    const ObbTree a = build_obb_tree(facets_a), b = build_obb_tree(facets_b);
    const auto holds = [](const ObbNode& node, const Facet& facet, const Eigen::Vector3f& corner) {
      return node.is_leaf() && (facet[0] == corner || facet[1] == corner || facet[2] == corner);
    };
    ASSERT_TRUE(boxes_overlap(a.nodes[0], place(at, b.nodes[0]))) << "case " << i;
    for (const ObbNode& leaf_a : a.nodes)
      for (const ObbNode& leaf_b : b.nodes)
        if (leaf_a.is_leaf() && leaf_b.is_leaf() && holds(leaf_a, a.facets[leaf_a.facet()], p) &&
            holds(leaf_b, b.facets[leaf_b.facet()], q)) {
          ASSERT_TRUE(boxes_overlap(leaf_a, place(at, leaf_b))) << "case " << i;
        }
  }
}

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
