// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <system_error>

#include "tests/support/baked_bytes.hpp"
#include "tests/support/body_models.hpp"
#include "tests/support/on_threads.hpp"
#include "tests/support/test.hpp"

// bake() of outlines and of bodies of spheres: what each pose gives by itself, for any number of threads; what cannot be made is named.

namespace bch {
namespace {

using Progress = std::function<bool(std::size_t done, std::size_t total)>;

/// Expects that a call tells how far it is in so many steps, and that it can be cancelled.
void expect_progress(std::size_t steps, const std::function<void(const Progress&)>& bake) {
  // The calling thread tells it, which has to do some of the work itself.
  Executor::set({[](void*, std::size_t count, void (*task)(void*, std::size_t), void* data) {
    while (count-- > 0) task(data, count);
  }});
  std::size_t last = 0, calls = 0;
  bake([&](std::size_t done, std::size_t total) {
    EXPECT_LE(last, done);
    EXPECT_EQ(total, steps);
    last = done;
    return ++calls > 0;
  });
  EXPECT_EQ(last, steps);
  EXPECT_GE(calls, 2u);
  try {
    bake([](std::size_t, std::size_t) { return false; });
    ADD_FAILURE() << "was not cancelled";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::operation_canceled);
  }
  Executor::set({});
}

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
  const BodyModel model = test::plain_model(default_male(), 80);
  std::vector<std::vector<Sphere>> expected;
  for (const unsigned threads : {1u, 2u, 4u})
    test::on_threads(threads, [&] {
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
  expect_progress(300, [&](const auto& progress) { bake(model, {.poses = 300, .progress = progress}); });
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

// ---- Outlines: what the loop over ShapeBuilder gives.

std::string bytes(const ShapeSet& set) {
  return test::BakedBytes(set, test::origins_of(set.shape_count())).text();
}

/// The man with a clip "vanish" that ends in a point, which has no outline.
Character vanishing_man() {
  Character man = default_male();
  Clip clip{"vanish", 1, {{}}};
  clip.channels[0].scales = {{0, {1, 1, 1}}, {1, {0, 0, 0}}};
  man.clips = {clip};
  return man;
}

TEST(Bake, GivesTheBytesOfTheLoopOnAnyNumberOfThreads) {
  const std::vector<Character> people = {default_male(), default_female()};
  for (const ShapeSetPlan& plan : {ShapeSetPlan{}, ShapeSetPlan{.depths = {0, 3}, .heights = true}}) {
    std::vector<Shape> shapes;
    for (const Character& person : people) {
      ShapeBuilder shape_builder(person, plan, 0.02f);
      for (const PoseTime& at : sample_poses(person, 70)) shapes.push_back(shape_builder.shape(at));
    }
    const std::string expected = bytes(ShapeSet(shapes, plan));
    for (const unsigned threads : {1u, 2u, 4u})
      test::on_threads(threads, [&] {
        EXPECT_EQ(bytes(bake(people, {.poses = 70, .plan = plan, .threshold = 0.02f})), expected) << threads;
      });
  }
}

TEST(Bake, TakesPosesByClipAndTime) {
  const std::vector<Character> people = {default_male(), default_female()};
  const ShapeSetPlan plan{.heights = true};
  const std::vector<PoseId> sources = {{1, {0, 0.5f}}, {0, {}}, {1, {1, 0.25f}}};
  std::vector<Shape> shapes;
  for (const auto& [character, at] : sources)
    shapes.push_back(ShapeBuilder(people[character], plan).shape(at));
  EXPECT_EQ(bytes(bake(people, {.shapes = sources, .plan = plan})), bytes(ShapeSet(shapes, plan)));
}

TEST(Bake, NamesTheCharacterAndThePose) {
  const Character man = vanishing_man();
  const auto error_of = [&](const PoseId& source) {
    return test::complaint([&] { bake(man, {.shapes = {{0, {0, 0.5f}}, source}}); });
  };
  EXPECT_TRUE(error_of({0, {0, 1}}).starts_with(man.name + ": vanish at 1 s: outline: "));
  EXPECT_TRUE(error_of({0, {7, 0.5f}}).starts_with(man.name + ": clip 7 at 0.5 s: "))
      << error_of({0, {7, 0.5f}});
  EXPECT_EQ(error_of({3, {}}), "shape 1: expected one of 1 characters, found 3");
  EXPECT_THROW(bake(man, {.poses = 1, .threshold = std::numeric_limits<float>::quiet_NaN()}),
               std::invalid_argument);
  EXPECT_THROW(bake(man, {.plan = {.depths = {}}}), std::invalid_argument);
  Character broken = man;
  broken.triangles[0][0] = 0xffffffff;
  EXPECT_THROW(bake(broken, {.poses = 1}), std::invalid_argument);
}

TEST(Bake, TellsItsProgressAndCanBeCancelled) {
  const Character man = default_male();
  expect_progress(300, [&](const auto& progress) { bake(man, {.poses = 300, .progress = progress}); });
}

TEST(Bake, OfNothingIsAnEmptySet) {
  EXPECT_EQ(bake(std::span<const Character>()).shape_count(), 0u);
  EXPECT_EQ(bake(default_male(), {.poses = 0}).shape_count(), 0u);
}

}  // namespace
}  // namespace bch
