// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <cstdio>
#include <stdexcept>

#include "bench/base/peak_memory.hpp"
#include "bench/base/text.hpp"
#include "bench/ratios/ratios.hpp"
#include "bench/workload/answer_checks.hpp"
#include "bench/workload/race.hpp"
#include "kernel/broad_phase/broad_phase.hpp"

namespace bch::bench {
namespace {

constexpr std::uint32_t few = 10'000, many = 1'000'000;  ///< agents
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

}  // namespace

void print_crowd_ratios(Scene& scene, std::uint32_t runs) {
  const ShapeSet& set = scene.set();
  constexpr std::uint32_t small_crowds = 20;
  Steps small(set, few, small_crowds);
  const PeakMemory memory;
  Steps large(set, many, 1);
  tbb::task_arena(2).execute([&] { large.find_and_answer(); });
  const double mebibytes = static_cast<double>(memory.bytes()) / (1024 * 1024);
  const baselines::Reference reference(scene.shapes(), {}, Leaves::discs);
  small.check(reference);
  tbb::task_arena(2).execute([&] { large.check(reference); });

  std::vector<Contender> steps = {{"small", [&] { small.find_and_answer(); }},
                                  {"large", [&] { large.find_and_answer(); }},
                                  {"large, pairs", [&] { large.find(); }}};
  race(steps, runs, 2);
  const double of_few = steps[0].nanoseconds / (few * small_crowds);
  const double of_many = steps[1].nanoseconds / many, pairs = steps[2].nanoseconds / many;
  fmt::print(
      "an agent of a crowd of {}, pairs and answers, 2 threads: {:.1f} ns ({:.1f} for pairs)   {}, aim 50\n",
      cli::grouped(many), of_many, pairs, verdict_at_most(of_many, most_nanoseconds));
  fmt::print("the same over one of {}: {:.1f} ns over {:.1f}: {:.2f} x   {}\n", cli::grouped(few), of_many,
             of_few, of_many / of_few, verdict_at_most(of_many / of_few, most_times));
  fmt::print("memory of {} agents, their pairs, answers and all scratch: {:.0f} MiB   {}\n",
             cli::grouped(many), mebibytes, verdict_at_most(mebibytes, most_mebibytes));
  std::fflush(stdout);
}

}  // namespace bch::bench
