// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/workload/scene.hpp"

namespace bch::bench {

/// Something to be timed beside others.
struct Contender {
  std::string name;
  std::function<void()> call;
  double nanoseconds = 0;         ///< of a call: the result, the median of
  std::vector<double> runs = {};  ///< what each run took a call
};

/// Times all of them in turn, `runs` times over, and takes each one's median: what slows the machine down
/// for a while slows all of them, and ratios stay. A run of a contender takes 10 ms at least.
/// Threads: each call runs in an arena of that many, whose time Stopwatch takes.
void race(std::vector<Contender>& contenders, std::uint32_t runs, int threads);

/// Makes a contender that asks a kernel's implementation for all pairs of a workload, by one thread; its
/// answers were compared. Errors of both: throw std::runtime_error on wrong answers.
Contender kernel_contender(Scene& scene, const Workload& workload, const QueryOptions& query,
                           const kernel::Implementation& implementation);
Contender structure_contender(Scene& scene, const Workload& workload, std::string_view kind);

/// A question beside collide(), of all of a workload's pairs or its agents. Answers are compared when a contender is made.
/// Errors of both: throw std::runtime_error on wrong answers.
struct TimedQuery {
  const char* name;
  Contender (*kernel)(Scene&, const Workload&, const kernel::Implementation&);
  Contender (*reference)(Scene&, const Workload&);  ///< may be null
};

/// Checks that nothing is wrong: throws std::runtime_error if `wrong` is not empty.
void require_right(const std::string& name, const Workload& workload, const std::string& wrong);

/// Returns whether this build has the kind.
bool has_kind(std::string_view kind);

}  // namespace bch::bench
