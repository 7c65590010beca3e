// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <stdexcept>

#include "bench/ratios/ratios.hpp"

namespace bch::bench {
namespace {

bool wrong_answers_were_found = false;

/// Times a call in an arena of its own size: with one thread, the caller's time is then all of the time that
/// the call takes. Other threads are woken first, which takes about a millisecond and does not happen between
/// the frames of a simulation.
void time_calls(benchmark::State& state, const Contender& contender, int threads) {
  tbb::task_arena arena(threads);
  if (threads > 1) arena.execute(contender.call);
  for ([[maybe_unused]] auto _ : state) arena.execute(contender.call);
  using benchmark::Counter;
  state.counters["per_item"] = Counter(static_cast<double>(contender.items),
                                       Counter::Flags(Counter::kIsIterationInvariantRate | Counter::kInvert));
  for (const auto& [name, value] : contender.counters) state.counters[name] = value;
}

}  // namespace

void add(const std::string& name, std::function<Contender()> make, int threads) {
  const auto contender = once([make = std::move(make)] {
    const auto made = std::make_shared<Contender>(make());
    made->call();  // caches, page faults
    return made;
  });
  auto* const added =
      benchmark::RegisterBenchmark(name.c_str(), [contender, threads](benchmark::State& state) {
        try {
          time_calls(state, contender(), threads);
        } catch (const std::runtime_error& error) {
          wrong_answers_were_found = true;
          state.SkipWithError(error.what());
        }
      });
  if (threads > 1) added->UseRealTime();
}

void add_for_threads(const std::string& name, const std::function<Contender()>& make) {
  add(name, make);
  const int most = tbb::info::default_concurrency();
  for (int threads = 2; threads < 2 * most; threads *= 2) {
    const int count = std::min(threads, most);
    add(fmt::format("{}/threads:{}", name, count), make, count);
  }
}

bool any_wrong() {
  return wrong_answers_were_found;
}

}  // namespace bch::bench
