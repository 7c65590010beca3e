// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "bench/workload/contender.hpp"

namespace bch::bench {

/// Holds what a benchmark took, and what its contender tells besides.
struct Timing {
  double nanoseconds;  ///< of an item: the median over the repetitions
  std::size_t items;
  std::map<std::string, double> counters;
};
using Results = std::map<std::string, Timing, std::less<>>;

/// Represents Google Benchmark's registry, with benchmarks whose answers are checked before they are timed.
class Suite {
 public:
  /// Adds a benchmark. Its contender is made, which checks it, when it is first run; wrong answers are an error
  /// of the benchmark. Each call runs in an arena of so many threads. One thread is timed by its own clock, which
  /// does not count other programs, several by the wall's. The suite must outlive all runs.
  void add(const std::string& name, std::function<Contender()> make, int threads = 1);

  /// Runs the benchmarks whose names match a regular expression, their repetitions in a random order: what slows
  /// the machine down for a while slows all of them, and ratios stay. Forgets what was made for them.
  /// Errors:  throws std::runtime_error on wrong answers.
  Results run(const std::string& names);

  /// Runs the benchmarks of these names, or if empty those that the options of Google Benchmark choose, and
  /// reports as these say.
  /// Returns: whether all answers were right.
  bool run_by_options(const std::string& names);

 private:
  const Contender& contender(const std::string& name, const std::function<Contender()>& make);

  std::map<std::string, Contender> made_;
  std::string wrong_;
};

/// Shares a value among several contenders: it is made when it is first needed, and kept as long as any of
/// them.
template <class Value>
class Shared {
 public:
  explicit Shared(std::function<std::shared_ptr<Value>()> make)
      : make_(std::move(make)), kept_(std::make_shared<std::weak_ptr<Value>>()) {}

  std::shared_ptr<Value> get() const {
    std::shared_ptr<Value> value = kept_->lock();
    if (!value) *kept_ = value = make_();
    return value;
  }

 private:
  std::function<std::shared_ptr<Value>()> make_;
  std::shared_ptr<std::weak_ptr<Value>> kept_;
};

}  // namespace bch::bench
