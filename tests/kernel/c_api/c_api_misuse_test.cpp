// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/c_api.hpp"
#include "tests/support/c_api_queries.hpp"
#include "tests/support/test.hpp"

// What callers get wrong is a status and a line, and nothing is written.

namespace bch {
namespace {

using test::bytes;
using test::expect_ok;
using test::made;

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

  bch_status run_query() { return bch_collide(set.get(), &agents, &pair, 1, &options, &hit); }

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
  expect_invalid(run_query(), "agents->heading is NULL");
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
                 "crowd is not a live bch_crowd");
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
  expect_invalid(bch_collide(lent, &agents, &pair, 1, nullptr, &hit), "not a live bch_shape_set");
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
  expect_invalid(bch_collide(set.get(), &agents, &pair, 1, &future.known, &hit),
                 "options->size is " + std::to_string(sizeof future) +
                     "; expected 0 in members that this version does not know");

  // Of the past: what it does not have yet is as if it had been left alone.
  options.leaves = 99;
  options.size = offsetof(bch_query_options, leaves);
  expect_ok(run_query());
  hit = 77;
  options.size = sizeof options;
  expect_invalid(run_query(), "options->leaves is 99");
  for (const std::uint32_t size : {0u, 3u, 5000u}) {
    options.size = size;
    expect_invalid(run_query(), "options->size is " + std::to_string(size));
  }

  // No version ends inside a member.
  options = BCH_QUERY_OPTIONS_INIT;
  static_assert(offsetof(bch_query_options, threads) == 16);  // no member has bytes 20 to 24
  static_assert(offsetof(bch_query_options, max_distance) == 24 && sizeof options == 40);
  for (std::uint32_t size = 4; size <= sizeof options; ++size) {
    options.size = size;
    if ((size % 4 == 0 || size / 4 == 5) && size != 28 && size != 36) {
      expect_ok(run_query());
      hit = 77;
    } else {
      expect_invalid(run_query(),
                     "options->size is " + std::to_string(size) + "; expected the end of a member");
    }
  }
  bch_clearance_out cut = BCH_CLEARANCE_OUT_INIT;
  cut.size = offsetof(bch_clearance_out, points) + 4;
  expect_invalid(bch_clearance(set.get(), &agents, &pair, 1, nullptr, &cut), "expected the end of a member");

  bch_shape_set_info info = BCH_SHAPE_SET_INFO_INIT;
  info.size = offsetof(bch_shape_set_info, bytes) + 4;
  expect_invalid(bch_shape_set_get_info(set.get(), &info), "expected the end of a member");
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
  expect_invalid(run_query(), "agent 1");
  crowd.x[1] = 0;
  crowd.shape[0] = 50;
  expect_invalid(run_query(), "50");
  expect_invalid(bch_validate_agents(set.get(), &agents), "50");
  crowd.shape[0] = 0;
  const bch_pair beyond{0, 2};
  expect_invalid(bch_collide(set.get(), &agents, &beyond, 1, nullptr, &hit), "pair 0");
  options.threads = 100'000;
  expect_invalid(run_query(), "threads is 100000");
  options.threads = 0, options.implementation = "mmx";
  expect_invalid(run_query(), "mmx");
  options.implementation = nullptr, options.leaves = 2;
  expect_invalid(run_query(), "options->leaves is 2");
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
  expect_error(bch_shape_set_load_bytes("bch", 3, "people", &none), BCH_BAD_FILE, "people");
  expect_error(bch_shape_set_load_bytes(nullptr, 1, "people", &none), BCH_INVALID_ARGUMENT, "bytes is NULL");
  expect_error(bch_shape_set_save(set.get(), "/nowhere/a.bch"), BCH_BAD_FILE, "/nowhere/a.bch");
  EXPECT_EQ(none, nullptr);
}

TEST_F(CApiMisuse, PlansAndBodies) {
  const std::uint32_t depths[] = {3, 0};
  bch_shape_set_builder* none = nullptr;
  bch_plan plan = BCH_PLAN_INIT;
  plan.depths = depths, plan.depth_count = 2;
  expect_invalid(bch_shape_set_builder_create(&plan, &none), "expected ascending depths, found 0 after 3");
  plan = BCH_PLAN_INIT;
  plan.threshold = -1;
  expect_invalid(bch_shape_set_builder_create(&plan, &none), "plan->threshold");
  EXPECT_EQ(none, nullptr);
  const auto builder = test::c_builder();
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

  const auto man = test::c_person(BCH_MALE);
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
  const auto shape_builder = made<bch_shape_builder_free>(bch_shape_builder_create, man.get(), nullptr);
  expect_invalid(bch_dynamic_shape_set_replace(dynamic.get(), 0, shape_builder.get()),
                 "shape_builder has made no shape");

  bch_vec2 point{8, 9};
  std::uint64_t offset = 7;
  bch_outline outline = BCH_OUTLINE_INIT;
  outline.points = &point, outline.point_capacity = 1, outline.offsets = &offset, outline.offset_capacity = 1;
  expect_invalid(bch_shape_builder_get_outline(shape_builder.get(), &outline),
                 "shape_builder has made no shape");
  expect_error(bch_shape_set_get_outline(set.get(), 50, &outline), BCH_OUT_OF_RANGE, "50");
  EXPECT_EQ(point.x, 8);
  EXPECT_EQ(offset, 7u);
  EXPECT_EQ(outline.offset_count, 0u);
}

TEST_F(CApiMisuse, Obstacles) {
  const double x[] = {0, 1, 1}, y[] = {0, 0, 1}, up = 2, down = 1;
  const std::uint64_t whole[] = {0, 3};
  bch_obstacle_arrays arrays = BCH_OBSTACLE_ARRAYS_INIT;
  arrays.x = x, arrays.y = y, arrays.polyline_offsets = whole, arrays.polyline_count = SIZE_MAX;
  bch_obstacles* none = nullptr;
  expect_invalid(bch_obstacles_create(&arrays, &none), "arrays->polyline_offsets has");
  arrays.polyline_count = 1, arrays.obstacle_offsets = whole, arrays.obstacle_count = SIZE_MAX;
  expect_invalid(bch_obstacles_create(&arrays, &none), "arrays->obstacle_offsets has");
  arrays.obstacle_offsets = nullptr, arrays.bottom = &up, arrays.top = &down;
  const char* const word = "obstacles: obstacle 0: expected a bottom below the top, found 2 to 1 m";
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
  expect_ok(run_query());
  EXPECT_STREQ(bch_last_error(), "set is NULL");
  std::thread([] { EXPECT_STREQ(bch_last_error(), ""); }).join();
}

}  // namespace
}  // namespace bch
