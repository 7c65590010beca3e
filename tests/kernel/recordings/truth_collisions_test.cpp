// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/truth_collisions.hpp"

#include "tests/support/made_up_recording.hpp"
#include "tests/support/test.hpp"

// Predictions against the truth, by the plain formula over all pairs of all frames.

namespace bch::detail {
namespace {

using test::MadeUp;

TruthCollisions compared(MadeUp& prediction, MadeUp& truth) {
  prediction.rewind(), truth.rewind();
  TruthCollisions collisions(truth, prediction.info().fps);
  check(prediction, {}, [&](const CheckedFrame& frame, const ShapeSet&) { collisions.add(frame); });
  return collisions;
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
  const TruthCollisions found = compared(prediction, truth);
  EXPECT_EQ(found.colliding(), 2u);
  EXPECT_EQ(found.frames(), 3u);
}

TEST(TruthCollisions, AreInFramesOfBothAlone) {
  MadeUp prediction(1), truth(1);
  for (const std::int64_t frame : {0, 2, 3, 5}) prediction.add(frame, {1, 0.4 * double(frame), 0, 0, 1.75f});
  for (const std::int64_t frame : {1, 4}) truth.add(frame, {2, 0.4 * double(frame), 0, 0, 1.75f});
  EXPECT_EQ(compared(prediction, truth).frames(), 0u);
  EXPECT_EQ(compared(prediction, truth).colliding(), 0u);
  truth.add(5, {2, 2.1, 0, 0, 1.75f});
  EXPECT_EQ(compared(prediction, truth).frames(), 1u);
  EXPECT_EQ(compared(prediction, truth).colliding(), 1u);
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
  EXPECT_EQ(compared(prediction, truth).colliding(), expected);
  EXPECT_GT(expected, 20u);
  EXPECT_LT(expected, 115u);
}

TEST(TruthCollisions, RefusesAnotherFrameRate) {
  MadeUp truth(25);
  truth.walk(1, 0, 0, 1, 0, 3);
  truth.rewind();
  try {
    TruthCollisions collisions(truth, 10);
    FAIL() << "taken";
  } catch (const TrajectoryError& error) {
    EXPECT_NE(std::string(error.what()).find("25 frames a second, and the prediction 10"), std::string::npos);
  }
}

}  // namespace
}  // namespace bch::detail
