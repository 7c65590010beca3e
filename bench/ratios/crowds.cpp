// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <malloc.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

#include <bch/crowd.hpp>

#include "bench/ratios/ratios.hpp"
#include "bench/workload/scene.hpp"
#include "layout/base/random.hpp"
#include "layout/hierarchy/builder.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"

namespace bch::bench {
namespace {

constexpr std::uint32_t agents_at_once = 50'000;
constexpr std::size_t pairs_at_once = 100'000;
/// Returns a line of /proc/self/status that counts kilobytes, in bytes; see proc(5).
std::size_t status_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return std::stoul(line.substr(name.size() + 1)) * 1024;
  throw std::runtime_error("/proc/self/status has no " + name);
}

/// Returns how much more memory the process occupies at most while it makes a call than it did before. Where the
/// system cannot reset the earlier peak, that peak counts: too much rather than too little.
template <class Call>
std::size_t peak_bytes(Call call) {
  malloc_trim(0);  // or memory that was given back would be taken again unseen
  std::ofstream("/proc/self/clear_refs") << "5\n";
  const std::size_t begin = status_bytes("VmRSS");
  call();
  const std::size_t peak = status_bytes("VmHWM");
  return peak > begin ? peak - begin : 0;
}

constexpr std::uint32_t few_agents = 10'000, many_agents = 1'000'000, small_crowds = 20;

/// All pairs of a large crowd in one call, by so many threads.
Contender all_at_once(Scene& scene, int threads) {
  const auto crowd = std::make_shared<Workload>(crowd_pairs(scene.set(), agents_at_once));
  crowd->pairs.resize(std::min(crowd->pairs.size(), pairs_at_once));
  Contender contender = collide_contender(scene.set(), scene.shapes(), *crowd);
  const auto arena = std::make_shared<tbb::task_arena>(threads);
  contender.call = [crowd, arena, call = contender.call] { arena->execute(call); };
  return contender;
}

/// The colliding pairs in calls of `most` or, where there are fewer, all; those left over aside.
Contender in_batches(Scene& scene, std::size_t most) {
  const Workload& workload = scene.workload("colliding");
  const std::size_t size = std::min(most, workload.pairs.size());
  const std::size_t used = workload.pairs.size() / size * size;
  const auto hits = std::make_shared<Hits>(scene.expected(Leaves::discs, workload));
  std::fill_n(hits->begin(), used, std::uint8_t{2});
  const auto call = [&set = scene.set(), &workload, hits, size, used] {
    const std::span<const Pair> pairs = workload.pairs;
    for (std::size_t i = 0; i < used; i += size)
      collide(set, workload.agents(), pairs.subspan(i, size), std::span(*hits).subspan(i, size), disc_query);
  };
  call();
  require_right("batches", workload, wrong_kernel(scene, workload, Leaves::discs, *hits));
  return {call, used};
}

/// What a simulator does in every step: finds the pairs and answers them. Several crowds in turn, because a
/// processor learns the branches of a small one.
struct Steps {
  const ShapeSet& set;
  std::vector<cli::Crowd> crowds;
  bch::Crowd finder;
  Hits hits;

  Steps(const ShapeSet& of, std::uint32_t agents, std::uint32_t count) : set(of) {
    for (std::uint32_t i = 0; i < count; ++i)
      crowds.push_back(cli::place_crowd(agents, agents_per_square_metre, set.shape_count(), crowd_seed + i));
  }

  std::span<const Pair> find_and_answer(const cli::Crowd& crowd) {
    const std::span<const Pair> pairs = finder.candidates(set, crowd.agents()).span();
    hits.resize(pairs.size());
    collide(set, crowd.agents(), pairs, hits, disc_query);
    return pairs;
  }
  void find_and_answer() {
    for (const cli::Crowd& crowd : crowds) find_and_answer(crowd);
  }
  void check(std::span<const Shape> shapes) {
    const baselines::Reference reference(shapes, {}, Leaves::discs);
    for (const cli::Crowd& crowd : crowds) {
      const std::span<const Pair> pairs = find_and_answer(crowd);
      const std::string wrong = wrong_answers(reference, crowd.agents(), pairs, hits);
      if (!wrong.empty()) throw std::runtime_error(fmt::format("crowd of {}: {}", crowd.size(), wrong));
    }
  }
};

/// Several small crowds, or a large one, checked after the first step, whose memory is reported.
Contender step_contender(Scene& scene, std::uint32_t agents, std::uint32_t crowds) {
  std::shared_ptr<Steps> steps;
  tbb::task_arena arena(2);
  const std::size_t bytes = peak_bytes([&] {
    steps = std::make_shared<Steps>(scene.set(), agents, crowds);
    arena.execute([&] { steps->find_and_answer(); });
  });
  const double mebibytes = static_cast<double>(bytes) / (1024 * 1024);
  arena.execute([&] { steps->check(scene.shapes()); });
  return {[steps] { steps->find_and_answer(); }, std::size_t{agents} * crowds, {{"MiB", mebibytes}}};
}

Contender pairs_contender(Scene& scene) {
  const auto steps = std::make_shared<Steps>(scene.set(), many_agents, 1);
  return {[steps] { steps->finder.candidates(steps->set, steps->crowds[0].agents()).span(); }, many_agents};
}

/// Copies of the scene's outlines, each stretched a little along x and y, on the grid: as different in memory as
/// further poses would be.
std::vector<Shape> stretched(std::span<const Shape> shapes, std::uint32_t count) {
  detail::Random random(17);
  detail::HierarchyBuilder builder;
  std::vector<Shape> copies(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    Outline& outline = copies[i].outline;
    outline = shapes[i % shapes.size()].outline;
    const double step = outline.grid_step, x = 0.9 + random.uniform(0.1), y = 0.9 + random.uniform(0.1);
    for (Vec2& p : outline.points)
      p = {static_cast<float>(std::round(x * static_cast<double>(p.x) / step) * step),
           static_cast<float>(std::round(y * static_cast<double>(p.y) / step) * step)};
    builder.contour(outline, leaf_threshold, detail::SplitRule::centroid, copies[i].hierarchy);
  }
  return copies;
}

Contender among_shapes(Scene& scene, std::uint32_t count) {
  const std::vector<Shape> shapes = stretched(scene.shapes(), count);
  const auto set = std::make_shared<const ShapeSet>(shapes);
  const auto crowd = std::make_shared<const Workload>(crowd_pairs(*set, few_agents));
  Contender contender = collide_contender(*set, shapes, *crowd);
  contender.call = [set, crowd, call = contender.call] { call(); };
  contender.counters["bytes"] = static_cast<double>(set->bytes()) / set->shape_count();
  return contender;
}

}  // namespace

void add_crowds(Scene& scene) {
  for (const int threads : {1, 2})  // by the same clock
    add(
        fmt::format("threads/{}", threads), [&scene, threads] { return all_at_once(scene, threads); }, 2);
  for (const std::size_t size : {16u, 512u})
    add(fmt::format("batches/{}", size), [&scene, size] { return in_batches(scene, size); });
  add(
      fmt::format("crowd/{}/step", few_agents),
      [&scene] { return step_contender(scene, few_agents, small_crowds); }, 2);
  add(
      fmt::format("crowd/{}/step", many_agents), [&scene] { return step_contender(scene, many_agents, 1); },
      2);
  add(
      fmt::format("crowd/{}/pairs", many_agents), [&scene] { return pairs_contender(scene); }, 2);
  for (const std::uint32_t count : {200u, 5'000u, 50'000u})
    add(fmt::format("shapes/{}", count), [&scene, count] { return among_shapes(scene, count); });
}

}  // namespace bch::bench
