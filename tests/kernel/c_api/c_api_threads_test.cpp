// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/c_api.hpp"
#include "tests/support/scenes.hpp"

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

/// What a thread learns by objects of its own of a set that all share.
struct Learned {
  std::vector<std::uint8_t> hits, near;
  std::vector<float> distance, times, from_walls;
  std::vector<double> depths;
  std::vector<std::uint32_t> neighbours, touched;
  std::vector<std::uint64_t> begin;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> candidates, contacts;
  friend bool operator==(const Learned&, const Learned&) = default;
};

class CApiThreads : public testing::Test {
 protected:
  const ShapeSet shapes{test::synthetic_shapes(291, 8), {{0, 3, all_depths}, true}};
  const test::OwnedSet set = test::c_set(shapes);
  test::Random random{292};
  const test::PairScene scene = random_scene(random, shapes, 499);
  const bch_agents agents = test::c_agents(scene.crowd);
  const test::OwnedObstacles walls = made<test::OwnedObstacles>([](bch_obstacles** to) {
    return bch_obstacles_from_wkt("LINESTRING(-20 0, 20 1) POLYGON((-2 -2, 2 -2, 2 2, -2 2))", 0, to);
  });
  const std::size_t count = scene.pairs.size();

  void learn_of_pairs(Learned& to) const {
    const bch_pair* const pairs = test::c_pairs(scene.pairs);
    const std::vector<double> way(count, 0.5);
    to.hits.resize(count), to.near.resize(count), to.distance.resize(count), to.times.resize(count);
    std::vector<bch_penetration_depth> depths(count);
    bch_clearance_out out = BCH_CLEARANCE_OUT_INIT;
    out.distance = to.distance.data();
    expect_ok(bch_validate_agents(set.get(), &agents));
    expect_ok(bch_collide(set.get(), &agents, pairs, count, nullptr, to.hits.data()));
    expect_ok(bch_within(set.get(), &agents, pairs, count, way.data(), 1, nullptr, to.near.data()));
    expect_ok(bch_clearance(set.get(), &agents, pairs, count, nullptr, &out));
    expect_ok(bch_penetration(set.get(), &agents, pairs, count, 8, nullptr, depths.data()));
    expect_ok(bch_time_of_impact(set.get(), &agents, pairs, count, way.data(), way.data(), nullptr,
                                 to.times.data()));
    for (const bch_penetration_depth& one : depths)
      to.depths.push_back(one.depth), to.depths.push_back(one.x), to.depths.push_back(one.y);
  }

  void learn_of_crowd(Learned& to) const {
    const auto phase = made<test::OwnedBroadPhase>(bch_broad_phase_create);
    const bch_pair* pairs = nullptr;
    std::size_t found = 0;
    expect_ok(bch_broad_phase_find(phase.get(), set.get(), &agents, 0.2, nullptr, &pairs, &found));
    for (std::size_t i = 0; i < found; ++i) to.candidates.emplace_back(pairs[i].first, pairs[i].second);

    const auto collider = made<test::OwnedCollider>(bch_crowd_collider_create);
    bch_index_rows rows, touched;
    expect_ok(bch_crowd_collider_collide_all(collider.get(), set.get(), &agents, walls.get(), nullptr, &rows,
                                             &touched));
    to.begin.assign(rows.offsets, rows.offsets + rows.rows + 1);
    to.neighbours.assign(rows.values, rows.values + rows.offsets[rows.rows]);
    to.touched.assign(touched.values, touched.values + touched.offsets[touched.rows]);

    const auto finder = made<test::OwnedFinder>(bch_contact_finder_create);
    bch_contact_rows contacts;
    expect_ok(bch_contact_finder_find_all(finder.get(), set.get(), &agents, nullptr, &contacts));
    for (std::uint64_t i = 0; i < contacts.offsets[contacts.rows]; ++i)
      to.contacts.emplace_back(contacts.values[i].first, contacts.values[i].second);

    to.from_walls.resize(agents.count);
    bch_clearance_out out = BCH_CLEARANCE_OUT_INIT;
    out.distance = to.from_walls.data();
    expect_ok(bch_obstacles_clearance(set.get(), &agents, walls.get(), nullptr, &out));
  }

  Learned learn() const {
    Learned all;
    learn_of_pairs(all);
    learn_of_crowd(all);
    return all;
  }
};

TEST_F(CApiThreads, AnswersAreThoseOfOneThread) {
  const Learned alone = learn();
  EXPECT_GT(alone.neighbours.size(), count / 2);
  EXPECT_GT(alone.touched.size(), 0u);
  EXPECT_GT(alone.contacts.size(), count / 2);
  std::vector<Learned> learned(thread_count);
  on_threads([&](unsigned t) { learned[t] = learn(); });
  for (const Learned& one : learned) EXPECT_EQ(one, alone);
}

/// Discs of a set that a thread builds by itself, of which it replaces nothing.
std::vector<float> built(float radius) {
  const auto builder = made<test::OwnedBuilder>(
      [](bch_shape_set_builder** to) { return bch_shape_set_builder_create(nullptr, to); });
  expect_ok(bch_shape_set_builder_add_cylinder(builder.get(), radius, nullptr));
  const bch_vec2 corners[] = {{-radius, 0}, {radius, 0}, {0, radius}};
  const std::uint64_t offsets[] = {0, 3};
  expect_ok(bch_shape_set_builder_add_polygons(builder.get(), corners, offsets, 1, nullptr));
  const auto set = made<test::OwnedSet>(
      [&](bch_shape_set** to) { return bch_shape_set_builder_finish(builder.get(), to); });
  const auto dynamic = made<test::OwnedDynamicSet>(
      [&](bch_dynamic_shape_set** to) { return bch_dynamic_shape_set_create(set.get(), to); });
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
      const auto phase = made<test::OwnedBroadPhase>(bch_broad_phase_create);
      const auto collider = made<test::OwnedCollider>(bch_crowd_collider_create);
      const auto finder = made<test::OwnedFinder>(bch_contact_finder_create);
    }
  });
  EXPECT_EQ(together, alone);
}

/// What one thread made others use, and another frees.
TEST_F(CApiThreads, ObjectsGoFromThreadToThread) {
  std::vector<bch_obstacles*> of(thread_count);
  std::vector<std::vector<std::uint8_t>> hits(thread_count, std::vector<std::uint8_t>(agents.count));
  const auto text = [](unsigned t) { return "LINESTRING(-20 0, 20 " + std::to_string(t) + ")"; };
  on_threads([&](unsigned t) { expect_ok(bch_obstacles_from_wkt(text(t).c_str(), 0, &of[t])); });
  on_threads([&](unsigned t) {
    expect_ok(bch_obstacles_collide(set.get(), &agents, of[0], nullptr, hits[t].data()));
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
    expect_one(made<test::OwnedFinder>(bch_contact_finder_create).release(), bch_contact_finder_free);
    expect_one(test::c_set(shapes).release(), bch_shape_set_free);
    const auto dynamic = [&](bch_dynamic_shape_set** to) {
      return bch_dynamic_shape_set_create(set.get(), to);
    };
    expect_one(made<test::OwnedDynamicSet>(dynamic).release(), bch_dynamic_shape_set_free);
  }
}

TEST_F(CApiThreads, EachThreadHasItsLastError) {
  std::vector<std::string> errors(thread_count);
  on_threads([&](unsigned t) {
    float radius = 0;
    for (std::uint32_t i = 0; i < 100; ++i)
      EXPECT_EQ(bch_shape_set_get_radius(set.get(), 1'000 + t, &radius), BCH_OUT_OF_RANGE);
    errors[t] = bch_last_error();
  });
  for (unsigned t = 0; t < thread_count; ++t)
    EXPECT_NE(errors[t].find(std::to_string(1'000 + t)), std::string::npos) << errors[t];
}

}  // namespace
}  // namespace bch
