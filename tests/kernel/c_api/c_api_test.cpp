// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/bch_files.h>

#include <thread>

#include "kernel/runtime/all_options.hpp"
#include "tests/support/c_api.hpp"
#include "tests/support/c_api_queries.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/gltf_file.hpp"
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
  const bch::Crowd::Penetrations apart = crowd.penetrations(set, agents, 16, by);
  all["penetrations"] =
      bytes(apart.pairs.span()) +
      bytes_of(std::vector<Penetration>(apart.penetrations.begin(), apart.penetrations.end()));

  hits.resize(people), depths.resize(people), distance.resize(people);
  direction.resize(people), discs.resize(people), points.resize(people);
  collide(set, agents, walls, hits, by), all["walls: collide"] = bytes(hits);
  within(set, agents, walls, nearer.first(people), hits, by.distance_leaves, by.implementation),
      all["walls: within"] = bytes(hits);
  penetration(set, agents, walls, depths), all["walls: penetration"] = bytes_of(depths);
  time_of_impact(set, agents, {x.first(people), y.first(people)}, walls, distance);
  all["walls: time of impact"] = bytes(distance);
  clearance(set, agents, walls, {distance, direction, discs, points}, by);
  all["walls: clearance"] = bytes(distance) + bytes(direction) + bytes(discs) + bytes(points);
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
      expect_ok(query.ask());
      EXPECT_TRUE(query.answers() == expected.at(query.name)) << query.name;
    }
  }
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
  arrays.path_offsets = paths.data(), arrays.path_count = 2;
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
  const std::vector<Disc> discs = set.discs(shape, level);
  std::size_t count = 0;
  expect_ok(bch_shape_set_get_discs(in, shape, level, nullptr, 0, &count));
  ASSERT_EQ(discs.size(), count);
  std::vector<bch_disc> c_discs(count);
  expect_ok(bch_shape_set_get_discs(in, shape, level, c_discs.data(), count, &count));
  EXPECT_EQ(bytes(discs), bytes(c_discs));
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

// ---- What the C interface reads from files: characters and recordings. Their objects and errors are those of the library of queries.

using OwnedTrajectory = test::Owned<bch_trajectory, bch_trajectory_free>;
using OwnedCheck = test::Owned<bch_check, bch_check_free>;

TEST(CApiFiles, CharactersAreImported) {
  const TemporaryFolder folder;
  const std::string file = folder.write("strip.gltf", SkinnedStrip{}.text());
  const auto character = made<bch_character_free>(bch_character_import, file.c_str(), nullptr);
  bch_character_info info = BCH_CHARACTER_INFO_INIT;
  expect_ok(bch_character_get_info(character.get(), &info));
  EXPECT_EQ(info.triangles, 2u);
  EXPECT_STREQ(info.name, "strip.gltf");
  const char* name = nullptr;
  float seconds = 0;
  expect_ok(bch_character_get_clip(character.get(), 0, &name, &seconds));
  EXPECT_STREQ(name, "walk");
  EXPECT_GT(seconds, 0);
  EXPECT_EQ(bch_character_get_clip(character.get(), info.clips, &name, &seconds), BCH_OUT_OF_RANGE);

  bch_import_options options = BCH_IMPORT_OPTIONS_INIT;
  options.progress = [](void*, std::uint64_t, std::uint64_t) { return 1; };
  bch_character* none = nullptr;
  EXPECT_EQ(bch_character_import(file.c_str(), &options, &none), BCH_CANCELLED);
  options = BCH_IMPORT_OPTIONS_INIT;
  options.most_triangles = 1;
  EXPECT_EQ(bch_character_import(file.c_str(), &options, &none), BCH_BAD_FILE);
  EXPECT_EQ(bch_character_import("/nowhere/a.glb", nullptr, &none), BCH_FILE_NOT_FOUND);
  EXPECT_EQ(none, nullptr);
  EXPECT_STREQ(bch_last_error(), "/nowhere/a.glb: no such file");
}

/// Two people who walk through each other, in ten frames.
class CApiRecordings : public testing::Test {
 protected:
  OwnedTrajectory opened() const {
    bch_trajectory_options options = BCH_TRAJECTORY_OPTIONS_INIT;
    options.fps = 10, options.unit = 1;
    return made<bch_trajectory_free>(bch_trajectory_open, file.c_str(), &options);
  }
  OwnedCheck checked(const bch_check_options& options) const {
    const auto trajectory = opened();
    return made<bch_check_free>(bch_check_run, trajectory.get(), &options);
  }
  static std::string rows() {
    std::string all = "frame,id,x,y,character,clip,clip_time\n";
    for (int k = 0; k < 10; ++k)
      all += std::to_string(k) + ",7," + std::to_string(0.1 * k - 0.5) + ",0,,,\n" + std::to_string(k) +
             ",5," + std::to_string(0.5 - 0.1 * k) + ",0.1,,,\n";
    return all;
  }

  const TemporaryFolder folder;
  const std::string file = folder.write("two.csv", rows());
};

TEST_F(CApiRecordings, AreRead) {
  const std::string named = folder.write(
      "named.csv", "frame,id,x,y,character,clip,clip_time\n3,1,0,2,man,walk,0.25\n3,2,5,0,,,\n4,1,0,0,,,\n");
  bch_trajectory_options options = BCH_TRAJECTORY_OPTIONS_INIT;
  options.fps = 10, options.unit = 0.5;
  const auto trajectory = made<bch_trajectory_free>(bch_trajectory_open, named.c_str(), &options);
  bch_trajectory_info info = BCH_TRAJECTORY_INFO_INIT;
  expect_ok(bch_trajectory_get_info(trajectory.get(), &info));
  EXPECT_EQ(info.fps, 10);
  EXPECT_EQ(info.rows, 3u);
  EXPECT_EQ(info.people, 2u);
  EXPECT_EQ(info.first_frame, 3);
  EXPECT_EQ(info.last_frame, 4);
  EXPECT_STREQ(info.geometry, "");
  EXPECT_NE(std::string(info.format), "");
  const bch_named_motion* motions = nullptr;
  std::size_t count = 0;
  expect_ok(bch_trajectory_get_motions(trajectory.get(), &motions, &count));
  ASSERT_EQ(count, 1u);
  EXPECT_STREQ(motions[0].character, "man");
  EXPECT_STREQ(motions[0].clip, "walk");
  bch_tracked_person people[3];
  EXPECT_EQ(bch_trajectory_read(trajectory.get(), people, 1, &count), BCH_INVALID_ARGUMENT);
  EXPECT_STREQ(bch_last_error(), "capacity is 1, and frame 3 has 2 people");
  expect_ok(bch_trajectory_read(trajectory.get(), people, 2, &count));  // whole frames
  ASSERT_EQ(count, 2u);
  EXPECT_EQ(people[0].frame, 3);
  EXPECT_EQ(people[0].id, 1);
  EXPECT_EQ(people[0].y, 1);
  EXPECT_EQ(people[0].motion, 0u);
  EXPECT_EQ(people[0].clip_seconds, 0.25f);
  EXPECT_TRUE(std::isnan(people[0].heading) && std::isnan(people[0].stature));
  EXPECT_EQ(people[1].motion, BCH_NO_MOTION);
  expect_ok(bch_trajectory_read(trajectory.get(), people, 3, &count));
  EXPECT_EQ(count, 1u);
  expect_ok(bch_trajectory_read(trajectory.get(), people, 3, &count));
  EXPECT_EQ(count, 0u);
  bch_check* none = nullptr;
  EXPECT_EQ(bch_check_run(trajectory.get(), nullptr, &none), BCH_INVALID_ARGUMENT);
  EXPECT_STREQ(bch_last_error(), "trajectory has been read from; open it again");

  bch_trajectory* other = nullptr;
  const std::string bad = folder.write("bad.csv", "frame,id,x,y\n1,1,zero,0\n");
  EXPECT_EQ(bch_trajectory_open(bad.c_str(), &options, &other), BCH_BAD_FILE);
  EXPECT_NE(std::string(bch_last_error()).find("bad.csv:2"), std::string::npos) << bch_last_error();
  EXPECT_EQ(bch_trajectory_open("/nowhere.csv", &options, &other), BCH_FILE_NOT_FOUND);
  options.progress = [](void*, std::uint64_t, std::uint64_t) { return 1; };
  EXPECT_EQ(bch_trajectory_open(file.c_str(), &options, &other), BCH_CANCELLED);
  EXPECT_EQ(other, nullptr);
}

TEST_F(CApiRecordings, AreChecked) {
  bch_check_options options = BCH_CHECK_OPTIONS_INIT;
  options.max_distance = 0.5;
  const auto check = checked(options);
  const bch_check_frame* frames = nullptr;
  const bch_check_pair* pairs = nullptr;
  const bch_check_event* events = nullptr;
  std::size_t frame_count = 0, pair_count = 0, event_count = 0;
  expect_ok(bch_check_get_frames(check.get(), &frames, &frame_count));
  expect_ok(bch_check_get_pairs(check.get(), &pairs, &pair_count));
  expect_ok(bch_check_get_events(check.get(), &events, &event_count));
  ASSERT_EQ(frame_count, 10u);
  EXPECT_EQ(frames[5].frame, 5);
  EXPECT_EQ(frames[5].people, 2u);
  EXPECT_EQ(frames[5].overlapping, 2u);
  EXPECT_EQ(frames[5].overlapping_pairs, 1u);
  ASSERT_EQ(event_count, 1u);
  EXPECT_EQ(events[0].first, 5);
  EXPECT_EQ(events[0].second, 7);
  EXPECT_EQ(events[0].kind, BCH_CHECK_OVERLAP);
  EXPECT_TRUE(events[0].from <= events[0].worst && events[0].worst <= events[0].to);
  EXPECT_GT(events[0].depth, 0);
  ASSERT_GT(pair_count, events[0].frames);
  EXPECT_EQ(pairs[0].kind, BCH_CHECK_NEAR);
  EXPECT_GT(pairs[0].gap, 0);
  bch_check_summary summary = BCH_CHECK_SUMMARY_INIT;
  expect_ok(bch_check_get_summary(check.get(), &summary));
  EXPECT_EQ(summary.person_frames, 20u);
  EXPECT_EQ(summary.overlapping, 2 * events[0].frames);
  const char* assumptions = nullptr;
  expect_ok(bch_check_get_assumptions(check.get(), &assumptions));
  EXPECT_NE(std::string(assumptions), "");

  // Objects of the library of queries.
  const auto walls =
      made<bch_obstacles_free>(bch_obstacles_from_wkt, "LINESTRING(-9 0, 9 0)", 0, -HUGE_VAL, HUGE_VAL);
  options.walls = walls.get();
  expect_ok(bch_check_get_summary(checked(options).get(), &summary));
  EXPECT_GT(summary.in_walls, 0u);
  options.without_walls = 1;
  const auto man = made<bch_character_free>(bch_character_default, BCH_MALE);
  const bch_character* const people[] = {man.get()};
  options.characters = people, options.character_count = 1;
  expect_ok(bch_check_get_summary(checked(options).get(), &summary));
  EXPECT_GT(summary.overlapping, 0u);
  EXPECT_GT(summary.shapes, 0u);
  options.spheres = 64;
  expect_ok(bch_check_get_summary(checked(options).get(), &summary));
  EXPECT_GT(summary.overlapping, 0u);
  EXPECT_EQ(summary.shapes, 0u);
}

TEST_F(CApiRecordings, ChecksNameWhatIsWrong) {
  const auto said = [&](const bch_check_options& options, bch_status expected) {
    const auto trajectory = opened();
    bch_check* none = nullptr;
    EXPECT_EQ(bch_check_run(trajectory.get(), &options, &none), expected);
    EXPECT_EQ(none, nullptr);
    return std::string(bch_last_error());
  };
  bch_check_options options = BCH_CHECK_OPTIONS_INIT;
  options.max_distance = 11;
  EXPECT_EQ(said(options, BCH_INVALID_ARGUMENT), "options->max_distance is 11.000000");
  options = BCH_CHECK_OPTIONS_INIT;
  bch_obstacles* freed = nullptr;
  expect_ok(bch_obstacles_from_wkt("LINESTRING(0 0, 1 1)", 0, -HUGE_VAL, HUGE_VAL, &freed));
  expect_ok(bch_obstacles_free(freed));
  options.walls = freed;
  EXPECT_EQ(said(options, BCH_INVALID_ARGUMENT), "options->walls is no living bch_obstacles; was it freed?");
  options = BCH_CHECK_OPTIONS_INIT;
  options.spheres = 65;
  EXPECT_NE(said(options, BCH_INVALID_ARGUMENT).find("64, 128, 256 or 512 spheres, found 65"),
            std::string::npos);
  options.leaves = BCH_DISCS;
  EXPECT_EQ(said(options, BCH_INVALID_ARGUMENT),
            "options->depth and options->leaves belong to outlines, not to options->spheres");
  options = BCH_CHECK_OPTIONS_INIT;
  options.max_pairs = 1;
  EXPECT_NE(said(options, BCH_TOO_LARGE).find("pairs of people"), std::string::npos);
  options = BCH_CHECK_OPTIONS_INIT;
  options.progress = [](void*, std::uint64_t, std::uint64_t) { return 1; };
  EXPECT_EQ(said(options, BCH_CANCELLED), "cancelled by the caller");
  EXPECT_EQ(bch_check_free(reinterpret_cast<bch_check*>(freed)), BCH_INVALID_ARGUMENT);
  EXPECT_STREQ(bch_last_error(), "check is no living bch_check; was it freed?");
}

// ---- What callers get wrong is a status and a line, and nothing is written.

class CApiMisuse : public testing::Test {
 protected:
  const test::OwnedSet set = test::c_set(ShapeSet(test::synthetic_shapes(283, 3)));
  test::Crowd crowd = [] {
    test::Crowd two;
    two.add({0, 0, 0, 0, 0}), two.add({1, 0.1, 0, 0, 0});
    return two;
  }();
  bch_agents agents = test::c_agents(crowd);
  const bch_pair pair{0, 1};
  bch_query_options options = BCH_QUERY_OPTIONS_INIT;
  std::uint8_t hit = 77;

  bch_status ask() { return bch_collide(set.get(), &agents, &pair, 1, &options, &hit); }

  /// Expects an error whose message has a word, and that nothing was written.
  void expect_error(bch_status status, bch_status expected, const std::string& word) {
    EXPECT_EQ(status, expected) << bch_status_name(status);
    const std::string message = bch_last_error();
    EXPECT_NE(message.find(word), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_EQ(hit, 77);
  }
  void expect_invalid(bch_status status, const std::string& word) {
    expect_error(status, BCH_INVALID_ARGUMENT, word);
  }
};

TEST_F(CApiMisuse, StatusesHaveNames) {
  for (bch_status status = BCH_OK; status <= BCH_INTERNAL; ++status)
    EXPECT_TRUE(std::string(bch_status_name(status)).starts_with("BCH_")) << status;
  EXPECT_STREQ(bch_status_name(BCH_INTERNAL), "BCH_INTERNAL");
  EXPECT_STREQ(bch_status_name(BCH_INTERNAL + 1), "unknown");
  EXPECT_STREQ(bch_status_name(-1), "unknown");
  EXPECT_EQ(bch_abi_version(), static_cast<std::uint32_t>(BCH_ABI_VERSION));
}

TEST_F(CApiMisuse, PointersThatAreNull) {
  expect_invalid(bch_collide(nullptr, &agents, &pair, 1, nullptr, &hit), "set is NULL");
  expect_invalid(bch_collide(set.get(), nullptr, &pair, 1, nullptr, &hit), "agents is NULL");
  expect_invalid(bch_collide(set.get(), &agents, nullptr, 1, nullptr, &hit), "pairs is NULL");
  expect_invalid(bch_collide(set.get(), &agents, &pair, 1, nullptr, nullptr), "hits is NULL");
  expect_invalid(bch_shape_set_load(nullptr, 0, nullptr), "path is NULL");
  expect_invalid(bch_crowd_create(nullptr, nullptr), "crowd is NULL");
  expect_invalid(bch_obstacles_from_wkt(nullptr, 0, 0, 1, nullptr), "is NULL");
  expect_invalid(bch_obstacles_from_wkt("POINT", 0, 0, 1, nullptr), "obstacles is NULL");
  agents.heading = nullptr;
  expect_invalid(ask(), "agents->heading is NULL");
  // Nothing to do is no mistake.
  agents = test::c_agents(crowd);
  expect_ok(bch_collide(set.get(), &agents, nullptr, 0, nullptr, nullptr));
  expect_ok(bch_shape_set_free(nullptr));
}

TEST_F(CApiMisuse, ObjectsThatAreNot) {
  bch_crowd* crowd_of_pairs = nullptr;
  expect_ok(bch_crowd_create(nullptr, &crowd_of_pairs));
  const bch_pair* pairs = nullptr;
  std::size_t count = 0;
  expect_invalid(bch_crowd_collisions(reinterpret_cast<bch_crowd*>(set.get()), set.get(), &agents, nullptr,
                                      nullptr, &pairs, &count),
                 "crowd is no living bch_crowd");
  expect_ok(bch_crowd_free(crowd_of_pairs));
  expect_invalid(bch_crowd_free(crowd_of_pairs), "was it freed?");
  expect_invalid(bch_crowd_collisions(crowd_of_pairs, set.get(), &agents, nullptr, nullptr, &pairs, &count),
                 "was it freed?");
  EXPECT_EQ(pairs, nullptr);
}

TEST_F(CApiMisuse, TheSetThatADynamicOneLends) {
  bch_dynamic_shape_set* dynamic = nullptr;
  const bch_shape_set* lent = nullptr;
  expect_ok(bch_dynamic_shape_set_create(set.get(), &dynamic));
  expect_ok(bch_dynamic_shape_set_get_shapes(dynamic, &lent));
  expect_ok(bch_collide(lent, &agents, &pair, 1, nullptr, &hit));
  hit = 77;
  expect_invalid(bch_shape_set_free(const_cast<bch_shape_set*>(lent)), "belongs to");
  expect_ok(bch_dynamic_shape_set_free(dynamic));
  expect_invalid(bch_collide(lent, &agents, &pair, 1, nullptr, &hit), "no living bch_shape_set");
}

/// Structs of callers that were built with other versions.
TEST_F(CApiMisuse, SizesOfThePastAndOfTheFuture) {
  struct {
    bch_query_options known = BCH_QUERY_OPTIONS_INIT;
    std::uint64_t later[2] = {0, 0};
  } future;
  future.known.size = sizeof future;
  expect_ok(bch_collide(set.get(), &agents, &pair, 1, &future.known, &hit));
  EXPECT_EQ(hit, 1);
  hit = 77;
  future.later[1] = 5;
  expect_invalid(
      bch_collide(set.get(), &agents, &pair, 1, &future.known, &hit),
      "options->size is " + std::to_string(sizeof future) + ", and fields that this version does not know");

  // Of the past: what it does not have yet is as if it had been left alone.
  options.leaves = 99;
  options.size = offsetof(bch_query_options, leaves);
  expect_ok(ask());
  hit = 77;
  options.size = sizeof options;
  expect_invalid(ask(), "options->leaves is 99");
  for (const std::uint32_t size : {0u, 3u, 5000u}) {
    options.size = size;
    expect_invalid(ask(), "options->size is " + std::to_string(size));
  }

  // No version ends inside a member.
  options = BCH_QUERY_OPTIONS_INIT;
  static_assert(offsetof(bch_query_options, threads) == 16);  // no member has bytes 20 to 24
  static_assert(offsetof(bch_query_options, max_distance) == 24 && sizeof options == 40);
  for (std::uint32_t size = 4; size <= sizeof options; ++size) {
    options.size = size;
    if ((size % 4 == 0 || size / 4 == 5) && size != 28 && size != 36) {
      expect_ok(ask());
      hit = 77;
    } else {
      expect_invalid(ask(), "options->size is " + std::to_string(size) + ", inside a member");
    }
  }
  bch_clearance_out cut = BCH_CLEARANCE_OUT_INIT;
  cut.size = offsetof(bch_clearance_out, points) + 4;
  expect_invalid(bch_clearance(set.get(), &agents, &pair, 1, nullptr, &cut), "inside a member");

  bch_shape_set_info info = BCH_SHAPE_SET_INFO_INIT;
  info.size = offsetof(bch_shape_set_info, bytes) + 4;
  expect_invalid(bch_shape_set_get_info(set.get(), &info), "inside a member");
  EXPECT_EQ(info.shapes, 0u);
  info.bytes = 123;
  info.size = offsetof(bch_shape_set_info, bytes);
  expect_ok(bch_shape_set_get_info(set.get(), &info));
  EXPECT_EQ(info.bytes, 123u);
  EXPECT_EQ(info.size, offsetof(bch_shape_set_info, bytes));
  EXPECT_GT(info.shapes, 0u);
}

TEST_F(CApiMisuse, ValuesAndTheirPlaces) {
  crowd.x[1] = std::nan("");
  expect_invalid(ask(), "agent 1");
  crowd.x[1] = 0;
  crowd.shape[0] = 50;
  expect_invalid(ask(), "50");
  expect_invalid(bch_validate_agents(set.get(), &agents), "50");
  crowd.shape[0] = 0;
  const bch_pair beyond{0, 2};
  expect_invalid(bch_collide(set.get(), &agents, &beyond, 1, nullptr, &hit), "pair 0");
  options.threads = 100'000;
  expect_invalid(ask(), "threads is 100000");
  options.threads = 0, options.implementation = "mmx";
  expect_invalid(ask(), "mmx");
  options.implementation = nullptr, options.leaves = 2;
  expect_invalid(ask(), "options->leaves is 2");
  options.leaves = 0;
  bch_disc disc;
  std::size_t count = 9;
  expect_error(bch_shape_set_get_discs(set.get(), 50, 0, &disc, 1, &count), BCH_OUT_OF_RANGE, "50");
  EXPECT_EQ(count, 9u);
  expect_invalid(bch_collide(set.get(), &agents, &pair, SIZE_MAX / 2, nullptr, &hit),
                 "pairs has " + std::to_string(SIZE_MAX / 2));
  bch_shape_set* none = nullptr;
  expect_error(bch_shape_set_load("/nowhere/a.bch", BCH_READ, &none), BCH_FILE_NOT_FOUND,
               "/nowhere/a.bch: no such");
  expect_error(bch_shape_set_load("/nowhere/a\nb", BCH_READ, &none), BCH_FILE_NOT_FOUND, "/nowhere/a b");
  expect_error(bch_shape_set_load("/", BCH_READ, &none), BCH_BAD_FILE, "/");
  expect_error(bch_shape_set_save(set.get(), "/nowhere/a.bch"), BCH_BAD_FILE, "/nowhere/a.bch");
  EXPECT_EQ(none, nullptr);
}

TEST_F(CApiMisuse, PlansAndBodies) {
  const std::uint32_t depths[] = {3, 0};
  bch_shape_set_builder* none = nullptr;
  bch_plan plan = BCH_PLAN_INIT;
  plan.depths = depths, plan.depth_count = 2;
  expect_invalid(bch_shape_set_builder_create(&plan, &none), "depth 0 does not ascend");
  plan = BCH_PLAN_INIT;
  plan.threshold = -1;
  expect_invalid(bch_shape_set_builder_create(&plan, &none), "plan->threshold");
  EXPECT_EQ(none, nullptr);
  const auto builder = made<bch_shape_set_builder_free>(bch_shape_set_builder_create, nullptr);
  const bch_vec2 corners[] = {{0, 0}, {1, 0}, {1, 1}};
  const std::uint64_t whole[] = {0, 3}, wrong[] = {3, 0}, second[] = {1, 4};
  const auto add = [&](const bch_vec2* points, const std::uint64_t* offsets, std::size_t polygons) {
    return bch_shape_set_builder_add_polygons(builder.get(), points, offsets, polygons, nullptr);
  };
  expect_invalid(add(corners, wrong, 1), "offsets[1]");
  expect_invalid(add(corners, whole, 0), "");
  expect_invalid(add(nullptr, second, 1), "corners is NULL");
  expect_invalid(add(corners, whole, SIZE_MAX), "offsets has");
  expect_invalid(bch_shape_set_builder_add_cylinder(builder.get(), -1, nullptr), "-1");

  const auto man = made<bch_character_free>(bch_character_default, BCH_MALE);
  bch_character* other = nullptr;
  expect_invalid(bch_character_default(7, &other), "which is 7");
  const char* name = nullptr;
  expect_error(bch_character_get_clip(man.get(), 1'000, &name, nullptr), BCH_OUT_OF_RANGE, "clip is 1000 of");
  const bch_pose poses[] = {{0, 0}, {1'000, 0}}, rest[] = {{BCH_REST_POSE, 0}, {BCH_REST_POSE, 0}};
  expect_error(bch_shape_set_builder_add_poses(builder.get(), man.get(), poses, 2, nullptr), BCH_OUT_OF_RANGE,
               "poses[1].clip is 1000");
  const auto dynamic = made<bch_dynamic_shape_set_free>(bch_dynamic_shape_set_create, set.get());
  const std::uint32_t twice[] = {0, 0};
  expect_invalid(
      bch_dynamic_shape_set_replace_poses(dynamic.get(), man.get(), twice, rest, 2, 0.01f, nullptr),
      "shapes[1] is 0, as one before");
  const auto shaper = made<bch_pose_shaper_free>(bch_pose_shaper_create, man.get(), nullptr);
  expect_invalid(bch_dynamic_shape_set_replace(dynamic.get(), 0, shaper.get()), "shaper has made no shape");

  bch_vec2 point{8, 9};
  std::uint64_t offset = 7;
  bch_outline outline = BCH_OUTLINE_INIT;
  outline.points = &point, outline.point_capacity = 1, outline.offsets = &offset, outline.offset_capacity = 1;
  expect_invalid(bch_pose_shaper_get_outline(shaper.get(), &outline), "shaper has made no shape");
  expect_error(bch_shape_set_get_outline(set.get(), 50, &outline), BCH_OUT_OF_RANGE, "50");
  EXPECT_EQ(point.x, 8);
  EXPECT_EQ(offset, 7u);
  EXPECT_EQ(outline.offset_count, 0u);
}

TEST_F(CApiMisuse, Obstacles) {
  const double x[] = {0, 1, 1}, y[] = {0, 0, 1}, up = 2, down = 1;
  const std::uint64_t whole[] = {0, 3};
  bch_obstacle_arrays arrays = BCH_OBSTACLE_ARRAYS_INIT;
  arrays.x = x, arrays.y = y, arrays.path_offsets = whole, arrays.path_count = SIZE_MAX;
  bch_obstacles* none = nullptr;
  expect_invalid(bch_obstacles_create(&arrays, &none), "arrays->path_offsets has");
  arrays.path_count = 1, arrays.obstacle_offsets = whole, arrays.obstacle_count = SIZE_MAX;
  expect_invalid(bch_obstacles_create(&arrays, &none), "arrays->obstacle_offsets has");
  arrays.obstacle_offsets = nullptr, arrays.bottom = &up, arrays.top = &down;
  const char* const word = "obstacles: obstacle 0: heights from 2 to 1 m";
  expect_invalid(bch_obstacles_create(&arrays, &none), word);
  expect_invalid(bch_obstacles_from_wkt("LINESTRING(0 0, 1 1)", 0, up, down, &none), word);
  EXPECT_EQ(none, nullptr);
  arrays.top = nullptr;
  const auto obstacles = made<bch_obstacles_free>(bch_obstacles_create, &arrays);
  std::uint32_t owner = 9;
  expect_error(bch_obstacles_get_owner(obstacles.get(), 77, &owner), BCH_OUT_OF_RANGE, "segment is 77 of 2");
  EXPECT_EQ(owner, 9u);
}

TEST_F(CApiMisuse, TheLastErrorStays) {
  expect_invalid(bch_collide(nullptr, &agents, &pair, 1, nullptr, &hit), "set is NULL");
  expect_ok(ask());
  EXPECT_STREQ(bch_last_error(), "set is NULL");
  std::thread([] { EXPECT_STREQ(bch_last_error(), ""); }).join();
}

}  // namespace
}  // namespace bch
