// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <Eigen/Geometry>

#include "baselines/capsule_fit.hpp"
#include "baselines/capsule_lanes.hpp"
#include "baselines/obb_overlap.hpp"
#include "baselines/obb_tree.hpp"
#include "baselines/ragdoll.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

namespace bch::baselines {
namespace {

using baselines::Capsule;
using baselines::PosedRagdoll;
using Eigen::Vector3d;
using Segment = std::array<Vector3d, 2>;
using test::Random;

Vec3 random_point(Random& random, double around) {
  const auto draw = [&] { return static_cast<float>(random.uniform(-around, around)); };
  return {draw(), draw(), draw()};
}

std::vector<Capsule> random_capsules(Random& random) {
  std::vector<Capsule> capsules(1 + random.below(20));
  for (Capsule& capsule : capsules) {
    const Vec3 from = random_point(random, 0.8);
    const Vec3 along = random.below(5) == 0 ? Vec3{} : random_point(random, 0.2);
    capsule = {0, {from, {from.x + along.x, from.y + along.y, from.z + along.z}}, 0, 0.1f};
  }
  return capsules;
}

/// The distance from a segment is convex along the other one, so that thirds of it find the least.
double segment_distance(const Segment& a, const Segment& b) {
  double low = 0, high = 1;
  const auto at = [&](double t) { return baselines::way_from(b, a[0] + t * (a[1] - a[0])).norm(); };
  for (int i = 0; i < 60; ++i) {
    const double third = (high - low) / 3;
    (at(low + third) < at(high - third) ? high : low) += at(low + third) < at(high - third) ? -third : third;
  }
  return at(low);
}

Segment placed(const Capsule& capsule, double x, double y, double z, double heading) {
  Segment ends;
  for (std::size_t i = 0; i < 2; ++i) {
    const double px = static_cast<double>(capsule.ends[i].x), py = static_cast<double>(capsule.ends[i].y);
    ends[i] = {x + std::cos(heading) * px - std::sin(heading) * py,
               y + std::sin(heading) * px + std::cos(heading) * py,
               z + static_cast<double>(capsule.ends[i].z)};
  }
  return ends;
}

TEST(Ragdoll, CollidesWhereCapsulesOverlap) {
  Random random(61);
  const std::vector<Affine3d> one_joint(1);
  std::vector<std::vector<Capsule>> all(50);
  std::vector<PosedRagdoll> posed(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = random_capsules(random);
    baselines::pose_ragdoll({}, all[i], one_joint, 0.5f, posed[i]);
  }
  const auto structure = baselines::ragdoll_structure(posed);
  int hits = 0;
  const int pairs = 3000;
  for (int i = 0; i < pairs; ++i) {
    const std::uint32_t shape[] = {random.below(50), random.below(50)};
    const double x[] = {random.uniform(-9, 9), x[0] + random.uniform(-0.9, 0.9)},
                 y[] = {random.uniform(-9, 9), y[0] + random.uniform(-0.9, 0.9)},
                 z[] = {random.uniform(-9, 9), z[0] + random.uniform(-0.9, 0.9)},
                 heading[] = {random.uniform(-4, 4), random.uniform(-4, 4)};
    double gap = HUGE_VAL;
    for (const Capsule& a : all[shape[0]])
      for (const Capsule& b : all[shape[1]])
        gap = std::min(gap, segment_distance(placed(a, x[0], y[0], z[0], heading[0]),
                                             placed(b, x[1], y[1], z[1], heading[1])) -
                                0.1);  // two radii of .05
    const Agents agents{shape, x, y, heading, {}, z};
    const bool hit = structure->query(agents, {0, 1});
    EXPECT_EQ(hit, structure->query(agents, {1, 0}));
    if (std::abs(gap) > 1e-5) {
      EXPECT_EQ(hit, gap < 0) << "pair " << i << ", gap " << gap;
    }
    hits += hit;
  }
  EXPECT_GT(hits, pairs / 10);
  EXPECT_LT(hits, pairs * 9 / 10);
}

TEST(Ragdoll, FitFindsTheCapsuleThatPointsLieOn) {
  Random random(62);
  const Segment ends{Vector3d(0.1, -0.2, 0.9), Vector3d(0.15, -0.1, 1.3)};
  std::vector<baselines::SkinPoint> points;
  while (points.size() < 2000) {
    Vector3d at(random.uniform(-0.2, 0.5), random.uniform(-0.5, 0.2), random.uniform(0.6, 1.6));
    const Vector3d way = ends[1] - ends[0];
    const double t = std::clamp((at - ends[0]).dot(way) / way.squaredNorm(), 0.0, 1.0);
    const Vector3d foot = ends[0] + t * way;
    const Vector3d normal = (at - foot).normalized();
    points.push_back({foot + 0.08 * normal, normal, 1});
  }
  const baselines::FittedCapsule fit = baselines::best_capsule(points);
  EXPECT_NEAR(fit.radius, 0.08, 0.002);
  const bool turned = (fit.ends[0] - ends[0]).norm() > 0.2;
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT((fit.ends[turned ? 1 - i : i] - ends[i]).norm(), 0.01);
}

struct PosedCapsule {
  Segment ends;
  double radius;
};

std::vector<PosedCapsule> read(const PosedRagdoll& posed) {
  using baselines::Field;
  std::vector<PosedCapsule> capsules;
  const std::size_t stride = (posed.lanes.size() - baselines::whole_box) / Field::count;
  for (std::size_t i = 0; i < posed.capsules; ++i) {
    const auto point = [&](std::size_t first) {
      const auto at = [&](std::size_t axis) {
        return double{posed.lanes[baselines::whole_box + (first + axis) * stride + i]};
      };
      return Vector3d(at(0), at(1), at(2));
    };
    const Vector3d end = point(Field::end_x);
    capsules.push_back({{end, end + point(Field::along_x)},
                        double{posed.lanes[baselines::whole_box + Field::radius * stride + i]}});
  }
  return capsules;
}

/// Returns by how much a vertex of a triangle is at most outside of all capsules.
double farthest_outside(const Character& character, PoseTime at, const std::vector<PosedCapsule>& capsules) {
  const std::vector<Vec3> positions = pose_vertices(character, at);
  double farthest = -HUGE_VAL;
  for (const auto& corners : character.triangles)
    for (const std::uint32_t corner : corners) {
      const Vec3& p = positions[corner];
      double out = HUGE_VAL;
      for (const PosedCapsule& capsule : capsules)
        out =
            std::min(out, baselines::way_from(capsule.ends, {double{p.x}, double{p.y}, double{p.z}}).norm() -
                              capsule.radius);
      farthest = std::max(farthest, out);
    }
  return farthest;
}

TEST(Ragdoll, HoldsItsVerticesInThePosesOfTheFit) {
  for (const Character& character : test::people()) {
    const std::vector<PoseTime> times = sample_poses(character, 5);
    std::vector<std::vector<Affine3d>> poses;
    for (const PoseTime at : times) poses.push_back(joint_transforms(character, at, JointFrame::world));
    for (const std::uint32_t count : {15u, 32u}) {
      const std::vector<Capsule> capsules = baselines::fit_ragdoll(character, poses, count);
      ASSERT_EQ(capsules.size(), count);
      for (const Capsule& capsule : capsules) EXPECT_LE(capsule.thin, capsule.holding);
      for (std::size_t i = 0; i < poses.size(); ++i) {
        PosedRagdoll thin, holding;
        baselines::pose_ragdoll(character, capsules, poses[i], 0, thin);
        baselines::pose_ragdoll(character, capsules, poses[i], 1, holding);
        const std::string where =
            character.name + ", " + std::to_string(count) + " capsules, pose " + std::to_string(i);
        EXPECT_LT(farthest_outside(character, times[i], read(holding)), 1e-5) << where;
        const double beyond_fit = farthest_outside(character, times[i], read(thin));
        EXPECT_GT(beyond_fit, 0.01) << where;
        EXPECT_LT(beyond_fit, 0.15) << where;
      }
    }
  }
}

// ---- The boxes themselves: that the test of two separates. That it misses nothing, the answers of their trees tell.

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
