// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/check/check.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <map>
#include <numbers>
#include <sstream>
#include <vector>

#include <bch/default_characters.hpp>
#include <bch/pose_shape.hpp>

#include "kernel/check/baked_cast.hpp"
#include "tests/support/scenes.hpp"

// Recordings that are made up, of which it is known who runs into whom.

namespace bch::detail {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// A recording in memory.
class MadeUp : public TrajectoryReader {
 public:
  explicit MadeUp(double fps) { info_.fps = fps; }

  void add(std::int64_t frame, TrackedPerson person) { frames_[frame].push_back(person); }
  /// Somebody who walks straight on from frame 0 for so many frames.
  void walk(std::int64_t id, double x, double y, double speed_x, double speed_y, int frames) {
    for (int k = 0; k < frames; ++k)
      add(k, {id, x + speed_x * k / info_.fps, y + speed_y * k / info_.fps, unknown, 1.75f});
  }
  void rewind() { next_ = frames_.begin(); }

  const TrajectoryInfo& info() const override { return info_; }
  bool next(std::int64_t& frame, std::vector<TrackedPerson>& people) override {
    if (next_ == frames_.end()) return false;
    frame = next_->first, people = next_->second;
    std::ranges::sort(people, {}, &TrackedPerson::id);
    ++next_;
    return true;
  }
  std::string place_of(std::uint64_t row) const override { return "made up: row " + std::to_string(row); }

 private:
  TrajectoryInfo info_;
  std::map<std::int64_t, std::vector<TrackedPerson>> frames_;
  std::map<std::int64_t, std::vector<TrackedPerson>>::iterator next_;
};

std::vector<WalkerFrame> walkers_of(MadeUp& recording) {
  recording.rewind();
  WalkerReader reader(recording);
  std::vector<WalkerFrame> all;
  for (WalkerFrame frame; reader.next(frame);) all.push_back(frame);
  return all;
}

TEST(Walkers, HaveTheirSpeedAndDirection) {
  MadeUp recording(25);
  recording.walk(3, 0, 0, 0.6, 0.8, 100);
  const auto frames = walkers_of(recording);
  ASSERT_EQ(frames.size(), 100u);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Walker& walker = frames[k].people.at(0);
    EXPECT_EQ(frames[k].frame, static_cast<std::int64_t>(k));
    EXPECT_NEAR(walker.speed, 1, 1e-9);
    EXPECT_NEAR(walker.heading, std::atan2(0.8, 0.6), 1e-9);
    EXPECT_FALSE(walker.is_guessed);
    EXPECT_FLOAT_EQ(static_cast<float>(walker.stature), 1.75f);
    if (k == 0) continue;
    const double step = walker.phase - frames[k - 1].people[0].phase;
    EXPECT_NEAR(step - std::floor(step), pedestrian_strides_per_second(1) / 25, 1e-9);
  }
}

TEST(Walkers, KeepTheirHeadingWhileTheyStand) {
  MadeUp recording(25);
  recording.walk(1, 0, 0, 0, 1, 50);
  for (int k = 50; k < 100; ++k) recording.add(k, {1, 0, 1.96, unknown, unknown});
  recording.walk(2, 5, 5, 0, 0, 100);  // never moves
  std::size_t guessed = 0;
  for (const WalkerFrame& frame : walkers_of(recording)) {
    EXPECT_NEAR(frame.people[0].heading, std::numbers::pi / 2, 1e-9) << frame.frame;
    EXPECT_NEAR(frame.people[1].heading, frame.frame < 50 ? std::numbers::pi / 2 : frame.people[1].heading,
                1e-9);
    EXPECT_TRUE(frame.people[1].is_guessed);
    guessed += frame.people[0].is_guessed;
  }
  EXPECT_NEAR(static_cast<double>(guessed), 42, 3);  // from when half of the smoothing says that he stands
}

/// As recordings of simulators are that write a frame a second.
TEST(Walkers, OfFewFramesHaveASpeedToo) {
  MadeUp recording(40);
  for (int k = 0; k < 10; ++k) recording.add(40 * k, {1, 1.2 * k, 0, unknown, unknown});
  for (const WalkerFrame& frame : walkers_of(recording)) {
    EXPECT_NEAR(frame.people[0].speed, 1.2, 1e-9) << frame.frame;
    EXPECT_FALSE(frame.people[0].is_guessed);
  }
}

TEST(Walkers, DoNotJumpAHundredMetres) {
  MadeUp recording(10);
  recording.add(0, {4, 0, 0, unknown, unknown});
  recording.add(100, {4, 99, 0, unknown, unknown});
  EXPECT_EQ(walkers_of(recording).size(), 2u);
  recording.add(110, {4, 300, 0, unknown, unknown, TrackedPerson::no_motion, unknown, 7});
  try {
    walkers_of(recording);
    ADD_FAILURE();
  } catch (const TrajectoryError& error) {
    EXPECT_STREQ(
        error.what(),
        "made up: row 7: person 4 jumps by 201 m, from (99, 0) in frame 100 to (300, 0) in frame 110");
  }
}

TEST(Walkers, TakeHeadingsOfTheFile) {
  MadeUp recording(10);
  for (int k = 0; k < 20; ++k) recording.add(k, {1, 0.1 * k, 0, 1.5f, 1.6f});
  for (const WalkerFrame& frame : walkers_of(recording)) {
    EXPECT_FLOAT_EQ(static_cast<float>(frame.people[0].heading), 1.5f);
    EXPECT_FALSE(frame.people[0].is_guessed);
  }
}

TEST(Walkers, WithoutAStatureHaveOneByTheirIds) {
  double women = 0, men = 0;
  std::size_t count = 0;
  for (std::int64_t id = 0; id < 4'000; ++id) {
    const double stature = stature_by_id(id, is_female_by_id(id));
    EXPECT_GT(stature, 1.3);
    EXPECT_LT(stature, 2.2);
    (is_female_by_id(id) ? women : men) += stature;
    count += is_female_by_id(id);
  }
  EXPECT_NEAR(static_cast<double>(count), 2'000, 150);
  EXPECT_NEAR(women / static_cast<double>(count), 1.66, 0.01);
  EXPECT_NEAR(men / (4'000 - static_cast<double>(count)), 1.79, 0.01);
}

CheckSummary check_of(MadeUp& recording, const CheckOptions& options = {}) {
  recording.rewind();
  return check(recording, options);
}

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
  EXPECT_NEAR(static_cast<double>(event.worst), 62, 4);  // where they meet
  EXPECT_LT(event.from, event.worst);
  EXPECT_GT(event.to, event.worst);
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
  recording.walk(1, -3, 0, 2, 0, 4);
  recording.walk(2, 3, 0, -2, 0, 4);
  const CheckSummary summary = check_of(recording);
  EXPECT_EQ(summary.passings, 1u);
  ASSERT_EQ(summary.events.size(), 1u);
  EXPECT_EQ(summary.events[0].from, 1);
  EXPECT_LT(summary.events[0].depth, 0);
  EXPECT_EQ(summary.all.overlapping, 0u);
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
  EXPECT_NEAR(static_cast<double>(summary.events[0].worst), 50, 8);
  EXPECT_EQ(summary.all.in_walls, summary.events[0].frames);
}

/// People who walk straight on in a square.
void add_crowd(MadeUp& recording, std::uint32_t people, int frames) {
  test::Random random(291);
  for (std::uint32_t i = 0; i < people; ++i) {
    const double angle = random.uniform(-3, 3), speed = random.uniform(0, 1.6);
    recording.walk(1 + 3 * i, random.uniform(0, 8), random.uniform(0, 8), speed * std::cos(angle),
                   speed * std::sin(angle), frames);
  }
}

/// All that is told of a recording, as text.
std::string told(MadeUp& recording, const CheckOptions& options) {
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
  const std::string expected = told(recording, options);
  EXPECT_GT(expected.size(), 10'000u);
  for (const std::size_t at_once : {std::size_t{1}, std::size_t{500}, std::size_t{1'000'000}})
    for (const int threads : {1, 2}) {
      options.people_at_once = at_once;
      tbb::task_arena arena(threads);
      arena.execute([&] { EXPECT_TRUE(told(recording, options) == expected) << at_once << " " << threads; });
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

TEST(Check, IntervalsJoinToTheWhole) {
  MadeUp recording(10);
  const int frames = static_cast<int>(test::samples(80));
  add_crowd(recording, 60, frames);
  recording.walk(1000, 4, 4, 0, 0,
                 3 * frames);  // people for whom events span all intervals, and frames go on
  recording.walk(1001, 4.1, 4, 0, 0, 3 * frames);
  const ObstacleSet walls = obstacles_from_wkt("POLYGON((0 0, 8 0, 8 8, 0 8))", Polygons::walkable);
  CheckOptions options;
  options.walls = &walls;
  const std::string expected = text_of(check_of(recording, options));
  for (const std::int64_t parts : {2, 7, 20}) {
    options.people_at_once = parts % 2 == 0 ? 100'000 : 400;
    std::vector<CheckSummary> intervals(1);  // without a frame
    for (std::int64_t k = 0; k < parts; ++k) {
      options.frames = {3 * frames * k / parts, 3 * frames * (k + 1) / parts};
      intervals.push_back(check_of(recording, options));
    }
    EXPECT_EQ(text_of(join(intervals)), expected) << parts;
  }
}

TEST(Check, SlabsClearSomeOfTheOverlaps) {
  MadeUp recording(10);
  add_crowd(recording, 60, static_cast<int>(test::samples(80)));
  CheckOptions options;
  const std::uint64_t whole = check_of(recording, options).all.overlapping_pairs;
  options.plan.slices = {0.4f, 0.85f, 1.05f};
  const std::uint64_t in_slabs = check_of(recording, options).all.overlapping_pairs;
  EXPECT_GT(in_slabs, whole / 3);
  EXPECT_LT(in_slabs, whole);
}

/// A deeper cut never adds an overlap, and segments add none to discs. (Discs of 2 cm at the leaves.)
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

/// Clips of characters walk at the speed and in the direction of their feet, and the distance drives them.
TEST(Cast, WalksAsItsClipsSay) {
  constexpr double speed = 1.2;
  Character person = default_pedestrian(Sex::male, 1.8);
  const auto clip = static_cast<std::uint32_t>(std::lround(speed / pedestrian_speed_step));
  person.clips = {person.clips[0], person.clips[clip / 2], person.clips[clip]};
  // Facing -y, as most files do.
  for (std::size_t k = 0; k < 4; ++k) {
    std::swap(person.to_ground.rows[0][k], person.to_ground.rows[1][k]);
    person.to_ground.rows[1][k] *= -1;
  }
  const CastMember member = cast_member(person, "somebody");
  EXPECT_NEAR(member.height, 1.8, 0.05);
  ASSERT_EQ(member.walks.size(), 2u);
  EXPECT_NEAR(member.clips[member.walks[0]].speed, speed / 2, 0.1);
  EXPECT_NEAR(member.clips[member.walks[1]].speed, speed, 0.1);
  ASSERT_EQ(member.idles.size(), 1u);
  Walker walker{1, 0, 0, 0, speed, 0, member.height, false, false};
  EXPECT_EQ(cast_pose({&member, 1}, {}, walker, 1).clip, 2u);
  const double seconds = static_cast<double>(person.clips[2].seconds);
  walker.way = 100.5 * seconds * member.clips[member.walks[1]].speed;
  EXPECT_NEAR(static_cast<double>(cast_pose({&member, 1}, {}, walker, 1).seconds), seconds / 2, 0.03);
  walker.speed = 0.4;
  EXPECT_EQ(cast_pose({&member, 1}, {}, walker, 1).clip, 1u);
  walker.speed = 0.1;
  EXPECT_EQ(cast_pose({&member, 1}, {}, walker, 1).clip, 0u);
  const CastMember half = cast_member(scaled(member, member.height / 2), "half of him");
  EXPECT_NEAR(half.height, member.height / 2, 1e-3);
  EXPECT_NEAR(half.clips[half.walks[1]].speed, member.clips[member.walks[1]].speed / 2, 1e-3);
  // It walks along +x, as those people do that need no turn.
  const CastMember straight = cast_member(default_pedestrian(Sex::male, 1.8), "him");
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(member.character.to_ground.rows[row][k], straight.character.to_ground.rows[row][k], 0.02);
  person.clips = {};
  EXPECT_THROW(cast_member(person, "nobody"), std::invalid_argument);
}

std::string complaint(const NamedMotion& named, const Cast& cast) {
  try {
    cast_motions({&named, 1}, cast);
  } catch (const TrajectoryError& error) {
    return error.what();
  }
  return "accepted";
}

/// Rows choose the body, the clip and the time in it; what they leave open is chosen as without them.
TEST(Cast, PlaysWhatRowsName) {
  Cast cast;
  for (const char* const name : {"a.glb", "b.glb"}) cast.push_back(cast_member(default_male(), name));
  const auto seconds = [&](std::uint32_t clip) { return cast[0].clips[clip].seconds; };
  const std::vector<NamedMotion> named{{"b", cast[0].clips[1].name, "f:1"}, {"a.glb", "", "f:2"}};
  const auto motions = cast_motions(named, cast);
  Walker walker{1, 0, 0, 0, 1.2, 0, 1.75, false, false};
  walker.motion = 0, walker.clip_seconds = static_cast<float>(3.25 * seconds(1));
  CastPose pose = cast_pose(cast, motions, walker, 1);
  EXPECT_EQ(pose.member, 1u);
  EXPECT_EQ(pose.clip, 1u);
  EXPECT_NEAR(static_cast<double>(pose.seconds), seconds(1) / 4, seconds(1) / cast[0].clips[1].phases);
  walker.motion = 1, walker.clip_seconds = unknown;
  pose = cast_pose(cast, motions, walker, 1);
  EXPECT_EQ(pose.member, 0u);
  EXPECT_TRUE(std::ranges::count(cast[0].walks, pose.clip));
  EXPECT_EQ(complaint({"c.glb", "", "f:7"}, cast), "f:7: character 'c.glb' is none of 'a.glb', 'b.glb'");
  EXPECT_TRUE(
      complaint({"", "fly", "f:8"}, cast).starts_with("f:8: clip 'fly' is not in 'a.glb', which has "));
  EXPECT_EQ(complaint({"", "fly", "f:8"}, {}),
            "f:8: clip 'fly' needs a file that has it: --character has to name it");
  cast[1].name = "a.fbx";
  EXPECT_EQ(complaint({"a", "", "f:9"}, cast), "f:9: character 'a' may be several of 'a.glb', 'a.fbx'");
}

/// Shapes of a clip of the built-in man, and of another, turned by an angle, at 20 a second.
BakedShapes baked_man(double turn) {
  Character man = default_male();
  for (std::size_t k = 0; k < 4; ++k) {
    const float x = man.to_ground.rows[0][k], y = man.to_ground.rows[1][k];
    const auto c = static_cast<float>(std::cos(turn)), s = static_cast<float>(std::sin(turn));
    man.to_ground.rows[0][k] = c * x - s * y, man.to_ground.rows[1][k] = s * x + c * y;
  }
  const auto clip_of = [&](const char* name) {
    return static_cast<std::uint32_t>(std::ranges::find(man.clips, name, &Clip::name) - man.clips.begin());
  };
  ShapeOrigins origins{0.02, {"man.glb", "walk", "idle phone"}, {}};
  PoseShaper shaper(man);
  std::vector<Shape> shapes;
  for (const std::uint32_t name : {1u, 2u})
    for (int k = 0; k < 20;
         ++k) {  // a clip that walks has a second's steps, and one that stands is cut short
      const float seconds = static_cast<float>(k) / 20;
      shapes.push_back(shaper.shape({clip_of(origins.names[name].c_str()), seconds}));
      origins.origins.push_back({0, name, seconds});
    }
  return {ShapeSet(shapes), origins};
}

TEST(BakedCast, MovesAsItsShapesAndSpeedsSay) {
  const BakedShapes baked = baked_man(0);
  const std::vector<ClipSpeed> speeds{{"walk", 1.3}, {"idle phone", 0}};
  const Cast cast = baked_cast(baked, "people.bch", speeds);
  ASSERT_EQ(cast.size(), 1u);
  Walker walker{1, 0, 0, 0, 1.2, 0, 1.75, false, false};
  const auto shape_at = [&](double way) {
    walker.way = way;
    const CastPose pose = cast_pose(cast, {}, walker, 1);
    return cast[0].clips[pose.clip].baked[pose.phase].shape;
  };
  EXPECT_EQ(shape_at(0), 0u);
  EXPECT_EQ(shape_at(1.3 * 0.501), 10u);
  EXPECT_EQ(shape_at(1.3 * 0.524), 10u);  // and not the one behind
  EXPECT_EQ(shape_at(1.3 * 0.526), 11u);
  EXPECT_EQ(shape_at(1.3 * 0.974), 19u);
  EXPECT_EQ(shape_at(1.3 * 0.976), 0u);  // round again
  EXPECT_EQ(shape_at(1.3 * 7.1), 2u);
  walker.speed = 0, walker.seconds = 0.25;
  EXPECT_EQ(shape_at(0), 25u);
}

/// What was baked another way round, and is said to be so, gives the same answers.
TEST(BakedCast, FacesWhereItIsSaidTo) {
  MadeUp recording(10);
  add_crowd(recording, 40, static_cast<int>(test::samples(40)));
  const std::vector<ClipSpeed> speeds{{"walk", 1.3}};
  std::vector<std::uint64_t> pairs;
  for (const double turn : {0.0, 1.1}) {
    const BakedShapes baked = baked_man(turn);
    const Cast cast = baked_cast(baked, "people.bch", speeds);
    CheckOptions options;
    options.cast = cast, options.baked = &baked.set, options.facing = turn;
    const CheckSummary summary = check_of(recording, options);
    pairs.push_back(summary.all.overlapping_pairs);
    EXPECT_EQ(summary.poses.size(), 20u);
    options.facing += 1.5;
    EXPECT_NE(check_of(recording, options).all.overlapping_pairs, pairs.back());
  }
  EXPECT_NEAR(static_cast<double>(pairs[0]), static_cast<double>(pairs[1]), 1);  // by the outline's grid
}

std::string baked_complaint(const BakedShapes& baked, const std::vector<ClipSpeed>& speeds) {
  try {
    baked_cast(baked, "p.bch", speeds);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BakedCast, RefusesWhatItCannotKnow) {
  BakedShapes baked = baked_man(0);
  EXPECT_EQ(baked_complaint(baked, {{"hop", 1}}), "p.bch: has no clip called hop");
  EXPECT_EQ(
      baked_complaint(baked, {{"walk", 0}}),
      "p.bch: does not say how fast people walk in its clips: --clip-speed has to, as walk=1.3; those of "
      "man.glb are walk, idle phone");
  baked.origins.origins.clear();
  EXPECT_EQ(baked_complaint(baked, {}), "p.bch: does not say which clips and times its shapes show");
}

bool inside(const Outline& outline, Vec2 p) {
  bool odd = false;
  for (std::size_t k = 0; k < outline.contours(); ++k) {
    const auto contour = outline.contour(k);
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec2 a = contour[i], b = contour[(i + 1) % contour.size()];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) odd = !odd;
    }
  }
  return odd;
}

double distance(Vec2 p, Vec2 from, Vec2 to) {
  const double x = static_cast<double>(to.x - from.x), y = static_cast<double>(to.y - from.y),
               px = static_cast<double>(p.x - from.x), py = static_cast<double>(p.y - from.y);
  const double share = std::clamp((px * x + py * y) / std::max(x * x + y * y, 1e-12), 0.0, 1.0);
  return std::hypot(px - share * x, py - share * y);
}

/// How far what one outline encloses sticks out of the other, metres. (Where an arm meets the body, what it goes round is suddenly inside:
/// that is no movement.)
double farthest(const Outline& a, const Outline& b) {
  double most = 0;
  for (const Vec2& p : a.points) {
    if (inside(b, p)) continue;
    double least = 1e9;
    for (std::size_t k = 0; k < b.contours(); ++k) {
      const auto contour = b.contour(k);
      for (std::size_t i = 0; i < contour.size(); ++i)
        least = std::min(least, distance(p, contour[i], contour[(i + 1) % contour.size()]));
    }
    most = std::max(most, least);
  }
  return most;
}

struct Farthest {
  double by_phase = 0, by_speed = 0;
};

/// Of the pose that is built and that of a walker's own phase and speed, to either of which half a step is missing.
Farthest farthest_poses(std::uint32_t coarse) {
  Farthest all;
  for (const bool is_female : {false, true}) {
    const Character person = default_pedestrian(is_female ? Sex::female : Sex::male, 1.7);
    PoseShaper shaper(person), other(person);
    for (std::uint32_t clip = 0; clip + coarse < pedestrian_speeds; clip += 4 * coarse) {
      Walker walker{1, 0, 0, 0, pedestrian_speed_step * clip, 0, 1.7, is_female, false};
      const auto at = [&](std::uint32_t k) {
        return PoseTime{
            k, static_cast<float>(walker.phase / pedestrian_strides_per_second(pedestrian_speed_step * k))};
      };
      for (walker.phase = 0.003; walker.phase < 1; walker.phase += 0.09) {
        const Outline own = shaper.shape(at(clip)).outline;
        const Outline built = other.shape(WalkerPose(walker, Shoulders::straight, coarse).at()).outline;
        all.by_phase = std::max({all.by_phase, farthest(built, own), farthest(own, built)});
        const Outline faster = other.shape(at(clip + coarse)).outline;
        all.by_speed = std::max({all.by_speed, farthest(own, faster) / 2, farthest(faster, own) / 2});
      }
    }
  }
  return all;
}

TEST(WalkerPoses, ChangeOutlinesByNoMoreThanACentimetre) {
  for (const std::uint32_t coarse : {1u, 3u}) {
    const auto [by_phase, by_speed] = farthest_poses(coarse);
    EXPECT_LT(std::max(by_phase, by_speed), 0.01 * coarse);
    EXPECT_GT(std::min(by_phase, by_speed), 0.001);
    std::printf("phases change outlines by %.1f mm at most, speeds by %.1f mm\n", 1000 * by_phase,
                1000 * by_speed);
  }
}

}  // namespace
}  // namespace bch::detail
