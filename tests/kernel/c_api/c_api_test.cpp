// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <cstring>
#include <span>
#include <vector>

#include <bch/bch.hpp>

#include "tests/support/c_api.hpp"
#include "tests/support/scenes.hpp"

// What the C interface answers is what the C++ library does, bit by bit.

namespace bch {
namespace {

using test::c_agents;
using test::c_pairs;
using test::expect_ok;
using test::made;

template <class Own, class Other>
void expect_same(std::span<const Own> own, std::span<const Other> other, const char* what) {
  static_assert(sizeof(Own) == sizeof(Other));
  ASSERT_EQ(own.size(), other.size()) << what;
  EXPECT_TRUE(own.empty() || std::memcmp(own.data(), other.data(), own.size_bytes()) == 0) << what;
}

/// Members one by one, as the bytes between them have any value.
void expect_same_depths(const std::vector<Penetration>& own,
                        const std::vector<bch_penetration_depth>& other) {
  ASSERT_EQ(own.size(), other.size());
  for (std::size_t i = 0; i < own.size(); ++i)
    ASSERT_EQ(own[i], (Penetration{other[i].depth, other[i].x, other[i].y})) << i;
}

struct Case {
  const char* name;
  std::vector<float> slices;
};
std::ostream& operator<<(std::ostream& to, const Case& of) {
  return to << of.name;
}

class CApi : public testing::TestWithParam<Case> {
 protected:
  CApi() {
    scene = random_scene(random, set, 10'000);
    if (!GetParam().slices.empty())
      for (std::size_t i = 0; i < scene.crowd.x.size(); ++i)
        scene.crowd.z.push_back(i % 3 == 0 ? 0 : random.uniform(-1, 1));
    options.semantics = BCH_SOLID, options.max_distance = 0.7, options.overlap = BCH_OVERLAP_DEEPEST;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      x.push_back(random.uniform(-2, 2)), y.push_back(random.uniform(-2, 2));
      directions.push_back({static_cast<float>(x.back()), static_cast<float>(y.back())});
    }
  }

  std::vector<Shape> shapes() const {
    std::vector<Shape> all = test::synthetic_shapes(281, 12);
    if (GetParam().slices.empty()) return all;
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].heights = {0, 1.7f};
      if (i % 4 == 3) continue;
      const Shape whole = all[i];
      all[i] = {{}, {}, {0, 1.7f}, {whole, all[(i + 5) % 12], whole}};
      for (Shape& slab : all[i].slabs) slab.slabs.clear();
    }
    return all;
  }

  test::Random random{282};
  const ShapeSet set{shapes(), {.depths = {0, 3, all_depths}, .slices = GetParam().slices}};
  const test::OwnedSet c_set = test::c_set(set);
  test::PairScene scene;
  std::vector<double> x, y;
  std::vector<Vec2> directions;
  bch_query_options options = BCH_QUERY_OPTIONS_INIT;
  const QueryOptions own{.semantics = Semantics::solid, .max_distance = 0.7, .overlap = Overlap::deepest};
};

INSTANTIATE_TEST_SUITE_P(Of, CApi, testing::Values(Case{"Whole", {}}, Case{"Slabs", {0.5f, 1.2f}}),
                         [](const auto& of) { return of.param.name; });

TEST_P(CApi, AnswersAboutPairsAreThoseOfTheLibrary) {
  const Agents agents = scene.crowd.agents();
  const bch_agents of = c_agents(scene.crowd);
  const std::size_t n = scene.pairs.size();
  const bch_pair* const pairs = c_pairs(scene.pairs);
  for (const std::uint32_t threads : {0u, 1u, 3u}) {
    options.threads = threads;
    std::vector<std::uint8_t> hits(n), c_hits(n, 7);
    collide(set, agents, scene.pairs, hits, own);
    expect_ok(bch_collide(c_set.get(), &of, pairs, n, &options, c_hits.data()));
    EXPECT_EQ(hits, c_hits);

    const double near[] = {0.3};
    within(set, agents, scene.pairs, near, hits, own);
    expect_ok(bch_within(c_set.get(), &of, pairs, n, near, 1, &options, c_hits.data()));
    EXPECT_EQ(hits, c_hits);

    std::vector<float> distance(n), c_distance(n);
    std::vector<Vec2> direction(n);
    std::vector<DiscPair> discs(n);
    std::vector<NearestPoints> points(n);
    std::vector<bch_vec2> c_direction(n);
    std::vector<bch_disc_pair> c_discs(n);
    std::vector<bch_nearest_points> c_points(n);
    clearance(set, agents, scene.pairs, {distance, direction, discs, points}, own);
    bch_clearance_out out = BCH_CLEARANCE_OUT_INIT;
    out.distance = c_distance.data(), out.direction = c_direction.data();
    out.discs = c_discs.data(), out.points = c_points.data();
    expect_ok(bch_clearance(c_set.get(), &of, pairs, n, &options, &out));
    EXPECT_EQ(distance, c_distance);
    expect_same<Vec2, bch_vec2>(direction, c_direction, "direction");
    expect_same<DiscPair, bch_disc_pair>(discs, c_discs, "discs");
    expect_same<NearestPoints, bch_nearest_points>(points, c_points, "points");

    std::vector<Penetration> depths(n);
    std::vector<bch_penetration_depth> c_depths(n);
    penetration(set, agents, scene.pairs, 16, depths);
    expect_ok(bch_penetration(c_set.get(), &of, pairs, n, 16, &options, c_depths.data()));
    expect_same_depths(depths, c_depths);
    penetration_along(set, agents, scene.pairs, directions, depths);
    expect_ok(bch_penetration_along(c_set.get(), &of, pairs, n,
                                    reinterpret_cast<const bch_vec2*>(directions.data()), &options,
                                    c_depths.data()));
    expect_same_depths(depths, c_depths);

    time_of_impact(set, agents, scene.pairs, {x, y}, distance);
    expect_ok(
        bch_time_of_impact(c_set.get(), &of, pairs, n, x.data(), y.data(), &options, c_distance.data()));
    EXPECT_EQ(distance, c_distance);
  }
}

TEST_P(CApi, EveryOptionArrives) {
  const Agents agents = scene.crowd.agents();
  const bch_agents of = c_agents(scene.crowd);
  const std::size_t n = scene.pairs.size();
  std::vector<float> distance(n), c_distance(n);
  std::vector<std::uint8_t> hits(n), c_hits(n);
  bch_clearance_out out = BCH_CLEARANCE_OUT_INIT;
  out.distance = c_distance.data();
  std::size_t different = 0;
  for (const bool one : {false, true})
    for (const bool other : {false, true}) {
      const QueryOptions mine{.semantics = one ? Semantics::solid : Semantics::boundary,
                              .leaves = other ? Leaves::segments : Leaves::discs,
                              .overlap = one ? Overlap::deepest : Overlap::zero,
                              .distance_leaves = other ? Leaves::segments : Leaves::discs};
      bch_query_options same = BCH_QUERY_OPTIONS_INIT;
      same.semantics = one, same.leaves = other, same.overlap = one, same.distance_leaves = other;
      const std::vector<float> before = distance;
      collide(set, agents, scene.pairs, hits, mine);
      clearance(set, agents, scene.pairs, {distance}, mine);
      expect_ok(bch_collide(c_set.get(), &of, c_pairs(scene.pairs), n, &same, c_hits.data()));
      expect_ok(bch_clearance(c_set.get(), &of, c_pairs(scene.pairs), n, &same, &out));
      EXPECT_EQ(hits, c_hits);
      EXPECT_EQ(distance, c_distance);
      different += before != distance;
    }
  EXPECT_EQ(different, 3u);  // the deepest overlaps are those of discs, whatever the leaves
  for (std::uint32_t i = 0; bch_implementation_name(i) != nullptr; ++i) {
    bch_query_options by = BCH_QUERY_OPTIONS_INIT;
    by.implementation = bch_implementation_name(i);
    const bch_status status = bch_collide(c_set.get(), &of, c_pairs(scene.pairs), n, &by, c_hits.data());
    EXPECT_EQ(status, bch_implementation_supported(i) ? BCH_OK : BCH_INVALID_ARGUMENT) << by.implementation;
  }
}

TEST_P(CApi, AnswersAboutCrowdsAreThoseOfTheLibrary) {
  test::Crowd& crowd = scene.crowd;
  for (std::size_t i = 0; i < crowd.x.size(); ++i)
    crowd.x[i] = random.uniform(-40, 40), crowd.y[i] = random.uniform(-40, 40);
  const Agents agents = crowd.agents();
  const bch_agents of = c_agents(crowd);

  const auto phase = made<test::OwnedBroadPhase>(bch_broad_phase_create);
  const bch_pair* pairs = nullptr;
  std::size_t count = 0;
  expect_ok(bch_broad_phase_find(phase.get(), c_set.get(), &of, 0.4, &options, &pairs, &count));
  expect_same<Pair, bch_pair>(candidate_pairs(set, agents, 0.4), {pairs, count}, "candidates");

  CrowdCollider collider;
  const auto c_collider = made<test::OwnedCollider>(bch_crowd_collider_create);
  Rows<std::uint32_t> rows = collider.collide_all(set, agents, own);
  bch_index_rows c_rows, touched;
  expect_ok(bch_crowd_collider_collide_all(c_collider.get(), c_set.get(), &of, nullptr, &options, &c_rows,
                                           nullptr));
  EXPECT_GT(rows.values.size(), 100u);
  ASSERT_EQ(rows.size(), c_rows.rows);
  expect_same<std::uint64_t, std::uint64_t>(rows.offsets, {c_rows.offsets, c_rows.rows + 1}, "offsets");
  expect_same<std::uint32_t, std::uint32_t>(rows.values, {c_rows.values, rows.values.size()}, "neighbours");

  const char* const text = "LINESTRING(-40 0, 40 1) POLYGON((-9 -9, 9 -9, 9 9, -9 9))";
  const ObstacleSet walls = obstacles_from_wkt(text);
  const auto c_walls =
      made<test::OwnedObstacles>([&](bch_obstacles** to) { return bch_obstacles_from_wkt(text, 0, to); });
  const CrowdCollisions both = collider.collide_all(set, agents, walls, own);
  expect_ok(bch_crowd_collider_collide_all(c_collider.get(), c_set.get(), &of, c_walls.get(), &options,
                                           &c_rows, &touched));
  EXPECT_GT(both.obstacles.values.size(), 10u);
  expect_same<std::uint32_t, std::uint32_t>(both.agents.values, {c_rows.values, both.agents.values.size()},
                                            "agents");
  expect_same<std::uint64_t, std::uint64_t>(both.obstacles.offsets, {touched.offsets, touched.rows + 1},
                                            "offsets");
  expect_same<std::uint32_t, std::uint32_t>(both.obstacles.values,
                                            {touched.values, both.obstacles.values.size()}, "obstacles");

  ContactFinder finder;
  const auto c_finder = made<test::OwnedFinder>(bch_contact_finder_create);
  bch_contact_rows contacts;
  const CrowdContacts all = finder.find_all(set, agents, own);
  expect_ok(bch_contact_finder_find_all(c_finder.get(), c_set.get(), &of, &options, &contacts));
  ASSERT_EQ(all.contacts.size(), contacts.rows);
  expect_same<Pair, bch_pair>(all.pairs, {contacts.pairs, contacts.rows}, "pairs");
  expect_same<DiscPair, bch_disc_pair>(all.contacts.values, {contacts.values, all.contacts.values.size()},
                                       "all");
  const Rows<DiscPair> some = finder.find(set, agents, scene.pairs, own);
  expect_ok(bch_contact_finder_find(c_finder.get(), c_set.get(), &of, c_pairs(scene.pairs),
                                    scene.pairs.size(), &options, &contacts));
  expect_same<std::uint64_t, std::uint64_t>(some.offsets, {contacts.offsets, contacts.rows + 1}, "offsets");
  expect_same<DiscPair, bch_disc_pair>(some.values, {contacts.values, some.values.size()}, "contacts");
}

TEST_P(CApi, AnswersAboutObstaclesAreThoseOfTheLibrary) {
  const std::vector<double> points_x = {-9, 9, -1, 1, 1, -1}, points_y = {0, 1, -1, -1, 1, 1};
  const std::vector<std::uint64_t> paths = {0, 2, 6}, obstacles = {0, 1, 2};
  const std::vector<std::uint8_t> areas = {0, 1};
  const std::vector<double> bottom = {-HUGE_VAL, 0.5}, top = {0.25, 2};
  const ObstacleSet walls({points_x, points_y, paths, obstacles, areas, bottom, top});
  bch_obstacle_arrays arrays = BCH_OBSTACLE_ARRAYS_INIT;
  arrays.x = points_x.data(), arrays.y = points_y.data(), arrays.path_offsets = paths.data(),
  arrays.path_count = 2;
  arrays.obstacle_offsets = obstacles.data(), arrays.obstacle_count = 2, arrays.is_area = areas.data();
  arrays.bottom = bottom.data(), arrays.top = top.data();
  const auto c_walls =
      made<test::OwnedObstacles>([&](bch_obstacles** to) { return bch_obstacles_create(&arrays, to); });
  std::uint32_t count = 0, segments = 0, owner = 9;
  expect_ok(bch_obstacles_get_counts(c_walls.get(), &count, &segments));
  EXPECT_EQ(count, walls.obstacle_count());
  EXPECT_EQ(segments, walls.segment_count());
  expect_ok(bch_obstacles_get_owner(c_walls.get(), 3, &owner));
  EXPECT_EQ(owner, walls.obstacle_of(3));

  const Agents agents = scene.crowd.agents();
  const bch_agents of = c_agents(scene.crowd);
  const std::size_t n = agents.size();
  std::vector<std::uint8_t> hits(n), c_hits(n);
  collide(set, agents, walls, hits, own);
  expect_ok(bch_obstacles_collide(c_set.get(), &of, c_walls.get(), &options, c_hits.data()));
  EXPECT_EQ(hits, c_hits);
  const char* const text = "LINESTRING(-9 0, 9 1) POLYGON((-1 -1, 1 -1, 1 1, -1 1))";
  for (const double from : {-HUGE_VAL, 0.5, 100.0}) {
    const auto c_text_walls = made<test::OwnedObstacles>(
        [&](bch_obstacles** to) { return bch_obstacles_from_wkt_at(text, 1, from, 101, to); });
    collide(set, agents, obstacles_from_wkt(text, Polygons::walkable, from, 101), hits, own);
    expect_ok(bch_obstacles_collide(c_set.get(), &of, c_text_walls.get(), &options, c_hits.data()));
    EXPECT_EQ(hits, c_hits) << from;
  }
  const std::vector<double> near(n, 0.25);
  within(set, agents, walls, near, hits, own);
  expect_ok(bch_obstacles_within(c_set.get(), &of, c_walls.get(), near.data(), n, &options, c_hits.data()));
  EXPECT_EQ(hits, c_hits);
  std::vector<float> distance(n), c_distance(n);
  std::vector<DiscPair> discs(n);
  std::vector<bch_disc_pair> c_discs(n);
  clearance(set, agents, walls, {.distance = distance, .discs = discs}, own);
  bch_clearance_out out = BCH_CLEARANCE_OUT_INIT;
  out.distance = c_distance.data(), out.discs = c_discs.data();
  expect_ok(bch_obstacles_clearance(c_set.get(), &of, c_walls.get(), &options, &out));
  EXPECT_EQ(distance, c_distance);
  expect_same<DiscPair, bch_disc_pair>(discs, c_discs, "discs");
  std::vector<Penetration> depths(n);
  std::vector<bch_penetration_depth> c_depths(n);
  penetration(set, agents, walls, depths);
  expect_ok(bch_obstacles_penetration(c_set.get(), &of, c_walls.get(), &options, c_depths.data()));
  expect_same_depths(depths, c_depths);
  const std::vector<double> way_x(n, 1.5), way_y(n, -0.5);
  time_of_impact(set, agents, {way_x, way_y}, walls, distance);
  expect_ok(bch_obstacles_time_of_impact(c_set.get(), &of, c_walls.get(), way_x.data(), way_y.data(),
                                         &options, c_distance.data()));
  EXPECT_EQ(distance, c_distance);
}

TEST_P(CApi, TellsWhatASetHas) {
  bch_shape_set_info info = BCH_SHAPE_SET_INFO_INIT;
  expect_ok(bch_shape_set_get_info(c_set.get(), &info));
  EXPECT_EQ(info.shapes, set.shape_count());
  EXPECT_EQ(info.levels, set.level_count());
  EXPECT_EQ(info.slabs, set.slab_count());
  EXPECT_EQ(info.solid != 0, set.solid());
  EXPECT_EQ(info.has_heights != 0, set.has_heights());
  EXPECT_EQ(info.exact_leaves != 0, set.exact_leaves());
  expect_same<std::uint32_t, std::uint32_t>(set.depths(), {info.depths, info.levels}, "depths");
  expect_same<float, float>(set.slices(), {info.slices, info.slabs - 1}, "slices");
  for (std::uint32_t shape = 0; shape < info.shapes; ++shape) {
    float radius = 0;
    expect_ok(bch_shape_set_get_radius(c_set.get(), shape, &radius));
    EXPECT_EQ(radius, set.bounding_radius(shape));
    for (std::uint32_t level = 0; level < info.levels; ++level) {
      const std::vector<Disc> discs = set.discs(shape, level);
      std::size_t count = 0;
      expect_ok(bch_shape_set_get_discs(c_set.get(), shape, level, nullptr, 0, &count));
      std::vector<bch_disc> c_discs(count);
      expect_ok(bch_shape_set_get_discs(c_set.get(), shape, level, c_discs.data(), count, &count));
      expect_same<Disc, bch_disc>(discs, c_discs, "discs");
      std::vector<std::uint32_t> offsets(info.slabs + 1);
      expect_ok(bch_shape_set_get_slab_offsets(c_set.get(), shape, level, offsets.data()));
      EXPECT_EQ(offsets, set.slab_begin(shape, level));
    }
  }
  std::size_t findings = 9;
  expect_ok(bch_shape_set_verify(c_set.get(), 10, nullptr, nullptr, &findings));
  EXPECT_EQ(findings, 0u);
}

/// A slab's contours, or those of a whole body.
Outline outline_of(const bch_shape_set* set, std::uint32_t shape, std::uint32_t slab) {
  bch_outline outline = BCH_OUTLINE_INIT;
  expect_ok(bch_shape_set_get_outline(set, shape, slab, &outline));
  std::vector<bch_vec2> points(outline.point_count);
  std::vector<std::uint64_t> offsets(outline.offset_count);
  outline.points = points.data(), outline.point_capacity = points.size();
  outline.offsets = offsets.data(), outline.offset_capacity = offsets.size();
  expect_ok(bch_shape_set_get_outline(set, shape, slab, &outline));
  Outline all;
  for (const bch_vec2& point : points) all.points.push_back({point.x, point.y});
  all.contour_begin.assign(offsets.begin(), offsets.end());
  return all;
}

TEST_P(CApi, TellsOutlines) {
  const std::vector<Shape> of = shapes();
  const auto expect_equal = [](const Outline& expected, const Outline& found) {
    EXPECT_EQ(expected.points, found.points);
    EXPECT_EQ(expected.contour_begin, found.contour_begin);
  };
  for (std::uint32_t shape = 0; shape < of.size(); ++shape) {
    if (of[shape].slabs.empty()) expect_equal(of[shape].outline, outline_of(c_set.get(), shape, 0));
    for (std::uint32_t slab = 0; slab < of[shape].slabs.size(); ++slab)
      expect_equal(of[shape].slabs[slab].outline, outline_of(c_set.get(), shape, slab));
    if (of[shape].slabs.empty()) continue;
    Outline all;
    for (const Shape& slab : of[shape].slabs) test::append(all, slab.outline);
    EXPECT_EQ(all.points.size(), outline_of(c_set.get(), shape, BCH_ALL_SLABS).points.size());
  }
}

}  // namespace
}  // namespace bch
