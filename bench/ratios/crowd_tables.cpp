// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <memory>
#include <stdexcept>

#include <bch/broad_phase.hpp>

#include "bench/base/peak_memory.hpp"
#include "bench/base/text.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/answer_checks.hpp"

namespace bch::bench {
namespace {

constexpr std::uint32_t few = 10'000, many = 1'000'000;  ///< agents
constexpr std::uint32_t small_crowds = 20;
constexpr double most_nanoseconds = 120, most_times = 1.3, most_mebibytes = 1024;

/// What a simulator does in every step: finds the pairs and answers them. Several crowds in turn, because a
/// processor learns the branches of a small one.
class Steps {
 public:
  Steps(const ShapeSet& set, std::uint32_t agents, std::uint32_t crowds) : set_(set) {
    for (std::uint32_t i = 0; i < crowds; ++i)
      crowds_.push_back(cli::place_crowd(agents, agents_per_square_metre, set.shape_count(), crowd_seed + i));
  }

  void find() {
    for (const cli::Crowd& crowd : crowds_) broad_phase_.find(set_, crowd.agents());
  }

  void find_and_answer() {
    for (const cli::Crowd& crowd : crowds_) find_and_answer(crowd);
  }

  /// Throws std::runtime_error if a pair is not answered as the reference does.
  void check(const baselines::Reference& reference) {
    for (const cli::Crowd& crowd : crowds_) {
      const std::span<const Pair> pairs = find_and_answer(crowd);
      const std::string wrong = wrong_answers(reference, crowd.agents(), pairs, hits_, Semantics::boundary);
      if (!wrong.empty()) throw std::runtime_error(fmt::format("crowd of {}: {}", crowd.size(), wrong));
    }
  }

 private:
  std::span<const Pair> find_and_answer(const cli::Crowd& crowd) {
    const std::span<const Pair> pairs = broad_phase_.find(set_, crowd.agents());
    hits_.resize(pairs.size());
    collide(set_, crowd.agents(), pairs, hits_, disc_query);
    return pairs;
  }

  const ShapeSet& set_;
  std::vector<cli::Crowd> crowds_;
  BroadPhase broad_phase_;
  Hits hits_;
};

/// Several small crowds, or a large one, checked after the first step, whose memory is told.
Contender step_contender(Scene& scene, std::uint32_t agents, std::uint32_t crowds) {
  const PeakMemory memory;
  const auto steps = std::make_shared<Steps>(scene.set(), agents, crowds);
  tbb::task_arena arena(2);
  arena.execute([&] { steps->find_and_answer(); });
  const double mebibytes = static_cast<double>(memory.bytes()) / (1024 * 1024);
  const baselines::Reference reference(scene.shapes(), {}, Leaves::discs);
  arena.execute([&] { steps->check(reference); });
  return {[steps] { steps->find_and_answer(); }, std::size_t{agents} * crowds, {{"MiB", mebibytes}}};
}

Contender pairs_contender(Scene& scene) {
  const auto steps = std::make_shared<Steps>(scene.set(), many, 1);
  return {[steps] { steps->find(); }, many};
}

void print_crowds(const Results& results) {
  const Timing &small = results.at("crowd/10000/step"), &large = results.at("crowd/1000000/step");
  const double times = large.nanoseconds / small.nanoseconds, mebibytes = large.counters.at("MiB");
  fmt::print(
      "an agent of a crowd of {}, pairs and answers, 2 threads: {:.1f} ns ({:.1f} for pairs)   {}, aim 50\n",
      cli::grouped(many), large.nanoseconds, results.at("crowd/1000000/pairs").nanoseconds,
      verdict_at_most(large.nanoseconds, most_nanoseconds));
  fmt::print("the same over one of {}: {:.1f} ns over {:.1f}: {:.2f} x   {}\n", cli::grouped(few),
             large.nanoseconds, small.nanoseconds, times, verdict_at_most(times, most_times));
  fmt::print("memory of {} agents, their pairs, answers and all scratch: {:.0f} MiB   {}\n",
             cli::grouped(many), mebibytes, verdict_at_most(mebibytes, most_mebibytes));
}

}  // namespace

std::vector<Table> crowd_tables(Suite& suite, Scene& scene) {
  suite.add(
      "crowd/10000/step", [&scene] { return step_contender(scene, few, small_crowds); }, 2);
  suite.add(
      "crowd/1000000/step", [&scene] { return step_contender(scene, many, 1); }, 2);
  suite.add(
      "crowd/1000000/pairs", [&scene] { return pairs_contender(scene); }, 2);
  return {{"crowd", "^crowd/", print_crowds}};
}

}  // namespace bch::bench
