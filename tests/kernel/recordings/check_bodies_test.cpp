// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/check.hpp"

#include "kernel/recordings/walker_bodies.hpp"
#include "tests/support/made_up_recording.hpp"
#include "tests/support/on_threads.hpp"
#include "tests/support/test.hpp"

// Checks of recordings by bodies of spheres, against queries of every pair of a frame.

namespace bch::detail {
namespace {

using test::MadeUp;

constexpr std::uint32_t spheres = 64;
constexpr double fps = 2, max_distance = 0.3;

struct ToldFrame {
  std::int64_t frame;
  std::vector<CheckedPerson> people;
  std::vector<CheckedPair> pairs;
};

std::vector<ToldFrame> told(MadeUp& recording, const CheckOptions& options) {
  std::vector<ToldFrame> frames;
  recording.rewind();
  check(recording, options, [&](const CheckedFrame& frame, const ShapeSet& shapes) {
    EXPECT_EQ(shapes.shape_count(), 0u);
    frames.push_back(
        {frame.frame, {frame.people.begin(), frame.people.end()}, {frame.pairs.begin(), frame.pairs.end()}});
  });
  return frames;
}

/// The model of a person: that of the library, or that of his character in his stature.
BodyModel model_of(const WalkerPose& pose, const CheckOptions& options) {
  auto character = std::make_shared<const Character>(pose.character(options.library));
  if (options.library.empty()) return default_body(*character, spheres);
  BodyModel model = options.bodies[pose.member];
  model.character = std::move(character);
  return model;
}

/// The people of a frame, each in a body of his own.
struct PosedFrame {
  std::vector<double> x, y, heading;
  std::vector<std::uint32_t> number;
  BodySet set;

  PosedFrame(const ToldFrame& frame, const CheckOptions& options) : set(posed(frame, options)) {
    for (const CheckedPerson& person : frame.people) {
      number.push_back(static_cast<std::uint32_t>(number.size()));
      x.push_back(person.walker.x), y.push_back(person.walker.y), heading.push_back(person.walker.heading);
    }
  }
  static BodySet posed(const ToldFrame& frame, const CheckOptions& options) {
    std::map<std::uint64_t, std::uint32_t> number_of;
    std::vector<BodyModel> models;
    BakeBodiesOptions how;
    for (const CheckedPerson& person : frame.people) {
      EXPECT_LT(person.density, 4.0f);  // so that nobody turns his shoulders
      const WalkerPose pose(person.walker, Shoulders::straight, 1, options.library);
      const auto [model, is_new] = number_of.emplace(pose.body(), static_cast<std::uint32_t>(models.size()));
      if (is_new) models.push_back(model_of(pose, options));
      how.bodies.push_back({model->second, pose.exact()});
    }
    return bake(models, how);
  }
  Agents agents() const { return {number, x, y, heading}; }
  bool collides(Pair pair) const {
    std::uint8_t hit = 0;
    collide(set, agents(), {&pair, 1}, {&hit, 1});
    return hit != 0;
  }
  /// How far two people are apart, or how deep two of their spheres overlap, below 0.
  float gap(Pair pair) const {
    float gap = 0;
    clearance(set, agents(), {&pair, 1}, {{&gap, 1}}, {.overlap = Overlap::deepest});
    return gap;
  }
  /// How far the first of two people has to move, and where.
  Penetration way_out(Pair pair) const {
    Penetration out = {};
    penetration(set, agents(), {&pair, 1}, 32, {&out, 1});
    return out;
  }
  float time(Pair pair, double dx, double dy) const {
    float time = 0;
    time_of_impact(set, agents(), {&pair, 1}, {{&dx, 1}, {&dy, 1}}, {&time, 1});
    return time;
  }
};

/// Where in a frame somebody is, if he is there.
std::optional<std::uint32_t> place_of(std::int64_t id, const ToldFrame& frame) {
  for (std::uint32_t i = 0; i < frame.people.size(); ++i)
    if (frame.people[i].walker.id == id) return i;
  return std::nullopt;
}

/// When two people pass who do not overlap in the first of two frames: a share of the time between these.
std::optional<float> passes(Pair pair, const ToldFrame& now, const PosedFrame& posed, const ToldFrame& next,
                            const PosedFrame& posed_next) {
  const auto first = place_of(now.people[pair.first].walker.id, next),
             second = place_of(now.people[pair.second].walker.id, next);
  if (!first || !second) return std::nullopt;
  const double dx = posed_next.x[*first] - posed.x[pair.first] - posed_next.x[*second] + posed.x[pair.second],
               dy = posed_next.y[*first] - posed.y[pair.first] - posed_next.y[*second] + posed.y[pair.second];
  if (dx * dx + dy * dy < 0.05 * 0.05) return std::nullopt;
  const float time = posed.time(pair, dx, dy);
  if (!(time > 0 && time < 1) || posed_next.collides({*first, *second})) return std::nullopt;
  return time;
}

/// What is told of a frame, as lines.
using Lines = std::multiset<std::string>;

template <class... Values>
std::string line(const Values&... values) {
  std::ostringstream text;
  text.precision(9);
  ((text << values << " "), ...);
  return std::move(text).str();
}

/// The direction on the ground against one in space.
std::string against(Vec3 direction) {
  const double x = double{direction.x}, y = double{direction.y}, length = std::sqrt(x * x + y * y);
  return line(static_cast<float>(-x / length), static_cast<float>(-y / length));
}

Lines lines_of(const ToldFrame& frame) {
  Lines lines;
  for (const CheckedPair& pair : frame.pairs)
    lines.insert(pair.passing   ? line("pass", pair.first, pair.second, pair.gap, pair.after)
                 : pair.is_wall ? line("wall", pair.first, pair.depth, line(pair.x, pair.y))
                 : pair.overlap ? line("overlap", pair.first, pair.second, pair.depth, line(pair.x, pair.y))
                                : line("near", pair.first, pair.second, pair.gap));
  return lines;
}

/// The same by every pair and every agent. `next`: the frame behind, or nullptr.
Lines expected(const ToldFrame& now, const PosedFrame& posed, const ToldFrame* next, const PosedFrame* then,
               const CheckOptions& options) {
  Lines lines;
  for (std::uint32_t b = 0; b < now.people.size(); ++b)
    for (std::uint32_t a = 0; a < b; ++a) {
      const Pair pair{a, b};
      const std::int64_t first = now.people[a].walker.id, second = now.people[b].walker.id;
      const float gap = posed.gap(pair);
      EXPECT_EQ(posed.collides(pair), gap <= 0);
      if (gap <= 0) {
        const auto [depth, x, y] = posed.way_out(pair);
        lines.insert(
            line("overlap", first, second, depth, line(static_cast<float>(x), static_cast<float>(y))));
        continue;
      }
      if (static_cast<double>(gap) <= max_distance) lines.insert(line("near", first, second, gap));
      if (const auto time = next == nullptr ? std::nullopt : passes(pair, now, posed, *next, *then))
        lines.insert(line("pass", first, second, gap, *time));
    }
  std::vector<std::uint8_t> hits(now.people.size());
  std::vector<float> depths(now.people.size());
  std::vector<Vec3> directions(now.people.size());
  collide(posed.set, posed.agents(), *options.walls, hits);
  clearance(posed.set, posed.agents(), *options.walls, {depths, directions}, {.overlap = Overlap::deepest});
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (hits[i] != 0) lines.insert(line("wall", now.people[i].walker.id, -depths[i], against(directions[i])));
  return lines;
}

/// Checks every frame, and that all kinds of answers were there.
void expect_answers(const CheckOptions& options) {
  MadeUp recording(fps);
  test::add_crowd(recording, 60, 6);
  const std::vector<ToldFrame> frames = told(recording, options);
  std::vector<PosedFrame> posed;
  for (const ToldFrame& frame : frames) posed.emplace_back(frame, options);
  std::map<std::string, std::size_t> kinds;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const bool is_last = i + 1 == frames.size();
    const Lines lines = lines_of(frames[i]);
    ASSERT_EQ(lines, expected(frames[i], posed[i], is_last ? nullptr : &frames[i + 1],
                              is_last ? nullptr : &posed[i + 1], options))
        << i;
    for (const std::string& each : lines) ++kinds[each.substr(0, each.find(' '))];
  }
  for (const char* const kind : {"overlap", "near", "pass", "wall"}) EXPECT_GT(kinds[kind], 3u) << kind;
}

TEST(CheckOfBodies, AnswersAreThoseOfQueriesOfEveryPair) {
  const ObstacleSet walls = obstacles_from_wkt("POLYGON((0 0, 8 0, 8 8, 0 8))", Polygons::walkable);
  CheckOptions options;
  options.walls = &walls;
  options.max_distance = max_distance;
  options.draws = false;
  const std::vector<BodyModel> pedestrians = body_models({}, spheres);
  options.bodies = pedestrians;
  expect_answers(options);

  const CharacterLibrary library{character_entry(default_female(), "female"),
                                 character_entry(default_male(), "male")};
  const std::vector<BodyModel> own = body_models(library, spheres);
  options.library = library;
  options.bodies = own;
  expect_answers(options);
}

TEST(CheckOfBodies, IsTheSameForAnyNumberOfThreadsAndFramesAtOnce) {
  MadeUp recording(10);
  test::add_crowd(recording, 60, static_cast<int>(test::samples(30)));
  const std::vector<BodyModel> pedestrians = body_models({}, spheres);
  CheckOptions options;
  options.bodies = pedestrians;
  options.max_distance = max_distance;
  options.draws = false;
  const auto lines = [&] {
    std::vector<Lines> all;
    for (const ToldFrame& frame : told(recording, options)) all.push_back(lines_of(frame));
    return all;
  };
  const std::vector<Lines> expected = lines();
  for (const std::size_t at_once : {std::size_t{1}, std::size_t{500}})
    for (const unsigned threads : {1u, 2u}) {
      options.people_at_once = at_once;
      test::on_threads(threads, [&] { EXPECT_TRUE(lines() == expected) << at_once << " " << threads; });
    }
}

/// Spheres see an arm above a foot, which outlines take for an overlap.
TEST(CheckOfBodies, FewerOverlapThanOutlines) {
  MadeUp recording(10);
  test::add_crowd(recording, 60, static_cast<int>(test::samples(40)));
  const CheckSummary outlines = test::check_of(recording);
  const std::vector<BodyModel> pedestrians = body_models({}, 512);
  CheckOptions options;
  options.bodies = pedestrians;
  const CheckSummary bodies = test::check_of(recording, options);
  EXPECT_EQ(bodies.people, outlines.people);
  EXPECT_EQ(bodies.all.near_pairs, outlines.all.near_pairs);
  EXPECT_TRUE(bodies.poses.empty());
  EXPECT_GT(bodies.all.overlapping_pairs, outlines.all.overlapping_pairs / 2);
  EXPECT_LT(bodies.all.overlapping_pairs, outlines.all.overlapping_pairs);
}

}  // namespace
}  // namespace bch::detail
