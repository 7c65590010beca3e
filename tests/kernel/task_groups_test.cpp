// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>
#include <unistd.h>

#include <atomic>

#include "kernel/runtime/task_ranges.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/executors.hpp"
#include "tests/support/test.hpp"

// Queries inside of a caller's own tasks.

namespace bch {
namespace {

using test::CountingExecutor;

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
template <class Object, class RunQuery>
void expect_one_call_at_a_time(std::size_t questions, RunQuery run_query) {
  using Answer = Kept<typename decltype(run_query(std::declval<Object&>(), 0).values)::value_type>;
  std::vector<Answer> expected;
  for (std::size_t k = 0; k < questions; ++k) {
    Object object;
    expected.emplace_back(run_query(object, k));
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
      wrong += !(expected[k] == run_query(objects.local(), k));
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

#if !defined(BCH_SANITIZED)
/// A forked process has none of its parent's threads.
TEST_F(TaskGroups, AForkedProcessAnswers) {
  const test::Crowd crowd = people(20'000);
  const std::vector<Pair> pairs = test::candidate_pairs(set, crowd.agents());
  std::vector<std::uint8_t> expected(pairs.size()), answers(pairs.size());
  collide(set, crowd.agents(), pairs, expected);
  const auto answer_in_time = [&] {
    alarm(60);
    collide(set, crowd.agents(), pairs, answers);
    _exit(answers == expected ? 0 : 1);
  };
  EXPECT_EXIT(answer_in_time(), testing::ExitedWithCode(0), "");
}
#endif

// ---- A caller's own task system in place of TBB.

class Executors : public TaskGroups {
 protected:
  void TearDown() override { Executor::set({}); }
};

TEST_F(Executors, ChangeNoAnswer) {
  const test::Crowd crowd = people(20'000);
  const Agents agents = crowd.agents();
  const auto answers = [&] {
    Crowd finder;
    const Crowd::Pairs found = finder.collisions(set, agents);
    const std::vector<Pair> pairs(found.begin(), found.end());
    const Kept by_agent(found.by_agent());
    std::vector<float> distance(pairs.size());
    clearance(set, agents, pairs, {distance}, {.overlap = Overlap::deepest});
    return std::tuple(pairs, by_agent.offsets, distance);
  };
  const auto expected = answers();
  for (const bool on_threads : {false, true}) {
    CountingExecutor own{.on_threads = on_threads};
    Executor::set(own.executor());
    EXPECT_EQ(answers(), expected);
    EXPECT_GT(own.calls, 5u);
    EXPECT_GT(own.tasks, 3 * own.calls);
  }
}

TEST_F(Executors, CarryWhatTasksThrow) {
  test::Crowd crowd = people(5'000);
  std::vector<Pair> pairs = test::candidate_pairs(set, crowd.agents());
  crowd.shape[pairs.back().second] = 99;
  std::vector<std::uint8_t> hits(pairs.size());
  const auto run_query = [&] { collide(set, crowd.agents(), pairs, hits); };
  const std::string expected = test::complaint(run_query);
  CountingExecutor own;
  Executor::set(own.executor());
  EXPECT_EQ(test::complaint(run_query), expected);
  const auto fail = [](std::size_t, std::size_t) { throw std::runtime_error("a task fails"); };
  EXPECT_EQ(test::complaint<std::runtime_error>([&] { detail::for_ranges(100, 1, fail); }), "a task fails");
}

TEST_F(Executors, AreRefusedWithoutThreads) {
  for (const std::uint32_t threads : {0u, 1025u})
    EXPECT_EQ(test::complaint([&] {
                Executor::set({CountingExecutor::run, nullptr, threads});
              }),
              "executor: expected 1 to 1024 threads, found " + std::to_string(threads));
}

}  // namespace
}  // namespace bch
