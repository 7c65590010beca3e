// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/c_api.hpp"
#include "kernel/runtime/all_options.hpp"
#include "tests/support/c_api_queries.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/executors.hpp"
#include "tests/support/obstacle_scenes.hpp"
#include "tests/support/test.hpp"

// What the C interface answers is what the C++ library does, bit by bit.

namespace bch {
namespace {

using test::bytes;
using test::expect_ok;
using test::made;

std::string bytes_of(const std::vector<Penetration>& depths) {
  std::vector<bch_penetration_depth> all;
  for (const auto& [depth, x, y] : depths) all.push_back({depth, 0, x, y});
  return bytes(all);
}
template <class Value>
std::string bytes_of(const Rows<Value>& rows) {
  EXPECT_GT(rows.values.size(), 10u);
  return bytes(rows.offsets) + bytes(rows.values);
}

enum class Grounds { one, many };

class CApi : public testing::TestWithParam<Grounds> {
 protected:
  static std::vector<Shape> shapes() {
    std::vector<Shape> all = test::synthetic_shapes(281, 12);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (i % 4 != 3) all[i].heights = {0, 1.7f};
    return all;
  }

  test::Crowd crowd() {
    test::Crowd all;
    for (int i = 0; i < 1'000; ++i) {
      all.add({random.below(12), random.uniform(-13, 13), random.uniform(-13, 13), random.uniform(-7, 7),
               static_cast<std::uint8_t>(random.below(3))});
      if (has_heights) all.z.push_back(i % 3 == 0 ? 0 : random.uniform(-3, 3));
    }
    return all;
  }

  const bool has_heights = GetParam() == Grounds::many;
  test::Random random{282};
  const ShapeSet set{shapes(), {.depths = {0, 3, all_depths}, .heights = has_heights}};
  const test::Crowd people = crowd();
  const Agents agents = people.agents();
  const std::vector<Pair> pairs = test::candidate_pairs(set, agents, 0.4);
  test::CScene scene{set, people, pairs};
  const bch_shape_set* const in = scene.set.get();
};

INSTANTIATE_TEST_SUITE_P(Of, CApi, testing::Values(Grounds::one, Grounds::many), [](const auto& of) {
  return of.param == Grounds::one ? "OneGround" : "ManyGrounds";
});

/// All answers of the C++ library, by the names of all_queries().
std::map<std::string, std::string> answers_of(const test::CScene& scene, const detail::AllOptions& by) {
  const ShapeSet& set = scene.shapes;
  const Agents agents = scene.crowd.agents();
  const std::size_t n = scene.pairs.size(), people = agents.size();
  const std::span<const double> x = scene.x, y = scene.y, nearer = scene.nearer;
  const ObstacleSet walls = obstacles_from_wkt(test::walls_text);
  std::vector<Vec2> along;
  for (const auto& [dx, dy] : scene.along) along.push_back({dx, dy});
  std::map<std::string, std::string> all{{"validate", ""}};

  std::vector<std::uint8_t> hits(n);
  std::vector<Penetration> depths(n);
  std::vector<float> distance(n);
  std::vector<Vec2> direction(n);
  std::vector<DiscPair> discs(n);
  std::vector<NearestPoints> points(n);
  collide(set, agents, scene.pairs, hits, by), all["collide"] = bytes(hits);
  within(set, agents, scene.pairs, nearer.first(n), hits, by), all["within"] = bytes(hits);
  penetration(set, agents, scene.pairs, 16, depths), all["penetration"] = bytes_of(depths);
  std::vector<Penetration::Touch> touches(n);
  nearest_free(set, agents, scene.pairs, 16, depths, by, touches);
  all["nearest free"] = bytes_of(depths) + bytes(touches);
  along.resize(n);
  penetration_along(set, agents, scene.pairs, along, depths), all["penetration along"] = bytes_of(depths);
  time_of_impact(set, agents, scene.pairs, {x.first(n), y.first(n)}, distance);
  all["time of impact"] = bytes(distance);
  clearance(set, agents, scene.pairs, {distance, direction, discs, points}, by);
  all["clearance"] = bytes(distance) + bytes(direction) + bytes(discs) + bytes(points);

  all["candidates"] = bytes(test::candidate_pairs(set, agents, 0.4));
  bch::Crowd crowd;
  const CollideOptions colliding = by;
  const bch::Crowd::Pairs pairs = crowd.collisions(set, agents, colliding);
  all["collisions"] = bytes(pairs.span());
  all["collisions by agent"] = bytes_of(pairs.by_agent());
  all["obstacles"] = bytes_of(crowd.obstacles(set, agents, walls, colliding));
  all["contacts of pairs"] =
      bytes(scene.pairs) + bytes_of(crowd.contacts(set, agents, scene.pairs, colliding));
  const bch::Crowd::Contacts contacts = crowd.contacts(set, agents, colliding);
  all["contacts"] = bytes(contacts.pairs.span()) + bytes_of(contacts.contacts);
  const bch::Crowd::Clearances near =
      crowd.clearances(set, agents, ClearanceOptions{by.implementation, 0.2, by.overlap, by.distance_leaves});
  all["clearances"] = bytes(near.pairs.span()) + bytes(near.distance) + bytes(near.direction) +
                      bytes(near.discs) + bytes(near.points);
  all["nearest"] = bytes_of(near.nearest(3));
  all["disc radii"] = bytes(near.disc_radii(agents, 0.25));
  const bch::Crowd::Penetrations apart = crowd.penetrations(set, agents, 16, by);
  all["penetrations"] =
      bytes(apart.pairs.span()) +
      bytes_of(std::vector<Penetration>(apart.penetrations.begin(), apart.penetrations.end()));

  const test::ObstacleAnswers at_walls =
      test::all_answers(set, agents, walls, by, nearer.first(people), {x.first(people), y.first(people)});
  all["walls: collide"] = bytes(at_walls.hits), all["walls: within"] = bytes(at_walls.near);
  all["walls: penetration"] = bytes_of(at_walls.ways), all["walls: time of impact"] = bytes(at_walls.time);
  depths.resize(people), touches.resize(people);
  nearest_free(set, agents, scene.pairs, &walls, 16, depths, by, touches);
  all["walls: free of all"] = bytes_of(depths) + bytes(touches);
  all["walls: clearance"] =
      bytes(at_walls.distance) + bytes(at_walls.direction) + bytes(at_walls.discs) + bytes(at_walls.points);
  return all;
}

TEST_P(CApi, AnswersAreThoseOfTheLibrary) {
  std::map<std::string, std::string> before;
  for (const bool other : {false, true}) {
    const detail::AllOptions by{.leaves = other ? Leaves::segments : Leaves::discs,
                                .max_distance = other ? 0.7 : 0.5,
                                .overlap = other ? Overlap::deepest : Overlap::zero,
                                .distance_leaves = other ? Leaves::discs : Leaves::segments};
    scene.options.leaves = other, scene.options.overlap = other;
    scene.options.distance_leaves = !other, scene.options.max_distance = by.max_distance;
    scene.options.threads = other ? 3 : 0;
    const auto expected = answers_of(scene, by);
    EXPECT_NE(before["collide"], expected.at("collide"));
    EXPECT_NE(before["clearance"], expected.at("clearance"));
    before = expected;
    for (const test::CQuery& query : all_queries(scene)) {
      expect_ok(query.run_query());
      EXPECT_TRUE(query.answers() == expected.at(query.name)) << query.name;
    }
  }
}

TEST_P(CApi, AnswersAreTheSameOnEachExecutor) {
  test::expect_same_on_each_executor(
      [&] {
        std::string all;
        for (const test::CQuery& query : all_queries(scene)) {
          expect_ok(query.run_query());
          all += query.answers();
        }
        return all;
      },
      [](const Executor& executor) {
        expect_ok(bch_set_executor(executor.run, executor.context, executor.threads));
      });
}

TEST_P(CApi, ImplementationsAnswerWhereTheProcessorRunsThem) {
  std::vector<std::uint8_t> hits(pairs.size());
  for (std::uint32_t i = 0; bch_implementation_name(i) != nullptr; ++i) {
    bch_query_options by = BCH_QUERY_OPTIONS_INIT;
    by.implementation = bch_implementation_name(i);
    const bch_status status =
        bch_collide(in, &scene.agents, test::c_pairs(pairs), pairs.size(), &by, hits.data());
    EXPECT_EQ(status, bch_implementation_supported(i) ? BCH_OK : BCH_INVALID_ARGUMENT) << by.implementation;
  }
}

TEST_P(CApi, ObstaclesAreThoseOfTheLibrary) {
  const std::vector<double> points_x = {-9, 9, -1, 1, 1, -1}, points_y = {0, 1, -1, -1, 1, 1};
  const std::vector<std::uint64_t> paths = {0, 2, 6}, obstacles = {0, 1, 2};
  const std::vector<std::uint8_t> areas = {0, 1};
  const std::vector<double> bottom = {-HUGE_VAL, 0.5}, top = {0.25, 2};
  const ObstacleSet walls({points_x, points_y, paths, obstacles, areas, bottom, top});
  bch_obstacle_arrays arrays = BCH_OBSTACLE_ARRAYS_INIT;
  arrays.x = points_x.data(), arrays.y = points_y.data();
  arrays.polyline_offsets = paths.data(), arrays.polyline_count = 2;
  arrays.obstacle_offsets = obstacles.data(), arrays.obstacle_count = 2, arrays.is_area = areas.data();
  arrays.bottom = bottom.data(), arrays.top = top.data();
  const auto own = made<bch_obstacles_free>(bch_obstacles_create, &arrays);
  std::uint32_t count = 0, segments = 0, owner = 9;
  expect_ok(bch_obstacles_get_counts(own.get(), &count, &segments));
  EXPECT_EQ(count, walls.obstacle_count());
  EXPECT_EQ(segments, walls.segment_count());
  expect_ok(bch_obstacles_get_owner(own.get(), 3, &owner));
  EXPECT_EQ(owner, walls.obstacle_of(3));

  const auto expect_same_hits = [&](const ObstacleSet& among, const test::OwnedObstacles& same) {
    std::vector<std::uint8_t> hits(agents.size()), c_hits(hits);
    collide(set, agents, among, hits);
    expect_ok(bch_obstacles_collide(in, &scene.agents, same.get(), nullptr, c_hits.data()));
    EXPECT_EQ(hits, c_hits);
  };
  expect_same_hits(walls, own);
  const char* const text = "LINESTRING(-9 0, 9 1) POLYGON((-1 -1, 1 -1, 1 1, -1 1))";
  for (const double from : {-HUGE_VAL, 0.5, 100.0})
    expect_same_hits(obstacles_from_wkt(text, Polygons::walkable, from, 101),
                     made<bch_obstacles_free>(bch_obstacles_from_wkt, text, 1, from, 101));
}

TEST_P(CApi, TellsWhatASetHas) {
  bch_shape_set_info info = BCH_SHAPE_SET_INFO_INIT;
  expect_ok(bch_shape_set_get_info(in, &info));
  EXPECT_EQ(info.shapes, set.shape_count());
  EXPECT_EQ(info.levels, set.level_count());
  EXPECT_EQ(info.outlines != 0, set.plan().outlines);
  EXPECT_EQ(info.has_heights != 0, set.has_heights());
  EXPECT_EQ(info.exact_leaves != 0, set.exact_leaves());
  EXPECT_TRUE(std::ranges::equal(set.depths(), std::span(info.depths, info.levels)));
  const std::uint32_t shape = 5, level = 1;
  float radius = 0;
  expect_ok(bch_shape_set_get_radius(in, shape, &radius));
  EXPECT_EQ(radius, set.bounding_radius(shape));
  EXPECT_EQ(bytes(set.discs(shape, level)), bytes(test::discs_of(in, shape, level)));
  std::size_t findings = 9;
  expect_ok(bch_shape_set_verify(in, 10, nullptr, nullptr, &findings));
  EXPECT_EQ(findings, 0u);
}

TEST_P(CApi, TellsOutlines) {
  const std::uint32_t shape = 2;
  const Outline expected = shapes()[shape].outline;
  bch_outline outline = BCH_OUTLINE_INIT;
  expect_ok(bch_shape_set_get_outline(in, shape, &outline));
  std::vector<bch_vec2> points(outline.point_count);
  std::vector<std::uint64_t> offsets(outline.offset_count);
  outline.points = points.data(), outline.point_capacity = points.size();
  outline.offsets = offsets.data(), outline.offset_capacity = offsets.size();
  expect_ok(bch_shape_set_get_outline(in, shape, &outline));
  EXPECT_EQ(bytes(points), bytes(expected.points));
  EXPECT_EQ(std::vector<std::uint32_t>(offsets.begin(), offsets.end()), expected.contour_begin);
}

}  // namespace
}  // namespace bch
