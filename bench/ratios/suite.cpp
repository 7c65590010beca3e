// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/ratios/suite.hpp"

#include <benchmark/benchmark.h>
#include <oneapi/tbb/task_arena.h>

#include <stdexcept>
#include <vector>

#include "bench/base/median.hpp"

namespace bch::bench {
namespace {

constexpr const char* per_item = "per_item";  ///< seconds

/// Times a call in an arena of its own size: with one thread, the caller's time is then all of the time that
/// the call takes. Other threads are woken first, which takes about a millisecond and does not happen between
/// the frames of a simulation.
void time_calls(benchmark::State& state, const Contender& contender, int threads) {
  tbb::task_arena arena(threads);
  if (threads > 1) arena.execute(contender.call);
  for ([[maybe_unused]] auto _ : state) arena.execute(contender.call);
  using benchmark::Counter;
  state.counters[per_item] = Counter(static_cast<double>(contender.items),
                                     Counter::Flags(Counter::kIsIterationInvariantRate | Counter::kInvert));
  for (const auto& [name, value] : contender.counters) state.counters[name] = value;
}

/// Keeps what each repetition took instead of printing it.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      const std::string& name = run.run_name.function_name;
      taken_[name].push_back(1e9 * run.counters.at(per_item));
      for (const auto& [counter, value] : run.counters) results[name].counters[counter] = value;
      results[name].nanoseconds = cli::median(taken_[name]);
    }
  }

  Results results;

 private:
  std::map<std::string, std::vector<double>> taken_;
};

}  // namespace

void Suite::add(const std::string& name, std::function<Contender()> make, int threads) {
  auto* const added = benchmark::RegisterBenchmark(
      name.c_str(), [this, name, make = std::move(make), threads](benchmark::State& state) {
        try {
          time_calls(state, contender(name, make), threads);
        } catch (const std::runtime_error& error) {
          wrong_ = name + ": " + error.what();
          state.SkipWithError(error.what());
        }
      });
  if (threads > 1) added->UseRealTime();
}

const Contender& Suite::contender(const std::string& name, const std::function<Contender()>& make) {
  const auto found = made_.find(name);
  if (found != made_.end()) return found->second;
  const Contender& made = made_.emplace(name, make()).first->second;
  made.call();  // caches, page faults
  return made;
}

Results Suite::run(const std::string& names) {
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector, names);
  if (!wrong_.empty()) throw std::runtime_error(wrong_);
  for (auto& [name, timing] : collector.results) timing.items = made_.at(name).items;
  made_.clear();
  return collector.results;
}

bool Suite::run_by_options(const std::string& names) {
  names.empty() ? benchmark::RunSpecifiedBenchmarks() : benchmark::RunSpecifiedBenchmarks(names);
  made_.clear();
  return wrong_.empty();
}

}  // namespace bch::bench
