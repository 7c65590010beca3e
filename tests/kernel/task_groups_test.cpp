// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <atomic>
#include <system_error>

#include "tests/support/baked_bytes.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/test.hpp"

// Queries inside of a caller's own tasks.

namespace bch {
namespace {

/// An answer, kept.
template <class Value>
struct Kept {
  std::vector<std::uint64_t> offsets;
  std::vector<std::remove_const_t<Value>> values;

  explicit Kept(const Rows<Value>& found)
      : offsets(found.offsets.begin(), found.offsets.end()),
        values(found.values.begin(), found.values.end()) {}
  bool operator==(const Rows<Value>& found) const {
    return std::ranges::equal(offsets, found.offsets) && std::ranges::equal(values, found.values);
  }
};

class TaskGroups : public testing::Test {
 protected:
  test::Crowd people(std::uint32_t count) {
    test::Crowd crowd;
    const double side = std::sqrt(4.0 * count);
    for (std::uint32_t i = 0; i < count; ++i)
      crowd.add(
          {random.below(8), random.uniform(0, side), random.uniform(0, side), random.uniform(-3, 3), 0});
    return crowd;
  }

  test::Random random{311};
  std::vector<Shape> shapes = test::synthetic_shapes(312, 8);
  ShapeSet set{shapes};
};

/// A group that is cancelled starts no more tasks, and what waits for them returns as if they had run.
TEST_F(TaskGroups, ACancelledOneTakesNoAnswers) {
  for (const std::uint32_t count : {10u, 1'500u, 3'000u, 20'000u}) {
    const test::Crowd crowd = people(count);
    const Agents agents = crowd.agents();
    const std::vector<Pair> pairs = test::candidate_pairs(set, agents);
    std::vector<std::uint8_t> expected(pairs.size());
    collide(set, agents, pairs, expected);
    test::Crowd bad = crowd;
    bad.shape[pairs.back().second] = 4'000'000'000;

    std::vector<Pair> found;
    std::vector<std::uint8_t> hits(pairs.size(), 42);
    bool rejected = false;
    tbb::task_group_context outer;
    tbb::parallel_for(
        0, 1,
        [&](int) {
          outer.cancel_group_execution();
          found = test::candidate_pairs(set, agents);
          collide(set, agents, pairs, hits);
          try {
            std::vector<std::uint8_t> none(pairs.size());
            collide(set, bad.agents(), pairs, none);
          } catch (const std::invalid_argument&) {
            rejected = true;
          }
        },
        outer);
    EXPECT_EQ(found, pairs) << count;
    EXPECT_EQ(hits, expected) << count;
    EXPECT_TRUE(rejected) << count;
  }
}

/// The exception of a task beside a query arrives, instead of a crash in that.
TEST_F(TaskGroups, ATaskBesideAQueryMayThrow) {
  const test::Crowd crowd = people(2'000);
  tbb::task_arena arena(2);
  for (int round = 0; round < 50; ++round)
    EXPECT_THROW(arena.execute([&] {
      tbb::parallel_for(0, 8, [&](int i) {
        if (i == 5) throw std::runtime_error("beside");
        test::candidate_pairs(set, crowd.agents());
      });
    }),
                 std::runtime_error);
}

/// An object for each thread, as TBB's users have it: a thread that waits within a call does not begin another with it.
template <class Object, class Ask>
void expect_one_call_at_a_time(std::size_t questions, Ask ask) {
  using Answer = Kept<typename decltype(ask(std::declval<Object&>(), 0).values)::value_type>;
  std::vector<Answer> expected;
  for (std::size_t k = 0; k < questions; ++k) {
    Object object;
    expected.emplace_back(ask(object, k));
  }
  const tbb::global_control more_than_processors(tbb::global_control::max_allowed_parallelism, 4);
  tbb::task_arena arena(4);
  tbb::enumerable_thread_specific<Object> objects;
  tbb::enumerable_thread_specific<int> inside;
  std::atomic<int> nested = 0, wrong = 0;
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, std::size_t{test::samples(1'200)}, [&](std::size_t i) {
      const std::size_t k = i % questions;
      nested += inside.local()++ != 0;
      wrong += !(expected[k] == ask(objects.local(), k));
      --inside.local();
    });
  });
  EXPECT_EQ(nested, 0);
  EXPECT_EQ(wrong, 0);
}

TEST_F(TaskGroups, OneCrowdAThreadIsEnough) {
  std::vector<test::Crowd> crowds;
  for (std::uint32_t k = 0; k < 4; ++k) crowds.push_back(people(2'500 + 500 * k));
  expect_one_call_at_a_time<Crowd>(
      4, [&](Crowd& crowd, std::size_t k) { return crowd.collisions(set, crowds[k].agents()).by_agent(); });
}

TEST_F(TaskGroups, OneCrowdAThreadIsEnoughForContacts) {
  std::vector<test::Crowd> crowds;
  std::vector<std::vector<Pair>> pairs;
  for (std::uint32_t k = 0; k < 4; ++k) {
    crowds.push_back(people(500 + 100 * k));
    pairs.push_back(test::candidate_pairs(set, crowds.back().agents()));
  }
  expect_one_call_at_a_time<Crowd>(
      4, [&](Crowd& crowd, std::size_t k) { return crowd.contacts(set, crowds[k].agents(), pairs[k]); });
}

// ---- bake() gives what the loop over PoseShaper gives, for any number of threads, and names what it cannot make.

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
