// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "kernel/answer.hpp"
#include "kernel/neighbour_rows.hpp"
#include "layout/dynamic_shape_set.hpp"
#include "tests/scenes.hpp"

// The functions that tasks run, on plain threads, where ThreadSanitizer sees every access. (It takes what
// passes through an uninstrumented TBB for races, so collide() itself cannot be watched.)

namespace bch {
namespace {

class Threads : public testing::Test {
 protected:
  std::vector<Shape> shapes = test::synthetic_shapes(41, 16);
  ShapeSet set{shapes, {{0, 3, all_depths}, true}};
  test::Random random{42};
  test::PairScene scene = random_scene(random, set, 6'001);
  Agents agents = scene.crowd.agents();

  std::vector<std::uint8_t> answers(const kernel::Implementation& implementation, unsigned threads) {
    const ShapeSetView view = set.view();
    std::vector<std::uint8_t> hits(scene.pairs.size());
    const kernel::Arguments arguments{&view,
                                      agents.shape.data(),
                                      agents.x.data(),
                                      agents.y.data(),
                                      agents.heading.data(),
                                      agents.level.data(),
                                      scene.pairs.data(),
                                      hits.data(),
                                      true};
    std::vector<std::thread> running;
    for (unsigned t = 0; t < threads; ++t)
      running.emplace_back([&, t] {
        const std::size_t n = hits.size();
        kernel::answer(implementation, arguments, agents, n * t / threads, n * (t + 1) / threads);
      });
    for (std::thread& thread : running) thread.join();
    return hits;
  }
};

TEST_F(Threads, RangesOfOneBatchDoNotMeet) {
  for (const auto& implementation : kernel::implementations()) {
    if (!implementation.supported()) continue;
    const auto alone = answers(implementation, 1);
    for (const unsigned threads : {2u, 3u, 8u})
      EXPECT_EQ(answers(implementation, threads), alone) << implementation.name;
  }
}

TEST_F(Threads, ASetIsReadWhileAnotherIsBuilt) {
  const auto expected = answers(kernel::implementation("sse2"), 1);
  std::vector<std::uint8_t> first, second;
  std::thread reader([&] { first = answers(kernel::implementation("sse2"), 2); });
  std::thread other_reader([&] { second = answers(kernel::best_implementation(), 2); });
  std::size_t bytes = 0;
  std::thread builder([&] { bytes = ShapeSet(shapes, {{0, all_depths}, true}).bytes(); });
  reader.join();
  other_reader.join();
  builder.join();
  EXPECT_EQ(first, expected);
  EXPECT_EQ(second, expected);
  EXPECT_GT(bytes, 0u);
}

TEST_F(Threads, DifferentShapesAreReplacedAtTheSameTime) {
  DynamicShapeSet dynamic(set);
  std::vector<std::thread> running;
  for (std::uint32_t t = 0; t < 4; ++t)
    running.emplace_back([&, t] {
      ShapeFlattener flattener(set.plan());
      FlatShape flat;
      for (std::uint32_t shape = t; shape < set.shape_count(); shape += 4) {
        flattener.flatten(shapes[shape], shape, flat);
        EXPECT_TRUE(dynamic.try_replace(shape, flat));
      }
    });
  for (std::thread& thread : running) thread.join();
  const auto expected = answers(kernel::best_implementation(), 1);
  set = ShapeSet(dynamic.set().arrays(), nullptr);
  EXPECT_EQ(answers(kernel::best_implementation(), 1), expected);
}

TEST_F(Threads, RowsOfNeighboursAreFilledAtTheSameTime) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < 200; ++i)
    for (std::uint32_t j = i + 1; j < 200; ++j) pairs.push_back({i, j});
  const std::vector<std::uint8_t> hits(pairs.size(), 1);
  std::vector<std::uint64_t> begin(201);
  std::vector<std::uint32_t> neighbours(200 * 199);
  const kernel::NeighbourRows rows{pairs, hits, begin, neighbours};
  const auto in_parts = [](std::size_t count, auto work) {
    std::vector<std::thread> running;
    for (std::size_t t = 0; t < 4; ++t)
      running.emplace_back([=] { work(count * t / 4, count * (t + 1) / 4); });
    for (std::thread& thread : running) thread.join();
  };
  in_parts(pairs.size(), [&](std::size_t first, std::size_t last) { rows.count(first, last); });
  EXPECT_EQ(rows.place(), neighbours.size());
  in_parts(pairs.size(), [&](std::size_t first, std::size_t last) { rows.fill(first, last); });
  in_parts(200, [&](std::size_t first, std::size_t last) { rows.sort(first, last); });
  for (std::uint32_t i = 0; i < 200; ++i)
    for (std::uint32_t k = 0; k < 199; ++k) ASSERT_EQ(neighbours[begin[i] + k], k + (k >= i)) << i;
}

}  // namespace
}  // namespace bch
