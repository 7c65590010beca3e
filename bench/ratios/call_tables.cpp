// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "bench/base/text.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/answer_checks.hpp"

namespace bch::bench {
namespace {

constexpr std::uint32_t many_agents = 50'000;
constexpr std::size_t many_pairs = 100'000, small_batch = 16, large_batch = 512;

/// All pairs of a large crowd in one call, by so many threads.
Contender all_at_once(Scene& scene, int threads) {
  const auto crowd = std::make_shared<Workload>(crowd_pairs(scene.set(), many_agents));
  crowd->pairs.resize(std::min(crowd->pairs.size(), many_pairs));
  const auto hits = std::make_shared<Hits>(crowd->pairs.size());
  const auto arena = std::make_shared<tbb::task_arena>(threads);
  const auto call = [&set = scene.set(), crowd, hits, arena] {
    arena->execute([&] { collide(set, crowd->agents(), crowd->pairs, *hits, disc_query); });
  };
  call();
  require_right("threads", *crowd,
                wrong_answers({scene.shapes(), {}, Leaves::discs}, crowd->agents(), crowd->pairs, *hits,
                              Semantics::boundary));
  return {call, hits->size()};
}

/// The colliding pairs in calls of `most` or, where there are fewer, all; those left over aside.
Contender in_batches(Scene& scene, std::size_t most) {
  const Workload& workload = scene.workload("colliding");
  const std::size_t size = std::min(most, workload.pairs.size());
  const std::size_t asked = workload.pairs.size() / size * size;
  const auto hits = std::make_shared<Hits>(workload.pairs.size());
  const auto call = [&set = scene.set(), &workload, hits, size, asked] {
    const std::span<const Pair> pairs = workload.pairs;
    for (std::size_t i = 0; i < asked; i += size)
      collide(set, workload.agents(), pairs.subspan(i, size), std::span(*hits).subspan(i, size), disc_query);
  };
  call();
  Hits complete = scene.expected(disc_query, workload);
  std::copy_n(hits->begin(), asked, complete.begin());
  require_right("batches", workload, wrong_kernel(scene, workload, disc_query, complete));
  return {call, asked};
}

void print_calls(const Results& results) {
  const Timing &one = results.at("threads/1"), &two = results.at("threads/2");
  const double gain = one.nanoseconds / two.nanoseconds;
  fmt::print("2 threads over 1: crowd, {} pairs: {:.2f} x   {}\n", cli::grouped(one.items), gain,
             verdict(gain, 1.9));
  const double small = results.at("batches/16").nanoseconds, large = results.at("batches/512").nanoseconds;
  fmt::print("a pair in batches of 16 over 512: colliding: {:.1f} ns over {:.1f}: {:.2f} x   {}\n", small,
             large, small / large, verdict_at_most(small / large, 1.6));
}

}  // namespace

std::vector<Table> call_tables(Suite& suite, Scene& scene) {
  for (const int threads : {1, 2})  // by the same clock
    suite.add(
        fmt::format("threads/{}", threads), [&scene, threads] { return all_at_once(scene, threads); }, 2);
  for (const std::size_t size : {small_batch, large_batch})
    suite.add(fmt::format("batches/{}", size), [&scene, size] { return in_batches(scene, size); });
  return {{"calls", "^(threads|batches)/", print_calls}};
}

}  // namespace bch::bench
