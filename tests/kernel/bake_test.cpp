// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <system_error>

#include "tests/support/baked_bytes.hpp"
#include "tests/support/test.hpp"

// bake() gives what the loop over PoseShaper gives, for any number of threads, and names what it cannot make.

namespace bch {
namespace {

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
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  const std::vector<Character> people = {default_male(), default_female()};
  for (const ShapeSetPlan& plan : {ShapeSetPlan{}, ShapeSetPlan{.depths = {0, 3}, .heights = true}}) {
    std::vector<Shape> shapes;
    for (const Character& person : people) {
      PoseShaper shaper(person, plan, 0.02f);
      for (const PoseTime& at : sample_poses(person, 70)) shapes.push_back(shaper.shape(at));
    }
    const std::string expected = bytes(ShapeSet(shapes, plan));
    for (const int threads : {1, 2, 4})
      tbb::task_arena(threads).execute([&] {
        EXPECT_EQ(bytes(bake(people, {.poses = 70, .plan = plan, .threshold = 0.02f})), expected) << threads;
      });
  }
}

TEST(Bake, TakesPosesByClipAndTime) {
  const std::vector<Character> people = {default_male(), default_female()};
  const ShapeSetPlan plan{.heights = true};
  const std::vector<ShapeSource> sources = {{1, {0, 0.5f}}, {0, {}}, {1, {1, 0.25f}}};
  std::vector<Shape> shapes;
  for (const auto& [character, at] : sources) shapes.push_back(PoseShaper(people[character], plan).shape(at));
  EXPECT_EQ(bytes(bake(people, {.shapes = sources, .plan = plan})), bytes(ShapeSet(shapes, plan)));
}

TEST(Bake, NamesTheCharacterAndThePose) {
  const Character man = vanishing_man();
  const auto error_of = [&](const ShapeSource& source) {
    return test::complaint([&] { bake(man, {.shapes = {{0, {0, 0.5f}}, source}}); });
  };
  EXPECT_TRUE(error_of({0, {0, 1}}).starts_with(man.name + ": vanish at 1 s: outline: "));
  EXPECT_TRUE(error_of({0, {7, 0.5f}}).starts_with(man.name + ": clip 7 at 0.5 s: "))
      << error_of({0, {7, 0.5f}});
  EXPECT_EQ(error_of({3, {}}), "shape 1: no character 3 of 1");
  EXPECT_THROW(bake(man, {.poses = 1, .threshold = std::numeric_limits<float>::quiet_NaN()}),
               std::invalid_argument);
  EXPECT_THROW(bake(man, {.plan = {.depths = {}}}), std::invalid_argument);
  Character broken = man;
  broken.triangles[0][0] = 0xffffffff;
  EXPECT_THROW(bake(broken, {.poses = 1}), std::invalid_argument);
}

TEST(Bake, TellsItsProgressAndCanBeCancelled) {
  const Character man = default_male();
  std::size_t last = 0, calls = 0;
  const auto count = [&](std::size_t done, std::size_t total) {
    EXPECT_LE(last, done);
    EXPECT_EQ(total, 300u);
    last = done;
    return ++calls > 0;
  };
  EXPECT_EQ(bake(man, {.poses = 300, .progress = count}).shape_count(), 300u);
  EXPECT_EQ(last, 300u);
  EXPECT_GE(calls, 2u);
  try {
    bake(man, {.poses = 300, .progress = [](std::size_t, std::size_t) { return false; }});
    ADD_FAILURE() << "was not cancelled";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::operation_canceled);
  }
}

TEST(Bake, OfNothingIsAnEmptySet) {
  EXPECT_EQ(bake(std::span<const Character>()).shape_count(), 0u);
  EXPECT_EQ(bake(default_male(), {.poses = 0}).shape_count(), 0u);
}

}  // namespace
}  // namespace bch
