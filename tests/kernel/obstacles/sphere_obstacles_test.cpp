// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/body_scenes.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/plane_geometry.hpp"
#include "tests/support/test.hpp"

// Bodies of spheres and obstacles that stand upright, against the definition in long double.

namespace bch {
namespace {

using test::BodyCrowd;
using test::ObstacleScene;
using test::Random;

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr long double rounding = 1e-8L;  ///< metres: headings are within 3e-10, times an extent

/// Returns the least gap between spheres and an obstacle.
long double gap(const std::vector<Sphere>& spheres, const Agents& agents, std::uint32_t agent,
                const ObstacleScene& scene, std::size_t obstacle) {
  const baselines::ReferenceObstacle& other = scene.reference[obstacle];
  const long double c = std::cos(static_cast<long double>(agents.heading.x()[agent])),
                    s = std::sin(static_cast<long double>(agents.heading.x()[agent]));
  long double least = unlimited;
  for (const Sphere& sphere : spheres) {
    const long double x = agents.x[agent] + (c * sphere.x - s * sphere.y),
                      y = agents.y[agent] + (s * sphere.x + c * sphere.y),
                      z = static_cast<long double>(agents.z[agent]) + sphere.z;
    long double aside = other.is_area && test::contains(other, x, y) ? 0 : unlimited, above = 0;
    for (const auto& [ax, ay, bx, by] : other.segments)
      aside = std::min(aside, test::distance_to_segment<long double>(x, y, ax, ay, bx, by));
    if (!scene.bottom.empty()) above = std::max({scene.bottom[obstacle] - z, z - scene.top[obstacle], 0.0L});
    least = std::min(least, std::hypot(aside, above) - sphere.radius);
  }
  return least;
}

/// Expects an answer that holds where a gap is at most a limit, but for rounding, and never misses.
void expect_answer(bool answer, long double gap, long double limit, const char* what, std::uint32_t agent) {
  if (std::abs(gap - limit) <= rounding) return;
  EXPECT_EQ(answer, gap < limit) << what << " of agent " << agent << ": gap " << static_cast<double>(gap)
                                 << ", limit " << static_cast<double>(limit);
}

void expect_right(const BodySet& bodies, const BodyCrowd& crowd, const ObstacleScene& scene, Random& random) {
  const Agents agents = crowd.agents();
  const std::size_t n = agents.size();
  const ObstacleSet obstacles = scene.set();
  const std::vector<double> distances = test::distances_for(random, n);
  std::vector<std::uint8_t> hits(n), near(n), others(n);
  collide(bodies, agents, obstacles, hits);
  within(bodies, agents, obstacles, distances, near);
  for (const Implementation& implementation : test::supported()) {
    collide(bodies, agents, obstacles, others, &implementation);
    EXPECT_EQ(others, hits) << implementation.name;
    within(bodies, agents, obstacles, distances, others, &implementation);
    EXPECT_EQ(others, near) << implementation.name;
  }
  std::vector<float> distance(n), deepest(n);
  std::vector<Vec3> direction(n);
  std::vector<DiscPair> which(n);
  std::vector<BodyClearanceAnswers::Points> points(n);
  clearance(bodies, agents, obstacles, {distance, direction, which, points});
  clearance(bodies, agents, obstacles, {.distance = deepest}, {.overlap = Overlap::deepest});
  Crowd finder;
  const Rows<std::uint32_t> rows = finder.obstacles(bodies, agents, obstacles);
  for (std::uint32_t agent = 0; agent < n; ++agent) {
    const std::vector<Sphere> spheres = bodies.spheres(agents.shape[agent]);
    long double least = unlimited;
    for (std::uint32_t o = 0; o < scene.reference.size(); ++o) {
      const long double each = gap(spheres, agents, agent, scene, o);
      const auto row = rows[agent];
      expect_answer(std::find(row.begin(), row.end(), o) != row.end(), each, 0, "obstacle", agent);
      least = std::min(least, each);
    }
    EXPECT_EQ(hits[agent] != 0, !rows[agent].empty());
    expect_answer(hits[agent] != 0, least, 0, "hit", agent);
    expect_answer(near[agent] != 0, least, distances[agent], "within", agent);
    if (least == unlimited) {
      EXPECT_EQ(distance[agent], HUGE_VALF);
      continue;
    }
    EXPECT_NEAR(deepest[agent], static_cast<double>(least),
                1e-6 * (1 + std::abs(static_cast<double>(least))));
    EXPECT_EQ(distance[agent] == 0, hits[agent] != 0 || deepest[agent] == 0) << deepest[agent];
    if (distance[agent] == 0) continue;
    EXPECT_EQ(distance[agent], deepest[agent]);
    const Vec3 from = points[agent].first, to = points[agent].second;
    const auto along = [&](float Vec3::*axis) {
      return double{from.*axis} + double{distance[agent]} * double{direction[agent].*axis} - double{to.*axis};
    };
    EXPECT_LT(std::hypot(along(&Vec3::x), along(&Vec3::y), along(&Vec3::z)),
              1e-5 * (1 + double{distance[agent]}));
    EXPECT_LT(which[agent].first, spheres.size());
  }
}

/// Gives obstacles heights about those of people, some of them none.
void raise(Random& random, ObstacleScene& scene) {
  for (std::size_t i = 0; i < scene.is_area.size(); ++i) {
    const double bottom = random.uniform(-1, 3);
    scene.bottom.push_back(random.below(4) == 0 ? -unlimited : bottom);
    scene.top.push_back(random.below(4) == 0 ? unlimited : bottom + random.uniform(0, 1));
  }
}

class SphereObstacles : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Centre, SphereObstacles, testing::Values(0, 3e5, -9e8));

TEST_P(SphereObstacles, AreTouchedByDefinition) {
  Random random(5401);
  const BodySet bodies = test::random_bodies(random);
  for (std::uint32_t round = 0; round < test::samples(24); ++round) {
    ObstacleScene scene = test::obstacle_scene(random, 1 + random.below(20), 4, GetParam(), -GetParam());
    if (round % 3 != 0) raise(random, scene);
    BodyCrowd crowd = test::random_body_crowd(random, 60, bodies.body_count(), 8, 2);
    for (double& x : crowd.x) x += GetParam() - 4;
    for (double& y : crowd.y) y += -GetParam() - 4;
    expect_right(bodies, crowd, scene, random);
  }
}

/// One ball of 0.2 m, one metre up.
class BallAmongObstacles : public testing::Test {
 protected:
  bool hits(const char* wkt, double x, double y, double z, double bottom = -unlimited,
            double top = unlimited) {
    const std::vector<double> xs{x}, ys{y}, zs{z}, headings{0};
    const std::vector<std::uint32_t> body{0};
    std::uint8_t hit = 2;
    collide(ball, {.shape = body, .x = xs, .y = ys, .heading = headings, .z = zs},
            obstacles_from_wkt(wkt, Polygons::solid, bottom, top), {&hit, 1});
    return hit == 1;
  }
  BodySet ball{std::vector<std::vector<Sphere>>{{{0, 0, 1, 0.2f}}}};
};

constexpr const char* room = "POLYGON((-9 -9, 9 -9, 9 9, -9 9), (-3 -3, 3 -3, 3 3, -3 3))";

TEST_F(BallAmongObstacles, GoesUnderALintelAndOverABarrier) {
  constexpr const char* wall = "LINESTRING(-1 0, 1 0)";
  EXPECT_TRUE(hits(wall, 0, 0.1, 0));
  EXPECT_FALSE(hits(wall, 0, 0.3, 0));
  EXPECT_FALSE(hits(wall, 0, 0.1, 0, 1.21));
  EXPECT_TRUE(hits(wall, 0, 0.1, 0.02, 1.17));
  EXPECT_FALSE(hits(wall, 0, 0.1, 0, 1.18)) << "beside the edge: 0.1 aside, 0.18 above";
  EXPECT_FALSE(hits(wall, 0, 0.1, 0, -unlimited, 0.79));
  EXPECT_TRUE(hits(wall, 0, 0.1, -0.3, -unlimited, 0.79));
}

TEST_F(BallAmongObstacles, TouchesAreasAsSolids) {
  EXPECT_TRUE(hits(room, 6, 0, 0)) << "wholly inside";
  EXPECT_FALSE(hits(room, 0, 0, 0)) << "in the hole";
  EXPECT_TRUE(hits(room, 2.9, 0, 0));
  EXPECT_FALSE(hits(room, 6, 0, 0, 2, 3)) << "below it";
  EXPECT_TRUE(hits(room, 6, 0, 0.9, 2, 3)) << "its lower face";
  EXPECT_FALSE(hits(room, 6, 0, 5, 2, 3)) << "above it";
}

TEST_F(BallAmongObstacles, RefusesWrongInput) {
  const std::vector<double> xs{0}, nan{std::nan("")}, none;
  const std::vector<std::uint32_t> body{0}, other{1};
  const ObstacleSet walls = obstacles_from_wkt(room);
  std::vector<std::uint8_t> hits(1, 7), two(2, 7);
  const Agents right{.shape = body, .x = xs, .y = xs, .heading = xs};
  EXPECT_THROW(collide(ball, right, walls, two), std::invalid_argument);
  EXPECT_THROW(collide(ball, {.shape = other, .x = xs, .y = xs, .heading = xs}, walls, hits),
               std::invalid_argument);
  EXPECT_THROW(collide(ball, {.shape = body, .x = nan, .y = xs, .heading = xs}, walls, hits),
               std::invalid_argument);
  EXPECT_THROW(within(ball, right, walls, none, hits), std::invalid_argument);
  EXPECT_THROW(within(ball, right, walls, nan, hits), std::invalid_argument);
  EXPECT_EQ(hits[0], 7);
  EXPECT_EQ(two[0], 7);
}

}  // namespace
}  // namespace bch
