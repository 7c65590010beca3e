// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <atomic>
#include <thread>

#include "tests/support/c_api_queries.hpp"
#include "tests/support/test.hpp"

// The C interface from several threads at once, for ThreadSanitizer. Threads are the caller's: what the library gives to
// TBB runs on tests/support/plain_threads, as for threads_test.cpp.

namespace bch {
namespace {

using test::expect_ok;
using test::made;

constexpr unsigned thread_count = 4;

/// Calls work(t) on threads that begin together.
template <class Work>
void on_threads(Work work) {
  std::atomic<unsigned> ready = 0;
  std::vector<std::thread> running;
  for (unsigned t = 0; t < thread_count; ++t)
    running.emplace_back([&, t] {
      ++ready;
      while (ready < thread_count) std::this_thread::yield();
      work(t);
    });
  for (std::thread& thread : running) thread.join();
}

class CApiThreads : public testing::Test {
 protected:
  const ShapeSet shapes{test::synthetic_shapes(291, 8), {{0, 3, all_depths}, true}};
  test::Random random{292};
  const test::PairScene pairs = random_scene(random, shapes, 499);
  const test::CScene scene{shapes, pairs.crowd, pairs.pairs};
  const bch_shape_set* const set = scene.set.get();

  /// What a thread learns by objects of its own of a set that all share.
  std::string learn() const {
    std::string all;
    for (const test::CQuery& query : all_queries(scene)) {
      expect_ok(query.ask());
      all += query.answers();
    }
    return all;
  }
};

TEST_F(CApiThreads, AnswersAreThoseOfOneThread) {
  const std::string alone = learn();
  std::vector<std::string> learned(thread_count);
  on_threads([&](unsigned t) { learned[t] = learn(); });
  for (const std::string& one : learned) EXPECT_TRUE(one == alone);
}

/// Discs of a set that a thread builds by itself, of which it replaces nothing.
std::vector<float> built(float radius) {
  const auto builder = made<bch_shape_set_builder_free>(bch_shape_set_builder_create, nullptr);
  expect_ok(bch_shape_set_builder_add_cylinder(builder.get(), radius, nullptr));
  const bch_vec2 corners[] = {{-radius, 0}, {radius, 0}, {0, radius}};
  const std::uint64_t offsets[] = {0, 3};
  expect_ok(bch_shape_set_builder_add_polygons(builder.get(), corners, offsets, 1, nullptr));
  const auto set = made<bch_shape_set_free>(bch_shape_set_builder_finish, builder.get());
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
  on_threads([&](unsigned t) { expect_ok(bch_obstacles_from_wkt(text(t).c_str(), 0, &of[t])); });
  on_threads([&](unsigned t) {
    expect_ok(bch_obstacles_collide(set, &scene.agents, of[0], nullptr, hits[t].data()));
  });
  on_threads([&](unsigned t) { expect_ok(bch_obstacles_free(of[thread_count - 1 - t])); });
  for (unsigned t = 0; t < thread_count; ++t) {
    EXPECT_EQ(hits[t], hits[0]);
    EXPECT_EQ(bch_obstacles_free(of[t]), BCH_INVALID_ARGUMENT);
  }
}

/// Of threads that free one object at the same time, one does, and the others are told that it is no living object.
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
