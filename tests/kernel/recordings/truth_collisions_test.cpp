// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/truth_collisions.hpp"

#include <set>

#include <bch/pairs.hpp>

#include "tests/support/made_up_recording.hpp"
#include "tests/support/test.hpp"

// Predictions against the truth, by the plain formula over all pairs of all frames.

namespace bch::detail {
namespace {

using test::MadeUp;

struct Found {
  std::uint64_t frames, disc_colliding, colliding;
};

Found compared(MadeUp& prediction, MadeUp& truth, const CheckOptions& options = {}) {
  prediction.rewind(), truth.rewind();
  TruthCollisions collisions(truth, prediction.info(), options);
  check(prediction, options, [&](const CheckedFrame& frame, const ShapeSet&) { collisions.add(frame); });
  return {collisions.frames(), collisions.disc_colliding(), collisions.colliding()};
}

/// Holds a frame as check() poses its people.
struct Posed {
  std::vector<CheckedPerson> people;
  std::vector<WalkerPose> poses;
};
std::vector<Posed> posed(MadeUp& recording) {
  std::vector<Posed> frames;
  recording.rewind();
  check(recording, {}, [&](const CheckedFrame& frame, const ShapeSet&) {
    frames.push_back({{frame.people.begin(), frame.people.end()}, {frame.poses.begin(), frame.poses.end()}});
  });
  return frames;
}

/// Adds the prediction's people whose outlines overlap those of others of the truth, `share` of the way to the
/// next frames.
void add_overlaps(const Posed& from, const Posed& true_from, const Posed& to, const Posed& true_to,
                  double share, WalkerShapes& shapes, std::set<std::int64_t>& colliding) {
  std::vector<WalkerPose> poses = from.poses;
  poses.insert(poses.end(), true_from.poses.begin(), true_from.poses.end());
  std::vector<std::uint32_t> shape(poses.size());
  shapes.find(poses, shape);
  std::vector<double> x, y, heading;
  for (const auto& [now, later] : {std::pair(&from, &to), std::pair(&true_from, &true_to)})
    for (std::size_t i = 0; i < now->people.size(); ++i) {
      const Walker &a = now->people[i].walker, &b = later->people[i].walker;
      x.push_back(a.x + share * (b.x - a.x)), y.push_back(a.y + share * (b.y - a.y));
      heading.push_back(a.heading);
    }
  const auto people = static_cast<std::uint32_t>(from.people.size());
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < people; ++i)
    for (std::uint32_t j = 0; j < people; ++j)
      if (i != j) pairs.push_back({i, people + j});
  std::vector<std::uint8_t> hits(pairs.size());
  collide(shapes.set(), {shape, x, y, heading}, pairs, hits);
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (hits[k] != 0) colliding.insert(from.people[pairs[k].first].walker.id);
}

TEST(TruthCollisions, AreWithOthersAsTheyTrulyWent) {
  MadeUp prediction(1), truth(1);
  truth.walk(1, 0, 0, 1, 0, 3);
  truth.walk(2, 0, 5, 1, 0, 3);
  truth.walk(3, 0.5, 9.1, 0, 0, 3);
  prediction.walk(1, 0, 4.85, 1, 0, 3);  // where 2 truly goes
  prediction.walk(2, 0, 4.9, 1, 0, 3);   // where 1 is predicted, and 2 himself truly goes
  prediction.walk(3, 9, 9, 0, 0, 3);     // near nobody
  prediction.walk(4, 0, 9, 1, 0, 2);     // past 3, halfway between two frames
  const Found found = compared(prediction, truth);
  EXPECT_EQ(found.disc_colliding, 2u);
  EXPECT_EQ(found.colliding, 2u);
  EXPECT_EQ(found.frames, 3u);
}

TEST(TruthCollisions, AreInFramesOfBothAlone) {
  MadeUp prediction(1), truth(1);
  for (const std::int64_t frame : {0, 2, 3, 5}) prediction.add(frame, {1, 0.4 * double(frame), 0, 0, 1.75f});
  for (const std::int64_t frame : {1, 4}) truth.add(frame, {2, 0.4 * double(frame), 0, 0, 1.75f});
  EXPECT_EQ(compared(prediction, truth).frames, 0u);
  EXPECT_EQ(compared(prediction, truth).disc_colliding, 0u);
  EXPECT_EQ(compared(prediction, truth).colliding, 0u);
  truth.add(5, {2, 2.1, 0, 0, 1.75f});
  EXPECT_EQ(compared(prediction, truth).frames, 1u);
  EXPECT_EQ(compared(prediction, truth).disc_colliding, 1u);
  EXPECT_EQ(compared(prediction, truth).colliding, 1u);
}

TEST(TruthCollisions, OfACrowdAreTheirFormula) {
  constexpr int frames = 30, people = 120;
  MadeUp prediction(10), truth(10);
  struct Path {
    double x, y, speed_x, speed_y;
    std::pair<double, double> at(double frame) const {
      return {x + speed_x * frame / 10, y + speed_y * frame / 10};
    }
  };
  std::vector<Path> predicted, true_ones;
  test::Random random(59);
  for (int k = 0; k < people; ++k) {
    const double x = random.uniform(0, 20), y = random.uniform(0, 20);
    for (const auto& [paths, recording] :
         {std::pair(&predicted, &prediction), std::pair(&true_ones, &truth)}) {
      const Path& path =
          paths->emplace_back(Path{x, y, random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5)});
      recording->walk(k, x, y, path.speed_x, path.speed_y, frames);
    }
  }
  std::uint64_t expected = 0;
  for (int i = 0; i < people; ++i) {
    bool collides = false;
    for (int half = 0; half <= 2 * (frames - 1); ++half)
      for (int j = 0; j < people; ++j) {
        const auto [x, y] = predicted[i].at(half / 2.0);
        const auto [other_x, other_y] = true_ones[j].at(half / 2.0);
        collides |= j != i && std::hypot(x - other_x, y - other_y) <= 0.2;
      }
    expected += collides;
  }
  EXPECT_EQ(compared(prediction, truth).disc_colliding, expected);
  EXPECT_GT(expected, 20u);
  EXPECT_LT(expected, 115u);
}

TEST(TruthCollisions, OfBodiesAreOverlapsOfAllPairs) {
  MadeUp prediction(10), truth(10);
  test::Random random(61);
  for (int k = 0; k < 60; ++k) {
    const double x = random.uniform(0, 18), y = random.uniform(0, 18);
    for (MadeUp* const recording : {&prediction, &truth})
      recording->walk(k, x, y, random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), 8);
  }
  const std::vector<Posed> predicted = posed(prediction), true_ones = posed(truth);
  WalkerShapes shapes(ShapeSetPlan(), {});
  std::set<std::int64_t> colliding;
  for (std::size_t k = 0; k < predicted.size(); ++k) {
    const std::size_t next = std::min(k + 1, predicted.size() - 1);
    for (const double share : {0.0, 0.5})
      add_overlaps(predicted[k], true_ones[k], predicted[next], true_ones[next], share, shapes, colliding);
  }
  EXPECT_EQ(compared(prediction, truth).colliding, colliding.size());
  EXPECT_GT(colliding.size(), 10u);
  EXPECT_LT(colliding.size(), 55u);
}

TEST(TruthCollisions, OfSpheresAreInSpace) {
  MadeUp prediction(10), truth(10);
  truth.walk(1, 0, 0, 1, 0, 3);
  truth.walk(2, 0, 5, 1, 0, 3);
  prediction.walk(1, 0, 4.85, 1, 0, 3);
  prediction.walk(2, 0, 1, 1, 0, 3);
  const std::vector<BodyModel> models = body_models({}, 64);
  CheckOptions options;
  options.bodies = models;
  EXPECT_EQ(compared(prediction, truth, options).colliding, 1u);
}

TEST(TruthCollisions, RefusesAnotherFrameRate) {
  MadeUp truth(25);
  truth.walk(1, 0, 0, 1, 0, 3);
  truth.rewind();
  try {
    TruthCollisions collisions(truth, MadeUp(10).info(), {});
    FAIL() << "taken";
  } catch (const TrajectoryError& error) {
    EXPECT_NE(std::string(error.what()).find("25 frames a second, and the prediction 10"), std::string::npos);
  }
}

}  // namespace
}  // namespace bch::detail
