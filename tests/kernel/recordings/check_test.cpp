// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/check.hpp"

#include "tests/support/crowd_pairs.hpp"
#include "tests/support/made_up_recording.hpp"
#include "tests/support/on_threads.hpp"
#include "tests/support/test.hpp"

// Who runs into whom in recordings that are made up.

namespace bch::detail {
namespace {

using test::add_crowd;
using test::check_of;
using test::MadeUp;

TEST(Check, PeopleWhoWalkThroughEachOtherAreAnEvent) {
  MadeUp recording(25);
  recording.walk(7, -3, 0, 1.2, 0, 125);
  recording.walk(5, 3, 0.1, -1.2, 0, 125);
  recording.walk(9, 0, 8, 0, 0.5, 125);
  const CheckSummary summary = check_of(recording);
  ASSERT_GE(summary.events.size(), 1u);  // hands and feet may touch before
  std::uint32_t frames = 0;
  OverlapEvent event = summary.events[0];
  for (const OverlapEvent& each : summary.events) {
    frames += each.frames;
    if (each.depth > event.depth) event = each;
  }
  EXPECT_EQ(event.first, 5);
  EXPECT_EQ(event.second, 7);
  EXPECT_FALSE(event.is_wall);
  EXPECT_NEAR(event.worst, 62, 4);  // where they meet
  EXPECT_LT(event.from, event.worst_frame());
  EXPECT_GT(event.to, event.worst_frame());
  EXPECT_EQ(event.frames, event.to - event.from + 1);
  EXPECT_GT(event.depth, 0.2f);
  EXPECT_EQ(summary.people, 3u);
  EXPECT_EQ(summary.frames, 125u);
  EXPECT_EQ(summary.all.people, 375u);
  EXPECT_EQ(summary.all.overlapping, 2 * frames);
  EXPECT_EQ(summary.all.overlapping_pairs, frames);
  EXPECT_EQ(summary.all.discs[3], 2u * 16);  // centres nearer than 0.8 m
}

TEST(Check, NobodyPassesThroughAnybodyUnseen) {
  MadeUp recording(1);  // a frame a second: they are metres apart before and after
  recording.walk(1, 1e6 - 3, -2e6, 2, 0, 4);
  recording.walk(2, 1e6 + 3, -2e6, -2, 0, 4);
  recording.rewind();
  std::vector<CheckedPair> pairs;
  const CheckSummary summary = check(recording, {}, [&](const CheckedFrame& frame, const ShapeSet&) {
    pairs.insert(pairs.end(), frame.pairs.begin(), frame.pairs.end());
  });
  EXPECT_EQ(summary.passings, 1u);
  EXPECT_EQ(summary.all.overlapping, 0u);
  ASSERT_EQ(summary.events.size(), 1u);
  const OverlapEvent& event = summary.events[0];
  EXPECT_TRUE(event.is_pass());
  EXPECT_EQ(event.from, 1);
  EXPECT_EQ(event.to, 1);
  EXPECT_EQ(event.worst_frame(), 1);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_TRUE(pairs[0].passing);
  const double gap = static_cast<double>(pairs[0].gap);
  EXPECT_GT(gap, 0.8);  // of 2 m between the centres
  EXPECT_LT(gap, 2);
  EXPECT_GT(event.after(), (gap - 0.05) / 4);  // they come 4 m nearer a frame; discs touch a little earlier
  EXPECT_LT(event.after(), 0.5);
  EXPECT_NEAR(event.x, 1e6 - 1 + 2 * event.after(), 1e-5);  // where the first then is
  EXPECT_EQ(event.y, -2e6);
}

TEST(Check, APassBesideAnOverlapIsAnEventOfItsOwn) {
  MadeUp recording(1);
  const double way[] = {0.1, -2, 2, -2, 0.1, 0.1, 2};  // overlaps, passes and comes back twice, overlaps
  for (std::int64_t frame = 0; frame < std::ssize(way); ++frame) {
    recording.add(10 * frame, {1, 0, 0, 0, 1.75f});
    recording.add(10 * frame, {2, way[frame], 0, 0, 1.75f});
  }
  const CheckSummary summary = check_of(recording);
  EXPECT_EQ(summary.passings, 2u);
  std::ostringstream text;
  for (const OverlapEvent& event : summary.events)
    text << event.is_pass() << " " << event.from << " " << event.to << " " << event.frames << ", ";
  EXPECT_EQ(text.str(), "0 0 0 1, 1 10 10 1, 1 20 20 1, 0 40 50 2, ");
  EXPECT_GT(summary.events[1].after(), 2);  // of the 10 frames until the next
  EXPECT_LT(summary.events[1].after(), 5);
}

TEST(Check, GapsAreThoseOfWhatDecides) {
  MadeUp recording(10);
  add_crowd(recording, 60, static_cast<int>(test::samples(20)));
  CheckOptions options;
  options.max_distance = 0.3;
  for (const Leaves leaves : {Leaves::segments, Leaves::discs}) {
    options.leaves = leaves;
    recording.rewind();
    std::size_t near = 0;
    check(recording, options, [&](const CheckedFrame& frame, const ShapeSet& shapes) {
      std::vector<std::uint32_t> shape;
      std::vector<double> x, y, heading;
      std::map<std::int64_t, std::uint32_t> number;
      for (const CheckedPerson& person : frame.people) {
        number[person.walker.id] = static_cast<std::uint32_t>(shape.size());
        shape.push_back(person.shape);
        x.push_back(person.walker.x), y.push_back(person.walker.y), heading.push_back(person.walker.heading);
      }
      std::map<std::pair<std::uint32_t, std::uint32_t>, float> told;
      for (const CheckedPair& pair : frame.pairs)
        if (!pair.passing) told[{number[pair.first], number[pair.second]}] = pair.gap;
      const Agents agents{shape, x, y, heading};
      const std::vector<Pair> pairs = test::candidate_pairs(shapes, agents, options.max_distance);
      std::vector<float> gaps(pairs.size());
      std::vector<std::uint8_t> hits(pairs.size());
      collide(shapes, agents, pairs, hits, {.leaves = leaves});
      clearance(shapes, agents, pairs, {gaps}, {.leaves = leaves});
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto row = told.find({pairs[i].first, pairs[i].second});
        const bool is_near = static_cast<double>(gaps[i]) <= options.max_distance;
        ASSERT_EQ(row != told.end(), hits[i] != 0 || is_near) << gaps[i];
        if (row == told.end()) continue;
        ASSERT_EQ(row->second, hits[i] != 0 ? 0 : gaps[i]);
        near += hits[i] == 0;
      }
    });
    EXPECT_GT(near, 100u);
  }
}

TEST(Check, WallsAreMet) {
  MadeUp recording(25);
  recording.walk(4, -2, 0, 1, 0, 100);
  const ObstacleSet walls = obstacles_from_wkt("POLYGON((-9 -9, 0 -9, 0 9, -9 9))", Polygons::walkable);
  CheckOptions options;
  options.walls = &walls;
  const CheckSummary summary = check_of(recording, options);
  ASSERT_EQ(summary.events.size(), 1u);
  EXPECT_TRUE(summary.events[0].is_wall);
  EXPECT_EQ(summary.events[0].first, 4);
  EXPECT_NEAR(summary.events[0].worst, 50, 8);
  EXPECT_EQ(summary.all.in_walls, summary.events[0].frames);
}

/// All that is told of a recording, as text.
std::string text_of_all(MadeUp& recording, const CheckOptions& options) {
  std::ostringstream text;
  recording.rewind();
  const CheckSummary summary =
      check(recording, options, [&](const CheckedFrame& frame, const ShapeSet& shapes) {
        text << frame.frame << ":";
        for (const CheckedPerson& person : frame.people) {
          EXPECT_LT(person.shape, shapes.shape_count());
          text << " " << person.walker.id << "/" << person.density << "/" << person.overlaps;
        }
        for (const CheckedPair& pair : frame.pairs)
          text << " " << pair.first << "-" << pair.second << " " << pair.depth << " " << pair.gap << " "
               << pair.x << " " << pair.passing;
        text << "\n";
      });
  for (const OverlapEvent& event : summary.events)
    text << event.first << " " << event.from << " " << event.worst << "\n";
  text << summary.all.overlapping_pairs;
  return text.str();
}

TEST(Check, IsTheSameForAnyNumberOfThreadsAndFramesAtOnce) {
  MadeUp recording(10);
  add_crowd(recording, 60, static_cast<int>(test::samples(80)));
  CheckOptions options;
  options.max_distance = 0.3;
  const std::string expected = text_of_all(recording, options);
  EXPECT_GT(expected.size(), 10'000u);
  for (const std::size_t at_once : {std::size_t{1}, std::size_t{500}, std::size_t{1'000'000}})
    for (const unsigned threads : {1u, 2u}) {
      options.people_at_once = at_once;
      test::on_threads(threads, [&] {
        EXPECT_TRUE(text_of_all(recording, options) == expected) << at_once << " " << threads;
      });
    }
}

/// All of a summary, but the coordinates of events' places.
std::string text_of(const CheckSummary& summary) {
  std::ostringstream text;
  text << summary.frames << " " << summary.people << " " << summary.guessed << " " << summary.passings << " "
       << summary.first_frame << " " << summary.last_frame << "\n";
  for (const OverlapCount& count : summary.by_density)
    text << count.people << " " << count.overlapping << " " << count.near_pairs << " " << count.disc_pairs[2]
         << " " << count.overlapping_pairs << "\n";
  text << summary.all.people << " " << summary.all.overlapping_pairs << "\n";
  for (const OverlapEvent& event : summary.events)
    text << event.first << " " << event.second << " " << event.is_wall << " " << event.from << " " << event.to
         << " " << event.worst << " " << event.frames << " " << event.depth << " " << event.x << "\n";
  for (const std::uint64_t pose : summary.poses) text << pose << " ";
  return text.str();
}

/// Blocks of few people end amid events, whatever their number.
TEST(Check, BlocksChangeNoAnswer) {
  MadeUp recording(10);
  const int frames = static_cast<int>(test::samples(80));
  add_crowd(recording, 60, frames);
  recording.walk(1000, 4, 4, 0, 0, 3 * frames);  // people for whom events span all blocks, and frames go on
  recording.walk(1001, 4.1, 4, 0, 0, 3 * frames);
  const ObstacleSet walls = obstacles_from_wkt("POLYGON((0 0, 8 0, 8 8, 0 8))", Polygons::walkable);
  CheckOptions options;
  options.walls = &walls;
  const std::string expected = text_of(check_of(recording, options));
  for (const std::uint32_t people : {1u, 70u, 400u}) {
    options.people_at_once = people;
    EXPECT_EQ(text_of(check_of(recording, options)), expected) << people;
  }
}

/// A deeper cut never adds an overlap, and segments add none to discs. (Discs of 2 cm at the leaves.)
TEST(Check, SaysWhereNobodyMovesSo) {
  const auto notes_of = [](double speed, double jump = 0, const ObstacleSet* walls = nullptr) {
    MadeUp recording(10);
    recording.walk(3, 0, 5, speed / 2, 0, 20);
    recording.walk(8, 0, 0, 3 * speed / 2, 0, 20);
    recording.add(20, {8, 3 * speed + jump, 0, test::unknown, 1.75F});
    std::string all;
    for (const std::string& note : check_of(recording, {.walls = walls}).notes) all += note + "\n";
    return all;
  };
  EXPECT_EQ(notes_of(1.3), "");
  EXPECT_EQ(notes_of(0), "");
  EXPECT_EQ(notes_of(0.04), "");
  EXPECT_EQ(notes_of(11.5), "");
  EXPECT_EQ(notes_of(1.3, 9), "");
  EXPECT_TRUE(test::has(notes_of(1.3, 20), "Person 8 moves at 202 m/s to frame 20, "));
  EXPECT_TRUE(test::has(notes_of(1.3, 20), ", the fastest of all: is that position right?\n"));
  EXPECT_TRUE(test::has(notes_of(130), "People move at 13"));
  EXPECT_TRUE(
      test::has(notes_of(130), "is the unit of length smaller than metres, or the frame rate lower?\n"));
  EXPECT_TRUE(test::has(notes_of(0.02), " m/s on average: do they stand, or is the frame rate higher?\n"));
  const ObstacleSet nothing = obstacles_from_wkt("GEOMETRYCOLLECTION EMPTY", Polygons::walkable);
  EXPECT_EQ(notes_of(1.3, 0, &nothing), "The walls have no segment.\n");
}

/// Who goes through the border of the floor does not collide with it; who stays in it does, and in a wall on the floor, too.
TEST(Check, PeopleLeaveThroughTheBorder) {
  const ObstacleSet floor = obstacles_from_wkt(
      "POLYGON((0 0, 8 0, 8 8, 0 8), (1 1, 2 1, 2 2, 1 2), (6 7, 7 7, 7 7.9, 6 7.9))", Polygons::walkable);
  const auto walls_of = [&](double x, double y, double speed_y, int frames) {
    MadeUp recording(10);
    recording.walk(1, 6.5, 4, 0.1, 0, 60);
    recording.walk(2, x, y, 0, speed_y, frames);
    const CheckSummary summary = check_of(recording, {.walls = &floor});
    EXPECT_EQ(summary.wall_events, summary.events.size());
    return std::pair(summary.all.in_walls, summary.wall_events);
  };
  using Counts = std::pair<std::uint64_t, std::uint64_t>;
  EXPECT_EQ(walls_of(4, 7, 1.2, 7), Counts(0, 0));   // he is last seen 0.28 m from it
  EXPECT_EQ(walls_of(4, 7.8, -1.2, 60).second, 1u);  // he is there from the beginning on
  EXPECT_GT(walls_of(4, 7.8, 0.01, 60).first, 20u);  // he stays
  EXPECT_GT(walls_of(1.5, 3, -1.2, 9).first, 0u);    // into a wall on the floor
}

TEST(Check, SummariesCountTheirEvents) {
  MadeUp recording(10);
  add_crowd(recording, 60, static_cast<int>(test::samples(40)));
  const ObstacleSet walls = obstacles_from_wkt("POLYGON((0 0, 8 0, 8 8, 0 8))", Polygons::walkable);
  const CheckSummary summary = check_of(recording, {.walls = &walls});
  std::uint64_t overlaps = 0, passes = 0, in_walls = 0;
  for (const OverlapEvent& event : summary.events)
    ++(event.is_wall ? in_walls : event.is_pass() ? passes : overlaps);
  EXPECT_GT(std::min(overlaps, in_walls), 0u);
  EXPECT_EQ(summary.overlap_events, overlaps);
  EXPECT_EQ(summary.passings, passes);
  EXPECT_EQ(summary.wall_events, in_walls);
}

TEST(Check, IsAskedAtADepth) {
  MadeUp recording(10);
  add_crowd(recording, 60, static_cast<int>(test::samples(40)));
  CheckOptions options;
  options.leaves = Leaves::discs;
  std::uint64_t before = std::numeric_limits<std::uint64_t>::max();
  for (const std::uint32_t depth : {0u, 3u, 6u, all_depths}) {
    options.plan.depths = {depth};
    const std::uint64_t pairs = check_of(recording, options).all.overlapping_pairs;
    EXPECT_LT(pairs, before) << depth;
    before = pairs;
  }
  options.leaves = Leaves::segments;
  EXPECT_LT(check_of(recording, options).all.overlapping_pairs, before);
}

}  // namespace
}  // namespace bch::detail
