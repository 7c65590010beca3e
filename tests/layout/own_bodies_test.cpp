// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/body_models.hpp"
#include "tests/support/plane_geometry.hpp"
#include "tests/support/test.hpp"

// Bodies of capsules, of polygons with heights, of spheres of one's own, and of meshes without bones; sets that mix them.

namespace bch {
namespace {

using test::Random;

struct Point {
  double x, y, z;
};

double between(const Point& a, const Point& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

Point point(const Vec3& p) {
  return {double{p.x}, double{p.y}, double{p.z}};
}

/// Returns by how much a point is outside all spheres; below 0: how deep it is in one.
double outside(std::span<const Sphere> spheres, const Point& p) {
  double least = 1e9;
  for (const Sphere& s : spheres)
    least = std::min(least, between(p, {double{s.x}, double{s.y}, double{s.z}}) - double{s.radius});
  return least;
}

Point random_direction(Random& random) {
  for (;;) {
    const Point p{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (const double length = between(p, {0, 0, 0}); length > 0.1 && length < 1)
      return {p.x / length, p.y / length, p.z / length};
  }
}

Point on(const Sphere& s, const Point& direction) {
  const double radius = double{s.radius};
  return {double{s.x} + radius * direction.x, double{s.y} + radius * direction.y,
          double{s.z} + radius * direction.z};
}

double from_segment(const Point& p, const Point& a, const Point& b) {
  const Point way{b.x - a.x, b.y - a.y, b.z - a.z};
  const double square = way.x * way.x + way.y * way.y + way.z * way.z;
  const double along = (p.x - a.x) * way.x + (p.y - a.y) * way.y + (p.z - a.z) * way.z;
  const double fraction = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
  return between(p, {a.x + fraction * way.x, a.y + fraction * way.y, a.z + fraction * way.z});
}

TEST(OwnBodies, OfCapsulesHoldThemAndHardlyMore) {
  Random random(1);
  double largest_excess = -1;
  for (int i = 0; i < 200; ++i) {
    const auto end = [&] {
      return Vec3{static_cast<float>(random.uniform(-1, 1)), static_cast<float>(random.uniform(-1, 1)),
                  static_cast<float>(random.uniform(0, 2))};
    };
    BodySet::Capsule capsule{end(), end(), static_cast<float>(random.uniform(0, 0.2))};
    if (i % 10 == 0) capsule.b = capsule.a;
    if (i % 10 == 1) capsule.radius = 0.001f;
    const float error = i % 2 == 0 ? 0.005f : 0.03f;
    const std::vector<Sphere> spheres = spheres_from_capsules({&capsule, 1}, error);
    const Point a = point(capsule.a), b = point(capsule.b);
    const double radius = double{capsule.radius};
    for (int k = 0; k < 300; ++k) {
      const double fraction = random.uniform(0, 1);
      const Point direction = random_direction(random);
      const Point surface{a.x + fraction * (b.x - a.x) + radius * direction.x,
                          a.y + fraction * (b.y - a.y) + radius * direction.y,
                          a.z + fraction * (b.z - a.z) + radius * direction.z};
      ASSERT_LE(outside(spheres, surface), 0) << i;
    }
    for (const Sphere& sphere : spheres)
      for (int k = 0; k < 20; ++k) {
        const double excess = from_segment(on(sphere, random_direction(random)), a, b) - radius;
        ASSERT_LE(excess, double{error}) << i;
        largest_excess = std::max(largest_excess, excess);
      }
  }
  EXPECT_GT(largest_excess, 0.02);  // the error is made use of
}

/// Returns how far a point is from what stands on a polygon.
double from_prism(const std::vector<Vec2>& polygon, const Heights& heights, const Point& p) {
  const double above = std::max({0.0, p.z - double{heights.top}, double{heights.bottom} - p.z});
  return std::hypot(std::max(0.0, -test::depth_in_contour<double>(polygon, p.x, p.y)), above);
}

void expect_covered(const std::vector<Vec2>& polygon, const Heights& heights, float error, Random& random) {
  const std::vector<Sphere> spheres = spheres_from_polygons({&polygon, 1}, heights, error);
  const auto height = [&] { return random.uniform(double{heights.bottom}, double{heights.top}); };
  int inside = 0;
  for (int k = 0; k < 3000; ++k) {
    const Point p{random.uniform(-1, 1), random.uniform(-1, 1), height()};
    if (test::depth_in_contour<double>(polygon, p.x, p.y) < 0) continue;
    ++inside;
    ASSERT_LE(outside(spheres, p), 0);
  }
  EXPECT_GT(inside, 0);
  for (std::size_t i = 0; i < polygon.size(); ++i)
    for (int k = 0; k < 50; ++k) {
      const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double fraction = k == 0 ? 0 : random.uniform(0, 1), z = k % 3 == 0   ? double{heights.top}
                                                                     : k % 3 == 1 ? double{heights.bottom}
                                                                                  : height();
      ASSERT_LE(outside(spheres, {double{a.x} + fraction * (double{b.x} - double{a.x}),
                                  double{a.y} + fraction * (double{b.y} - double{a.y}), z}),
                1e-7);
    }
  for (const Sphere& sphere : spheres)
    for (int k = 0; k < 20; ++k)
      ASSERT_LE(from_prism(polygon, heights, on(sphere, random_direction(random))), double{error});
}

TEST(OwnBodies, OfPolygonsWithHeightsHoldThemAndHardlyMore) {
  Random random(2);
  const std::vector<std::vector<Vec2>> polygons = {
      {{-0.3f, -0.2f}, {0.3f, -0.2f}, {0.3f, 0.2f}, {-0.3f, 0.2f}},
      {{-0.5f, -0.3f}, {0.5f, -0.3f}, {0.5f, 0.3f}, {0.1f, 0.3f}, {0.1f, 0.05f}, {-0.5f, 0.05f}},
      {{-0.4f, -0.1f}, {0.6f, 0.3f}, {0.5f, -0.3f}, {-0.2f, 0.4f}},  // crosses itself
      {{0, 0.6f}, {0.5f, -0.3f}, {-0.5f, -0.3f}},                    // clockwise
  };
  for (const std::vector<Vec2>& polygon : polygons)
    for (const float error : {0.03f, 0.1f}) {
      expect_covered(polygon, {0, 1}, error, random);
      expect_covered(polygon, {0.2f, 0.25f}, error, random);
    }
  for (int i = 0; i < 20; ++i) {
    std::vector<Vec2> polygon;
    for (int corner = 0; corner < 3 + i % 5; ++corner)
      polygon.push_back(
          {static_cast<float>(random.uniform(-1, 1)), static_cast<float>(random.uniform(-1, 1))});
    expect_covered(polygon, {0, 0.5f}, 0.08f, random);
  }
}

TEST(OwnBodies, AreRefusedWithAReason) {
  const auto of_capsule = [](BodySet::Capsule capsule, float error) {
    return test::complaint([&] { spheres_from_capsules({&capsule, 1}, error); });
  };
  EXPECT_EQ(of_capsule({{0, 0, 0}, {0, 0, 1}, -1}, 0.01f),
            "spheres of capsules: capsule 0: expected a radius of at least 0 and an extent of 1e-6 to 1e6 m, "
            "found a radius of -1 and an extent of 0");
  EXPECT_TRUE(test::has(of_capsule({{0, 0, 0}, {0, 0, 1}, 0.1f}, 1e-7f), "expected an error above 1.049"));
  EXPECT_TRUE(test::has(of_capsule({{0, 0, 0}, {0, 0, 1000}, 0.1f}, 1e-2f),
                        "expected an error that 4096 spheres keep, found 0.01 m"));
  for (const BodySet::Capsule& bad :
       {BodySet::Capsule{{0, 0, NAN}, {0, 0, 1}, 0.1f}, BodySet::Capsule{{0, 0, 1}, {0, NAN, 0}, 0.1f}})
    EXPECT_TRUE(test::has(of_capsule(bad, 1e-2f), "an extent of nan"));
  const std::vector<Vec2> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto of_square = [&](Heights heights, float error) {
    return test::complaint([&] { spheres_from_polygons({&square, 1}, heights, error); });
  };
  EXPECT_TRUE(test::has(of_square({1, 1}, 0.1f), "expected a bottom below the top, within +-1e6 m"));
  EXPECT_TRUE(test::has(of_square({}, 0.1f), "found -inf and inf"));
  EXPECT_TRUE(test::has(of_square({0, 1}, 0), "expected an error above 0, up to 1e6 m, found 0"));
  EXPECT_EQ(of_square({0, 1}, 1e-4f),
            "spheres of polygons: expected an error that 4096 spheres keep, found 1e-04 m at polygon 0");
  EXPECT_EQ(test::complaint([] { make_body(std::span<const Sphere>()); }),
            "make_body: expected 1 to 4096 spheres, found 0");
  const Sphere bad{0, 0, 0, -1};
  EXPECT_TRUE(test::has(test::complaint([&] { make_body({&bad, 1}); }), "radius -1) as sphere 0"));
}

/// Holds a person, a cart and a ragdoll, as bodies.
std::vector<std::vector<Sphere>> mixed_bodies() {
  const std::vector<Vec2> cart = {{-0.3f, -0.2f}, {0.3f, -0.2f}, {0.3f, 0.2f}, {-0.3f, 0.2f}};
  const std::vector<BodySet::Capsule> ragdoll = {{{0, 0, 0.1f}, {0, 0, 1.6f}, 0.1f},
                                                 {{0, -0.4f, 1.3f}, {0, 0.4f, 1.3f}, 0.05f}};
  BodyPoser poser(default_body(default_male(), 64));
  const auto person = poser.spheres(Pose(0, 0.3f));
  return {{person.begin(), person.end()},
          spheres_from_polygons({&cart, 1}, {0, 1}),
          spheres_from_capsules(ragdoll)};
}

TEST(OwnBodies, MeetPeopleInOneSet) {
  const BodySet bodies(mixed_bodies());
  // A person beside a cart, a ragdoll whose arms are above it, and another one in a person.
  const std::vector<std::uint32_t> body = {0, 1, 2, 2};
  const std::vector<double> x = {0, 0.45, 0.7, 3}, y = {0, 0.1, 0.6, 0}, heading = {0, 0, 0, 0};
  std::vector<double> z(4, 0.0);
  Crowd crowd;
  const auto collisions = [&] {
    std::set<std::pair<std::uint32_t, std::uint32_t>> found;
    for (const auto [a, b] :
         crowd.collisions(bodies, {.shape = body, .x = x, .y = y, .heading = heading, .z = z}))
      found.insert({a, b});
    return found;
  };
  EXPECT_EQ(collisions(), (std::set<std::pair<std::uint32_t, std::uint32_t>>{{0, 1}}));
  z[2] = -0.4;  // the arm is 0.9 m above the cart's ground
  EXPECT_EQ(collisions(), (std::set<std::pair<std::uint32_t, std::uint32_t>>{{0, 1}, {1, 2}}));
}

TEST(OwnBodies, AsModelsArePosedBesidePeople) {
  const std::vector<Sphere> cart = mixed_bodies()[1];
  const std::vector<BodyModel> models = {default_body(default_male(), 64), make_body(cart)};
  EXPECT_NO_THROW(validate(models[1]));
  const std::vector<std::uint32_t> model_of_body = {0, 1, 1};
  LiveBodies live(models, model_of_body);
  const Affine3 on_its_side{{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0.2f}}};
  const std::vector<Pose> poses = {Pose(0, 0.3f), Pose(), WorldPose{std::span(&on_its_side, 1)}};
  live.pose(poses);
  const Heights standing = live.set().heights(1), lying = live.set().heights(2);
  EXPECT_NEAR(standing.top, 1, 0.06);
  EXPECT_NEAR(lying.top, 0.4, 0.06);
  // Spheres stand where they were given, in another order.
  const std::vector<Sphere> posed = live.set().spheres(1);
  ASSERT_EQ(posed.size(), cart.size());
  for (const Sphere& given : cart) {
    const auto found = std::find_if(posed.begin(), posed.end(), [&](const Sphere& s) {
      return std::abs(s.x - given.x) < 1e-6f && std::abs(s.y - given.y) < 1e-6f &&
             std::abs(s.z - given.z) < 1e-6f && s.radius >= given.radius && s.radius < given.radius + 1e-5f;
    });
    EXPECT_NE(found, posed.end());
  }
  const BodyModel again = body_model(to_bytes(models[1]));
  EXPECT_EQ(again.least_radius, models[1].least_radius);
}

TEST(OwnBodies, ModelsOfEveryNumberOfSpheresHoldOneCharacterInOneSet) {
  const Character man = default_male();
  std::vector<BodyModel> models;
  for (const std::uint32_t spheres : {64u, 128u, 256u, 512u}) models.push_back(default_body(man, spheres));
  const std::vector<std::uint32_t> model_of_body = {3, 0, 2, 1, 0};
  LiveBodies live(models, model_of_body);
  const std::vector<Pose> poses(model_of_body.size(), Pose(1, 0.4f));
  live.pose(poses);
  const std::vector<Vec3> vertices = pose_vertices(man, poses[0]);
  for (std::uint32_t body = 0; body < model_of_body.size(); ++body) {
    const std::vector<Sphere> spheres = live.set().spheres(body);
    ASSERT_EQ(spheres.size(), models[model_of_body[body]].sphere_count());
    for (const Vec3& vertex : vertices) ASSERT_LE(outside(spheres, point(vertex)), 0) << body;
  }
  // Who stands in one of them meets it whatever its number of spheres.
  const std::vector<std::uint32_t> body = {0, 1, 2, 3, 4};
  const std::vector<double> x(5, 0.1), heading(5, 0.0);
  Crowd crowd;
  EXPECT_EQ(crowd.collisions(live.set(), {body, x, x, heading}).size(), 10u);
}

/// A mesh without bones.
Character box_of(float width, float depth, float height) {
  Character box;
  box.name = "box";
  box.joints = {Joint{"box", -1, {}}};
  box.bones = {Bone{}};
  box.influence_begin = {0};
  for (std::uint32_t v = 0; v < 8; ++v) {
    box.vertices.push_back({v & 1 ? width : 0, v & 2 ? depth : 0, v & 4 ? height : 0});
    box.influences.push_back({0, 1});
    box.influence_begin.push_back(v + 1);
  }
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return box;
}

TEST(OwnBodies, OfMeshesWithoutBones) {
  const BodyModel model = make_body(box_of(0.1f, 0.06f, 0.16f), {.spheres = 32, .draft = true});
  EXPECT_NO_THROW(validate(model));
  BodyPoser poser(model);
  const auto spheres = poser.spheres(Pose());
  // The middle of its rectangle is the origin.
  Random random(3);
  for (int k = 0; k < 300; ++k)
    ASSERT_LE(outside(spheres, {0.05, random.uniform(-0.03, 0.03), random.uniform(0, 0.16)}), 1e-6);
}

/// A ship takes no more pieces than a man does.
TEST(OwnBodies, OfLargeMeshesAreThoseOfSmallOnesAndLarger) {
  constexpr float larger = 128;
  const BodyModel one = make_body(box_of(0.0625f, 0.03125f, 2), {.spheres = 32, .draft = true}),
                  other = make_body(box_of(larger * 0.0625f, larger * 0.03125f, larger * 2),
                                    {.spheres = 32, .draft = true});
  EXPECT_EQ(one.midpoints, other.midpoints);
  EXPECT_EQ(one.corners, other.corners);
  ASSERT_EQ(one.influences.size(), other.influences.size());
  for (std::size_t i = 0; i < one.influences.size(); ++i)
    EXPECT_EQ(larger * one.influences[i].centre.z, other.influences[i].centre.z);
  EXPECT_TRUE(test::has(test::complaint([] { make_body(box_of(1, 1e7f, 1), {.draft = true}); }),
                        "character 'box': expected vertices within 1e6 m of the origin"));
}

}  // namespace
}  // namespace bch
