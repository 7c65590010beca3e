// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <atomic>
#include <thread>

#include "kernel/collide/answer.hpp"
#include "kernel/crowd/neighbour_rows.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "tests/support/c_api_queries.hpp"
#include "tests/support/crowd_pairs.hpp"
#include "tests/support/test.hpp"

// For ThreadSanitizer: the functions that tasks run, and whole calls, which run on plain threads: TBB is not
// instrumented, so that all that passes through it would look like a race.

namespace bch {
namespace {

using test::expect_ok;
using test::made;

constexpr unsigned thread_count = 4;

/// Calls work(t) on threads that begin together.
template <class Work>
void on_threads(Work work, unsigned threads = thread_count) {
  std::atomic<unsigned> ready = 0;
  std::vector<std::thread> running;
  for (unsigned t = 0; t < threads; ++t)
    running.emplace_back([&, t] {
      ++ready;
      while (ready < threads) std::this_thread::yield();
      work(t);
    });
  for (std::thread& thread : running) thread.join();
}

void run_on_threads(void*, std::size_t count, void (*task)(void*, std::size_t), void* data) {
  on_threads([&](unsigned t) {
    for (std::size_t i = t; i < count; i += thread_count) task(data, i);
  });
}

[[maybe_unused]] const bool is_set = (Executor::set({run_on_threads, nullptr, thread_count}),
                                      bch_set_executor(run_on_threads, nullptr, thread_count) == BCH_OK);

class Threads : public testing::Test {
 protected:
  std::vector<Shape> shapes = test::synthetic_shapes(41, 16);
  ShapeSet set{shapes, {{0, 3, all_depths}, true}};
  test::Random random{42};
  test::PairScene scene = random_scene(random, set, 4'999);
  Agents agents = scene.crowd.agents();

  std::vector<std::uint8_t> answers(const Implementation& implementation, unsigned threads) {
    std::vector<std::uint8_t> hits(scene.pairs.size());
    detail::Arguments arguments = detail::arguments_for(set.view(), agents, scene.pairs);
    arguments.states = hits.data();
    const std::size_t n = hits.size();
    on_threads(
        [&](unsigned t) {
          detail::answer(implementation, arguments, n * t / threads, n * (t + 1) / threads);
        },
        threads);
    return hits;
  }
};

TEST_F(Threads, RangesOfOneBatchDoNotMeet) {
  for (const Implementation& implementation : test::supported()) {
    const auto alone = answers(implementation, 1);
    for (const unsigned threads : {2u, 3u, 8u})
      EXPECT_EQ(answers(implementation, threads), alone) << implementation.name;
  }
}

TEST_F(Threads, DifferentShapesAreReplacedAtTheSameTime) {
  DynamicShapeSet dynamic(set);
  on_threads([&](unsigned t) {
    BuiltShape prepared(set.plan());
    for (std::uint32_t shape = t; shape < set.shape_count(); shape += thread_count) {
      prepared.prepare(shapes[shape], shape);
      EXPECT_TRUE(dynamic.try_replace(shape, prepared));
    }
  });
  const auto expected = answers(best_implementation(), 1);
  set = ShapeSet(dynamic.set().arrays(), nullptr);
  EXPECT_EQ(answers(best_implementation(), 1), expected);
}

TEST_F(Threads, RowsOfNeighboursAreFilledAtTheSameTime) {
  const std::vector<Pair> pairs = test::all_pairs(200);
  std::vector<std::uint64_t> begin(201);
  std::vector<bch::Crowd::Neighbour> neighbours(200 * 199);
  const detail::NeighbourRows rows{pairs, begin, neighbours};
  const auto in_parts = [](std::size_t count, auto work) {
    on_threads([&](unsigned t) { work(count * t / thread_count, count * (t + 1) / thread_count); });
  };
  in_parts(pairs.size(), [&](std::size_t first, std::size_t last) { rows.count(first, last); });
  EXPECT_EQ(rows.accumulate(), neighbours.size());
  in_parts(pairs.size(), [&](std::size_t first, std::size_t last) { rows.fill(first, last); });
  in_parts(200, [&](std::size_t first, std::size_t last) { rows.sort(first, last); });
  for (std::uint32_t i = 0; i < 200; ++i)
    for (std::uint32_t k = 0; k < 199; ++k) {
      const bch::Crowd::Neighbour& neighbour = neighbours[begin[i] + k];
      const Pair pair = pairs[neighbour.pair];
      ASSERT_EQ(neighbour.agent, k + (k >= i)) << i;
      ASSERT_TRUE(pair.first == std::min(i, neighbour.agent) && pair.second == std::max(i, neighbour.agent));
    }
}

// ---- The C interface from several threads at once, for ThreadSanitizer. Threads are the caller's.

class CApiThreads : public testing::Test {
 protected:
  const ShapeSet shapes{test::synthetic_shapes(291, 8), {{0, 3, all_depths}, true}};
  test::Random random{292};
  const test::PairScene pairs = random_scene(random, shapes, 499);
  test::CScene scene{shapes, pairs.crowd, pairs.pairs};
  const bch_shape_set* const set = scene.set.get();

  /// What a thread learns by objects of its own of a set that all share.
  std::string learn() const {
    std::string all;
    for (const test::CQuery& query : all_queries(scene)) {
      expect_ok(query.run_query());
      all += query.answers();
    }
    return all;
  }
};

TEST_F(CApiThreads, AnExecutorIsCalled) {
  std::atomic<std::size_t> calls = 0;
  const auto count_calls = [](void* user, std::size_t count, bch_task task, void* data) {
    ++*static_cast<std::atomic<std::size_t>*>(user);
    run_on_threads(nullptr, count, task, data);
  };
  const std::string expected = learn();
  expect_ok(bch_set_executor(count_calls, &calls, 2));
  EXPECT_TRUE(learn() == expected);
  EXPECT_GT(calls, 0u);
  EXPECT_EQ(bch_set_executor(count_calls, &calls, 0), BCH_INVALID_ARGUMENT);
  expect_ok(bch_set_executor(run_on_threads, nullptr, thread_count));
}

/// Of either leaves and overlaps, while one of them builds a set.
TEST_F(CApiThreads, AnswersAreThoseOfOneThread) {
  for (const bool other : {false, true}) {
    scene.options.leaves = other, scene.options.overlap = other, scene.options.distance_leaves = !other;
    const std::string alone = learn();
    std::vector<std::string> learned(thread_count);
    on_threads([&](unsigned t) {
      if (t == 0) {
        EXPECT_GT(ShapeSet(test::synthetic_shapes(41, 16)).bytes(), 0u);
      }
      learned[t] = learn();
    });
    for (const std::string& one : learned) EXPECT_TRUE(one == alone);
  }
}

/// Discs of a set that a thread builds by itself, of which it replaces nothing.
std::vector<float> built(float radius) {
  const auto builder = test::c_builder();
  expect_ok(bch_shape_set_builder_add_cylinder(builder.get(), radius, nullptr));
  const bch_vec2 corners[] = {{-radius, 0}, {radius, 0}, {0, radius}};
  const std::uint64_t offsets[] = {0, 3};
  expect_ok(bch_shape_set_builder_add_polygons(builder.get(), corners, offsets, 1, nullptr));
  const auto set = test::finished(builder);
  const auto dynamic = made<bch_dynamic_shape_set_free>(bch_dynamic_shape_set_create, set.get());
  const bch_shape_set* lent = nullptr;
  expect_ok(bch_dynamic_shape_set_get_shapes(dynamic.get(), &lent));
  std::vector<float> radii(2);
  for (std::uint32_t shape = 0; shape < 2; ++shape)
    expect_ok(bch_shape_set_get_radius(lent, shape, &radii[shape]));
  return radii;
}

/// All objects are in one registry.
TEST_F(CApiThreads, ObjectsAreMadeAndFreedAtTheSameTime) {
  std::vector<std::vector<float>> alone(thread_count), together(thread_count);
  for (unsigned t = 0; t < thread_count; ++t) alone[t] = built(0.25f + 0.125f * static_cast<float>(t));
  EXPECT_NE(alone[0], alone[1]);
  on_threads([&](unsigned t) {
    for (int i = 0; i < 20; ++i) {
      together[t] = built(0.25f + 0.125f * static_cast<float>(t));
      const auto crowd = made<bch_crowd_free>(bch_crowd_create, nullptr);
    }
  });
  EXPECT_EQ(together, alone);
}

/// What one thread made others use, and another frees.
TEST_F(CApiThreads, ObjectsGoFromThreadToThread) {
  std::vector<bch_obstacles*> of(thread_count);
  std::vector<std::vector<std::uint8_t>> hits(thread_count, std::vector<std::uint8_t>(scene.agents.count));
  const auto text = [](unsigned t) { return "LINESTRING(-20 0, 20 " + std::to_string(t) + ")"; };
  on_threads([&](unsigned t) {
    expect_ok(bch_obstacles_from_wkt(text(t).c_str(), 0, -HUGE_VAL, HUGE_VAL, &of[t]));
  });
  on_threads([&](unsigned t) {
    expect_ok(bch_obstacles_collide(set, &scene.agents, of[0], nullptr, hits[t].data()));
  });
  on_threads([&](unsigned t) { expect_ok(bch_obstacles_free(of[thread_count - 1 - t])); });
  for (unsigned t = 0; t < thread_count; ++t) {
    EXPECT_EQ(hits[t], hits[0]);
    EXPECT_EQ(bch_obstacles_free(of[t]), BCH_INVALID_ARGUMENT);
  }
}

/// Of threads that free one object at the same time, one does, and the others are told that it is not a live object.
TEST_F(CApiThreads, OneOfThemFreesAnObject) {
  const auto expect_one = [](auto* object, auto* free) {
    std::vector<bch_status> said(thread_count);
    on_threads([&](unsigned t) { said[t] = free(object); });
    std::sort(said.begin(), said.end());
    std::vector<bch_status> one(thread_count, BCH_INVALID_ARGUMENT);
    one[0] = BCH_OK;
    EXPECT_EQ(said, one);
  };
  for (int i = 0; i < 300; ++i) {
    expect_one(made<bch_crowd_free>(bch_crowd_create, nullptr).release(), bch_crowd_free);
    expect_one(test::c_set(shapes).release(), bch_shape_set_free);
    expect_one(made<bch_dynamic_shape_set_free>(bch_dynamic_shape_set_create, set).release(),
               bch_dynamic_shape_set_free);
  }
}

TEST_F(CApiThreads, EachThreadHasItsLastError) {
  std::vector<std::string> errors(thread_count);
  on_threads([&](unsigned t) {
    float radius = 0;
    for (std::uint32_t i = 0; i < 100; ++i)
      EXPECT_EQ(bch_shape_set_get_radius(set, 1'000 + t, &radius), BCH_OUT_OF_RANGE);
    errors[t] = bch_last_error();
  });
  for (unsigned t = 0; t < thread_count; ++t)
    EXPECT_NE(errors[t].find(std::to_string(1'000 + t)), std::string::npos) << errors[t];
}

}  // namespace
}  // namespace bch
