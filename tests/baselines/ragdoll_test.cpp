// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <Eigen/Geometry>

#include "baselines/capsule_fit.hpp"
#include "baselines/capsule_lanes.hpp"
#include "baselines/exact_tests.hpp"
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
  const auto at = [&](double t) { return baselines::offset_from(b, a[0] + t * (a[1] - a[0])).norm(); };
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
        out = std::min(out,
                       baselines::offset_from(capsule.ends, {double{p.x}, double{p.y}, double{p.z}}).norm() -
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
  EXPECT_EQ(message({{zero, zero, zero}}), "box tree: expected an extent of 1e-6 to 1e6 m, found 0");
  EXPECT_EQ(message({{zero, 2e6f * one, one}}),
            "box tree: expected an extent of 1e-6 to 1e6 m, found 3464101.6151377545");
}

// ---- Segments and triangles with integer corners, against a method that shares nothing with the one tested: two
// convex sets meet exactly if the origin is a convex combination of differences of their corners, and by
// Caratheodory's theorem four of those differences are enough. Integers of 128 bits decide that.

__extension__ using Integer = __int128;
struct Vector {
  Integer x, y, z;
};

Integer dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
bool is_zero(const Vector& v) {
  return v.x == 0 && v.y == 0 && v.z == 0;
}
Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// The origin is a convex combination of two points.
bool within(const Vector& a, const Vector& b) {
  return is_zero(cross(a, b)) && dot(a, b) <= 0;
}

/// Of three points in a plane through the origin that are not on one line.
bool within(const Vector& a, const Vector& b, const Vector& c) {
  const Vector normal = cross(b - a, c - a);
  if (is_zero(normal) || dot(normal, a) != 0) return false;
  // The signs of the three areas, by the largest part of their parallel normals: small enough for 128 bits.
  const auto size = [](Integer value) { return value < 0 ? -value : value; };
  const auto largest = [&](const Vector& v) {
    if (size(normal.x) >= size(normal.y) && size(normal.x) >= size(normal.z))
      return normal.x < 0 ? -v.x : v.x;
    if (size(normal.y) >= size(normal.z)) return normal.y < 0 ? -v.y : v.y;
    return normal.z < 0 ? -v.z : v.z;
  };
  return largest(cross(a, b)) >= 0 && largest(cross(b, c)) >= 0 && largest(cross(c, a)) >= 0;
}

/// Of four points that are not in one plane.
bool within(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const auto volume = [](const Vector& p, const Vector& q, const Vector& r) { return dot(cross(p, q), r); };
  const Integer parts[] = {volume(b, c, d), -volume(a, c, d), volume(a, b, d), -volume(a, b, c)};
  Integer sum = 0;
  for (const Integer part : parts) sum += part;
  if (sum == 0) return false;
  return std::all_of(std::begin(parts), std::end(parts),
                     [&](Integer part) { return sum > 0 ? part >= 0 : part <= 0; });
}

using Corners = std::vector<Vector>;

bool expected_to_meet(const Corners& s, const Corners& t) {
  std::vector<Vector> points;
  for (const Vector& p : s)
    for (const Vector& q : t) points.push_back(q - p);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_zero(points[i])) return true;
    for (std::size_t j = 0; j < i; ++j) {
      if (within(points[i], points[j])) return true;
      for (std::size_t k = 0; k < j; ++k) {
        if (within(points[i], points[j], points[k])) return true;
        for (std::size_t l = 0; l < k; ++l)
          if (within(points[i], points[j], points[k], points[l])) return true;
      }
    }
  }
  return false;
}

double real(Integer value, double scale) {
  return static_cast<double>(value) * scale;
}
Point2 flat(const Vector& v, double scale) {
  return {real(v.x, scale), real(v.y, scale)};
}
Point3 solid(const Vector& v, double scale) {
  return {real(v.x, scale), real(v.y, scale), real(v.z, scale)};
}
Segment2 segment(const Corners& c, double scale = 1) {
  return {flat(c[0], scale), flat(c[1], scale)};
}
Triangle2 triangle_2d(const Corners& c, double scale = 1) {
  return {flat(c[0], scale), flat(c[1], scale), flat(c[2], scale)};
}
Triangle3 triangle_3d(const Corners& c, double scale = 1) {
  return {solid(c[0], scale), solid(c[1], scale), solid(c[2], scale)};
}

std::string text(const Corners& corners) {
  std::string result;
  for (const Vector& v : corners)
    result += '(' + std::to_string(static_cast<std::int64_t>(v.x)) + ' ' +
              std::to_string(static_cast<std::int64_t>(v.y)) + ' ' +
              std::to_string(static_cast<std::int64_t>(v.z)) + ')';
  return result;
}

/// Every set of `count` corners, repetitions included, on a grid.
std::vector<Corners> all_corner_sets(int width, int height, int depth, std::size_t count) {
  std::vector<Vector> grid;
  for (int x = 0; x < width; ++x)
    for (int y = 0; y < height; ++y)
      for (int z = 0; z < depth; ++z) grid.push_back({x, y, z});
  std::vector<Corners> sets = {{}};
  std::vector<std::size_t> last = {0};
  for (std::size_t n = 0; n < count; ++n) {
    std::vector<Corners> longer;
    std::vector<std::size_t> longer_last;
    for (std::size_t s = 0; s < sets.size(); ++s)
      for (std::size_t g = last[s]; g < grid.size(); ++g) {
        longer.push_back(sets[s]);
        longer.back().push_back(grid[g]);
        longer_last.push_back(g);
      }
    sets = std::move(longer);
    last = std::move(longer_last);
  }
  return sets;
}

/// All pairs of sets of corners meet as the slow method says.
template <class Meet>
void expect_every_pair(const std::vector<Corners>& sets, std::size_t count, Meet meet) {
  ASSERT_EQ(sets.size(), count);
  for (const Corners& s : sets)
    for (const Corners& t : sets) ASSERT_EQ(meet(s, t), expected_to_meet(s, t)) << text(s) << text(t);
}

TEST(Segments, EveryPairOnAGrid) {
  expect_every_pair(all_corner_sets(4, 4, 1, 2), 136,
                    [](const auto& s, const auto& t) { return segments_meet(segment(s), segment(t)); });
}

TEST(TrianglesOnTheGround, EveryPairOnAGrid) {
  expect_every_pair(all_corner_sets(3, 3, 1, 3), 165, [](const auto& s, const auto& t) {
    return triangles_meet(triangle_2d(s), triangle_2d(t));
  });
}

TEST(TrianglesInSpace, EveryPairOnACube) {
  expect_every_pair(all_corner_sets(2, 2, 2, 3), 120, [](const auto& s, const auto& t) {
    return triangles_meet(triangle_3d(s), triangle_3d(t));
  });
}

TEST(TrianglesInSpace, EveryPairInAPlaneEqualsTheTestOnTheGround) {
  for (const Corners& s : all_corner_sets(3, 3, 1, 3))
    for (const Corners& t : all_corner_sets(3, 3, 1, 3)) {
      const auto tilted = [](const Corners& corners) {
        Triangle3 result = triangle_3d(corners);
        for (Point3& p : result) p = {p.y - p.x, 2 * p.x, 3 * p.y + p.x};
        return result;
      };
      ASSERT_EQ(triangles_meet(tilted(s), tilted(t)), triangles_meet(triangle_2d(s), triangle_2d(t)))
          << text(s) << text(t);
    }
}

/// Random corners on a small grid, so that touching, flat and repeated corners are common, then blown up by
/// 2^29 and, in half of the cases, some corners moved by a unit or two: slivers, and gaps of 2e-9.
class RandomCorners : public testing::TestWithParam<std::uint64_t> {
 protected:
  test::Random random{GetParam()};

  Corners corners(std::size_t count, int depth) {
    Corners result;
    for (std::size_t i = 0; i < count; ++i) {
      const auto coordinate = [&](std::uint32_t bound) {
        Integer value = static_cast<Integer>(random.below(bound)) << 29;
        if (random.below(2) == 0) value += static_cast<Integer>(random.below(5)) - 2;
        return value;
      };
      result.push_back({coordinate(4), coordinate(4), depth > 1 ? coordinate(4) : 0});
    }
    return result;
  }
};

TEST_P(RandomCorners, OnTheGround) {
  for (std::uint32_t i = 0; i < test::samples(500'000); ++i) {
    const std::size_t count = i % 5 < 3 ? 2 : 3;
    const Corners s = corners(count, 1), t = corners(count, 1);
    const bool meet = count == 2 ? segments_meet(segment(s, 0x1p-29), segment(t, 0x1p-29))
                                 : triangles_meet(triangle_2d(s, 0x1p-29), triangle_2d(t, 0x1p-29));
    ASSERT_EQ(meet, expected_to_meet(s, t)) << "case " << i << ": " << text(s) << text(t);
  }
}

TEST_P(RandomCorners, TrianglesInSpaceInAnyOrderOfCorners) {
  for (std::uint32_t i = 0; i < test::samples(200'000); ++i) {
    Corners s = corners(3, 4), t = corners(3, 4);
    const bool expected = expected_to_meet(s, t);
    for (int order = 0; order < 4; ++order) {
      ASSERT_EQ(triangles_meet(triangle_3d(s, 0x1p-29), triangle_3d(t, 0x1p-29)), expected)
          << "case " << i << ": " << text(s) << text(t);
      std::swap(s[random.below(3)], s[random.below(3)]);
      std::swap(s, t);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomCorners, testing::Values(1, 2, 3));

/// Far from the origin and far below the unit the determinants cancel completely.
TEST(Orientation, DecidesTheLastBit) {
  const double one = 1, next = 1 + 0x1p-52, half = 0.5, tiny = 0x1p-150;
  EXPECT_EQ(orientation(Point2{half, half}, Point2{12, 12}, Point2{24, 24}), 0);
  EXPECT_EQ(orientation(Point2{half, half}, Point2{12, 12}, Point2{24, 24 + 0x1p-48}), 1);
  EXPECT_EQ(orientation(Point2{half, half + 0x1p-53}, Point2{12, 12}, Point2{24, 24}), 1);
  EXPECT_EQ(orientation(Point2{0, 0}, Point2{one, next}, Point2{next, one}), -1);
  EXPECT_EQ(orientation(Point2{0, 0}, Point2{tiny, tiny}, Point2{1, 1}), 0);
  EXPECT_EQ(orientation(Point2{0, tiny}, Point2{1, 1}, Point2{2, 2}), 1);
  const Point3 a{1e6, 0, 0}, b{0, 1e6, 0}, c{0, 0, 1e6};
  EXPECT_EQ(orientation(a, b, c, Point3{1e6 / 2, 1e6 / 4, 1e6 / 4}), 0);
  EXPECT_EQ(orientation(a, b, c, Point3{1e6 / 2, 1e6 / 4, 1e6 / 4 + 0x1p-34}), 1);
  EXPECT_EQ(orientation(a, b, c, Point3{1e6 / 2, 1e6 / 4 - 0x1p-34, 1e6 / 4}), -1);
}

}  // namespace
}  // namespace bch::baselines
