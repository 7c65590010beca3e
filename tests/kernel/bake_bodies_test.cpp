// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <system_error>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/characters.hpp>

#include "tests/support/body_models.hpp"
#include "tests/support/complaint.hpp"

namespace bch {
namespace {

std::vector<Sphere> posed(const BodyModel& model, const Pose& pose) {
  BodyPoser poser(model);
  const auto spheres = poser.spheres(pose);
  return {spheres.begin(), spheres.end()};
}

TEST(BakeBodies, MakesBodiesInPosesOfAllClips) {
  const std::vector<BodyModel> models = {test::plain_model(default_male(), 100),
                                         test::plain_model(default_female(), 300)};
  const BodySet set = bake(models, {.poses = 20});
  ASSERT_EQ(set.body_count(), 40u);
  for (std::uint32_t m = 0; m < 2; ++m) {
    const std::vector<PoseTime> poses = sample_poses(*models[m].character, 20);
    for (const std::uint32_t i : {0u, 7u, 19u})
      EXPECT_EQ(set.spheres(20 * m + i), posed(models[m], poses[i]));
  }
}

TEST(BakeBodies, MakesWhatIsListed) {
  const std::vector<BodyModel> models = {test::plain_model(default_male(), 50),
                                         test::plain_model(default_female(), 60)};
  const auto joints = joint_transforms(*models[1].character, {2, 0.5f}, JointFrame::world);
  const BodySet set = bake(models, {.bodies = {{1, Pose(3, 0.25f)}, {0, {}}, {1, WorldPose{joints}}}});
  ASSERT_EQ(set.body_count(), 3u);
  EXPECT_EQ(set.spheres(0), posed(models[1], Pose(3, 0.25f)));
  EXPECT_EQ(set.spheres(1), posed(models[0], Pose()));
  EXPECT_EQ(set.spheres(2), posed(models[1], Pose(2, 0.5f)));
}

TEST(BakeBodies, GivesTheSameForAnyNumberOfThreads) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  const BodyModel model = test::plain_model(default_male(), 80);
  std::vector<std::vector<Sphere>> expected;
  for (const int threads : {1, 2, 4})
    tbb::task_arena(threads).execute([&] {
      const BodySet set = bake(model, {.poses = 101});
      for (std::uint32_t i = 0; i < set.body_count(); ++i) {
        if (threads == 1) expected.push_back(set.spheres(i));
        EXPECT_EQ(set.spheres(i), expected[i]) << i;
      }
    });
  EXPECT_EQ(expected.size(), 101u);
}

TEST(BakeBodies, TellsHowFarItIsAndCanBeCancelled) {
  const BodyModel model = test::plain_model(default_male(), 20);
  std::size_t last = 0, of = 0;
  bake(model, {.poses = 30, .progress = [&](std::size_t done, std::size_t total) {
                 EXPECT_GE(done, last);
                 last = done, of = total;
                 return true;
               }});
  EXPECT_EQ(last, 30u);
  EXPECT_EQ(of, 30u);
  EXPECT_THROW(bake(model, {.poses = 30, .progress = [](std::size_t, std::size_t) { return false; }}),
               std::system_error);
}

TEST(BakeBodies, NamesWhatCannotBeMade) {
  const BodyModel model = test::plain_model(default_male(), 20);
  EXPECT_TRUE(test::has(test::complaint([&] {
                          bake(model, {.bodies = {{0, {}}, {1, {}}}});
                        }),
                        "expected one of 1 models, found 1 of body 1"));
  EXPECT_TRUE(test::has(test::complaint([&] {
                          bake(model, {.bodies = {{0, Pose(99, 0.0f)}}});
                        }),
                        "body 0: "));
  EXPECT_TRUE(test::has(test::complaint([&] { bake(BodyModel{}); }), "expected a character, found none"));
}

}  // namespace
}  // namespace bch
