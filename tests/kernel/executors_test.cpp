// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/obstacles.hpp>

#include "tests/support/body_models.hpp"
#include "tests/support/body_scenes.hpp"
#include "tests/support/executors.hpp"
#include "tests/support/test.hpp"

// Bodies of spheres and what is built in tasks have the same bits on each executor; queries of shapes: determinism_test, c_api_test.

namespace bch {
namespace {

/// Holds numbers of all answers.
struct Numbers {
  std::vector<double> all;

  template <class Number>
  requires(std::is_arithmetic_v<Number>) void add(Number number) {
    all.push_back(static_cast<double>(number));
  }
  void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
  void add(const Penetration& way) { add(way.depth), add(way.x), add(way.y); }
  void add(const Pair& pair) { add(pair.first), add(pair.second); }
  void add(const DiscPair& discs) { add(discs.first), add(discs.second); }
  void add(const Sphere& s) { add(s.x), add(s.y), add(s.z), add(s.radius); }
  void add(const Disc& d) { add(d.x), add(d.y), add(d.radius); }
  template <class Values>
  void add_each(const Values& values) {
    for (const auto& value : values) add(value);
  }
};

TEST(BodyExecutors, ChangeNoAnswerAboutPairs) {
  test::Random random(5901);
  const BodySet bodies = test::bodies_of_all_kinds(random);
  const test::BodyCrowd crowd = test::random_body_crowd(random, 150, bodies.body_count(), 9, 1);
  const Agents agents = crowd.agents();
  const std::size_t n = crowd.pairs.size();
  const std::vector<double> x(n, 0.5), distances(n, 0.2);
  test::expect_same_on_each_executor(
      [&] {
        Numbers found;
        std::vector<std::uint8_t> hits(n), near(n);
        std::vector<float> distance(n), times(n);
        std::vector<Vec3> direction(n);
        std::vector<DiscPair> spheres(n);
        std::vector<Penetration> deepest(n), free(n);
        collide(bodies, agents, crowd.pairs, hits);
        within(bodies, agents, crowd.pairs, distances, near);
        clearance(bodies, agents, crowd.pairs, {distance, direction, spheres});
        penetration(bodies, agents, crowd.pairs, 16, deepest);
        nearest_free(bodies, agents, crowd.pairs, 16, free);
        time_of_impact(bodies, agents, crowd.pairs, {x, x, x}, times);
        EXPECT_GT(std::ranges::count(hits, 1), 50);
        found.add_each(hits), found.add_each(near), found.add_each(distance), found.add_each(direction);
        found.add_each(spheres), found.add_each(deepest), found.add_each(free), found.add_each(times);
        return found.all;
      },
      Executor::set);
}

TEST(BodyExecutors, ChangeNoAnswerAboutCrowds) {
  test::Random random(5902);
  const BodySet bodies = test::random_bodies(random);
  const test::BodyCrowd crowd = test::random_body_crowd(random, 400, bodies.body_count(), 20, 0.4);
  const Agents agents = crowd.agents();
  const ObstacleSet walls = obstacles_from_wkt("LINESTRING (0 5, 20 6) POLYGON ((9 9, 11 9, 11 11, 9 11))");
  test::expect_same_on_each_executor(
      [&] {
        Numbers found;
        Crowd finder;
        found.add_each(finder.collisions(bodies, agents));
        const Crowd::BodyContacts contacts = finder.contacts(bodies, agents);
        for (const Crowd::SphereContact& contact : contacts.contacts.values)
          found.add(contact.spheres), found.add(contact.normal), found.add(contact.depth);
        found.add_each(finder.clearances(bodies, agents, {.max_distance = 0.3}).distance);
        found.add_each(finder.penetrations(bodies, agents).penetrations);
        found.add_each(finder.obstacles(bodies, agents, walls).values);
        const Crowd::Resolved resolved = finder.resolve(bodies, agents, {.sweeps = 20, .obstacles = &walls});
        found.add_each(resolved.x), found.add_each(resolved.y), found.add_each(resolved.left);
        EXPECT_GT(found.all.size(), 2'000u);
        return found.all;
      },
      Executor::set);
}

TEST(BodyExecutors, BuildTheSame) {
  const std::vector<BodyModel> models = {test::plain_model(default_male(), 64)};
  const std::vector<std::uint32_t> model_of_body(30, 0);
  std::vector<Pose> poses;
  for (std::uint32_t i = 0; i < 30; ++i) poses.emplace_back(PoseTime{0, 0.03f * static_cast<float>(i)});
  test::expect_same_on_each_executor(
      [&] {
        Numbers found;
        const BodySet baked = bake(models, {.poses = 20});
        LiveBodies live(models, model_of_body);
        live.pose(poses);
        for (std::uint32_t i = 0; i < 20; ++i)
          found.add_each(baked.spheres(i)), found.add_each(live.set().spheres(i));
        const ShapeSet shapes = bake(default_male(), {.poses = 20});
        for (std::uint32_t i = 0; i < shapes.shape_count(); ++i) found.add_each(shapes.discs(i, 0));
        return found.all;
      },
      Executor::set);
}

}  // namespace
}  // namespace bch
