// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/bch_files.h>

#include "tests/support/c_api.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/test.hpp"

// What the C interface reads from files: characters and recordings. Their objects and errors are those of the library of queries.

namespace bch {
namespace {

using test::expect_ok;
using test::made;

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
  options.max_triangles = 1;
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

TEST_F(CApiRecordings, AreNotTheirOwnTruth) {
  const auto trajectory = opened();
  bch_check_options options = BCH_CHECK_OPTIONS_INIT;
  options.truth = trajectory.get();
  bch_check* none = nullptr;
  EXPECT_EQ(bch_check_run(trajectory.get(), &options, &none), BCH_INVALID_ARGUMENT);
  EXPECT_STREQ(bch_last_error(), "options->truth is trajectory; open its file once more");
  EXPECT_EQ(none, nullptr);
  options.truth = nullptr;
  made<bch_check_free>(bch_check_run, trajectory.get(), &options);  // it was not read from
}

/// All tables of a check, as bytes.
std::string tables_of(const bch_check* check) {
  const bch_check_frame* frames = nullptr;
  const bch_check_pair* pairs = nullptr;
  const bch_check_event* events = nullptr;
  std::size_t frame_count = 0, pair_count = 0, event_count = 0;
  expect_ok(bch_check_get_frames(check, &frames, &frame_count));
  expect_ok(bch_check_get_pairs(check, &pairs, &pair_count));
  expect_ok(bch_check_get_events(check, &events, &event_count));
  EXPECT_GT(std::min({frame_count, pair_count, event_count}), 0u);
  return std::string(reinterpret_cast<const char*>(frames), frame_count * sizeof(*frames)) +
         std::string(reinterpret_cast<const char*>(pairs), pair_count * sizeof(*pairs)) +
         std::string(reinterpret_cast<const char*>(events), event_count * sizeof(*events));
}

TEST_F(CApiRecordings, InMemoryAreThoseOfTheSameFile) {
  struct Person {
    std::int32_t frame, id;
    double x, y;
  };
  std::vector<Person> people;
  std::istringstream lines(rows());
  std::string line;
  std::getline(lines, line);
  for (Person one{}; std::getline(lines, line); people.push_back(one))
    ASSERT_EQ(std::sscanf(line.c_str(), "%d,%d,%lf,%lf", &one.frame, &one.id, &one.x, &one.y), 4);
  bch_column columns[] = {{"frame", &people[0].frame, sizeof(Person), BCH_COLUMN_INT32, 0},
                          {"ID", &people[0].id, sizeof(Person), BCH_COLUMN_INT32, 0},
                          {"x/m", &people[0].x, sizeof(Person), BCH_COLUMN_DOUBLE, 0},
                          {"y/m", &people[0].y, sizeof(Person), BCH_COLUMN_DOUBLE, 0},
                          {"point", nullptr, 0, BCH_COLUMN_TEXT, 0}};
  bch_trajectory_options options = BCH_TRAJECTORY_OPTIONS_INIT;
  options.fps = 10;
  const auto in_memory = made<bch_trajectory_free>(bch_trajectory_from_columns, columns, std::size_t{5},
                                                   people.size(), &options);
  bch_check_options how = BCH_CHECK_OPTIONS_INIT;
  how.max_distance = 0.5;
  const auto check = made<bch_check_free>(bch_check_run, in_memory.get(), &how);
  EXPECT_EQ(tables_of(check.get()), tables_of(checked(how).get()));

  bch_trajectory_info info = BCH_TRAJECTORY_INFO_INIT;
  expect_ok(bch_trajectory_get_info(in_memory.get(), &info));
  EXPECT_STREQ(info.notes, "Column 'point' is ignored.\n");
  const char* notes = nullptr;
  expect_ok(bch_check_get_notes(check.get(), &notes));
  EXPECT_STREQ(notes, info.notes);
  EXPECT_EQ(bch_check_get_notes(check.get(), nullptr), BCH_INVALID_ARGUMENT);

  bch_trajectory* none = nullptr;
  const auto expect_said = [&](bch_status status, const std::string& words) {
    EXPECT_EQ(status, BCH_INVALID_ARGUMENT);
    EXPECT_TRUE(test::has(bch_last_error(), words)) << bch_last_error();
  };
  const auto open = [&] { return bch_trajectory_from_columns(columns, 5, people.size(), &options, &none); };
  people[3].x = HUGE_VAL;
  expect_said(open(), "recording: row 3: x inf is not finite");
  people[3].x = 300;
  const auto jumping = made<bch_trajectory_free>(bch_trajectory_from_columns, columns, std::size_t{5},
                                                 people.size(), &options);
  bch_check* no_check = nullptr;
  expect_said(bch_check_run(jumping.get(), &how, &no_check), "recording: row 3: person 5 jumps by ");
  columns[0].type = 5;
  expect_said(open(), "columns->type is 5");
  columns[0].name = nullptr;
  expect_said(open(), "columns->name is NULL");
  expect_said(bch_trajectory_from_columns(nullptr, 1, 1, &options, &none), "columns is NULL");
  options.progress = [](void*, std::uint64_t, std::uint64_t) { return 1; };
  columns[0].type = BCH_COLUMN_INT32, columns[0].name = "frame";
  EXPECT_EQ(open(), BCH_CANCELLED);
  EXPECT_EQ(none, nullptr);
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
  const bch_check_density* densities = nullptr;
  std::size_t density_count = 0;
  expect_ok(bch_check_get_densities(check.get(), &densities, &density_count));
  ASSERT_EQ(density_count, 6u);
  EXPECT_EQ(densities[1].from, 1);
  std::uint64_t person_frames = 0;
  for (const bch_check_density& each : std::span(densities, density_count))
    person_frames += each.person_frames;
  EXPECT_EQ(person_frames, summary.person_frames);
  const char* assumptions = nullptr;
  expect_ok(bch_check_get_assumptions(check.get(), &assumptions));
  EXPECT_NE(std::string(assumptions), "");

  options.measures = 1;
  const auto with_measures = checked(options);
  const bch_check_measure* measures = nullptr;
  const bch_check_conflict* conflicts = nullptr;
  std::size_t measure_count = 0, conflict_count = 0;
  expect_ok(bch_check_get_measures(with_measures.get(), &measures, &measure_count));
  expect_ok(bch_check_get_conflicts(with_measures.get(), &conflicts, &conflict_count));
  ASSERT_EQ(measure_count, 20u);
  EXPECT_EQ(measures[11].frame, 5);
  EXPECT_EQ(measures[11].id, 7);
  EXPECT_EQ(measures[11].personal, 1u);
  EXPECT_FLOAT_EQ(measures[11].disc_clearance, -0.1f);
  EXPECT_LT(measures[11].clearance, 0);
  EXPECT_EQ(measures[11].collides, 1);
  EXPECT_NEAR(measures[0].disc_avoidance, 3 / measures[0].disc_ttc, 1e-5f);
  ASSERT_GT(conflict_count, 5u);
  EXPECT_EQ(conflicts[0].frame, 0);
  EXPECT_EQ(conflicts[0].second, 7);
  EXPECT_EQ(conflicts[0].disc_ttc, measures[0].disc_ttc);
  expect_ok(bch_check_get_summary(with_measures.get(), &summary));
  EXPECT_EQ(summary.colliding_people, 2u);
  EXPECT_EQ(summary.disc_colliding_people, 2u);
  expect_ok(bch_check_get_measures(check.get(), &measures, &measure_count));
  EXPECT_EQ(measure_count, 0u);
  options.measures = 0;

  const bch_page shown{"<of the test>", "yesterday", nullptr};
  options.page = &shown;
  const char* html = nullptr;
  std::size_t html_size = 0;
  const auto with_page = checked(options);
  expect_ok(bch_check_get_page(with_page.get(), &html, &html_size));
  const std::string page(html, html_size);
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>\n")) << html_size;
  EXPECT_NE(page.find("<title>&lt;of the test&gt;</title>"), std::string::npos);
  EXPECT_NE(page.find("[\"date\",\"yesterday\"]"), std::string::npos);
  EXPECT_EQ(page.find("[\"options\""), std::string::npos);
  expect_ok(bch_check_get_page(check.get(), &html, &html_size));
  EXPECT_EQ(html_size, 0u);
  options.page = nullptr;

  // Objects of the library of queries.
  const auto walls =
      made<bch_obstacles_free>(bch_obstacles_from_wkt, "LINESTRING(-9 0, 9 0)", 0, -HUGE_VAL, HUGE_VAL);
  options.walls = walls.get();
  expect_ok(bch_check_get_summary(checked(options).get(), &summary));
  EXPECT_GT(summary.in_walls, 0u);
  options.without_walls = 1;
  const auto man = test::c_person(BCH_MALE);
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

TEST_F(CApiRecordings, HaveBodiesOfAnyKind) {
  const double frame[] = {0, 0, 0}, id[] = {1, 2, 3}, x[] = {0, 1.5, 9}, zero[] = {0, 0, 0},
               length[] = {0, 1, 2};
  const char* const body[] = {"cart", "box", nullptr};
  const bch_column columns[] = {
      {"frame", frame, 0, BCH_COLUMN_DOUBLE, 0},  {"id", id, 0, BCH_COLUMN_DOUBLE, 0},
      {"x/m", x, 0, BCH_COLUMN_DOUBLE, 0},        {"y/m", zero, 0, BCH_COLUMN_DOUBLE, 0},
      {"heading", zero, 0, BCH_COLUMN_DOUBLE, 0}, {"length", length, 0, BCH_COLUMN_DOUBLE, 0},
      {"body", body, 0, BCH_COLUMN_TEXT, 0}};
  bch_trajectory_options options = BCH_TRAJECTORY_OPTIONS_INIT;
  options.fps = 1;
  const auto open = [&] {
    return made<bch_trajectory_free>(bch_trajectory_from_columns, columns, std::size_t{7}, std::size_t{3},
                                     &options);
  };
  const auto trajectory = open();
  const bch_named_body* bodies = nullptr;
  std::size_t count = 0;
  expect_ok(bch_trajectory_get_bodies(trajectory.get(), &bodies, &count));
  ASSERT_EQ(count, 3u);
  EXPECT_STREQ(bodies[0].kind, "cart");
  EXPECT_EQ(bodies[0].length, 0);
  EXPECT_STREQ(bodies[2].kind, "box");
  EXPECT_EQ(bodies[2].length, 2);
  EXPECT_EQ(bch_trajectory_get_bodies(trajectory.get(), nullptr, &count), BCH_INVALID_ARGUMENT);

  bch_footprint cart = {"cart", "POLYGON((0 -0.2, 1.01 -0.2, 1.01 0.2, 0 0.2))"};
  bch_check_options how = BCH_CHECK_OPTIONS_INIT;
  how.footprints = &cart, how.footprint_count = 1;
  const auto check = made<bch_check_free>(bch_check_run, trajectory.get(), &how);
  bch_check_summary summary = BCH_CHECK_SUMMARY_INIT;
  expect_ok(bch_check_get_summary(check.get(), &summary));
  EXPECT_EQ(summary.overlapping, 2u);  // the cart reaches 1 cm into the box
  EXPECT_EQ(summary.overlap_events, 1u);
  EXPECT_EQ(summary.wall_events, 0u);

  bch_check* none = nullptr;
  const auto again = open();
  cart.wkt = "LINESTRING(0 0, 1 1)";
  EXPECT_EQ(bch_check_run(again.get(), &how, &none), BCH_INVALID_ARGUMENT);
  EXPECT_STREQ(bch_last_error(), "options->footprints: cart: expected polygons, found a line");
  how.footprint_count = 0;
  EXPECT_EQ(bch_check_run(again.get(), &how, &none), BCH_INVALID_ARGUMENT);
  EXPECT_TRUE(std::string(bch_last_error()).find("body 'cart' is none of disc, box") != std::string::npos);
}

TEST_F(CApiRecordings, ChecksNameWhatIsWrong) {
  bch_check_options options;
  const auto expect_said = [&](bch_status expected, const std::string& words, auto change) {
    options = BCH_CHECK_OPTIONS_INIT;
    change();
    const auto trajectory = opened();
    bch_check* none = nullptr;
    EXPECT_EQ(bch_check_run(trajectory.get(), &options, &none), expected);
    EXPECT_EQ(none, nullptr);
    EXPECT_TRUE(test::has(bch_last_error(), words));
  };
  bch_obstacles* freed = nullptr;
  expect_ok(bch_obstacles_from_wkt("LINESTRING(0 0, 1 1)", 0, -HUGE_VAL, HUGE_VAL, &freed));
  expect_ok(bch_obstacles_free(freed));
  expect_said(BCH_INVALID_ARGUMENT, "options->max_distance is 11.000000", [&] { options.max_distance = 11; });
  expect_said(BCH_INVALID_ARGUMENT, "options->walls is not a live bch_obstacles; was it freed?",
              [&] { options.walls = freed; });
  expect_said(BCH_INVALID_ARGUMENT, "64, 128, 256 or 512 spheres, found 65", [&] { options.spheres = 65; });
  expect_said(BCH_INVALID_ARGUMENT,
              "options->depth and options->leaves belong to outlines, not to options->spheres",
              [&] { options.spheres = 65, options.leaves = BCH_DISCS; });
  expect_said(BCH_TOO_LARGE, "pairs of people", [&] { options.max_pairs = 1; });
  expect_said(BCH_CANCELLED, "cancelled by the caller",
              [&] { options.progress = [](void*, std::uint64_t, std::uint64_t) { return 1; }; });
  EXPECT_EQ(bch_check_free(reinterpret_cast<bch_check*>(freed)), BCH_INVALID_ARGUMENT);
  EXPECT_STREQ(bch_last_error(), "check is not a live bch_check; was it freed?");
}

}  // namespace
}  // namespace bch
