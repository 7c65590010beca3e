// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <string>

#include "kernel/motion/valid_motions.hpp"

namespace bch::detail {

/// Counts the steps of a search, and ends the search at a limit. Most steps lead from one key of the clips to
/// the next, while bodies are within reach of each other. Short loops, long paths or small tolerances can
/// make a search practically endless. An hour of clips with 100 keys per second has 400 000 steps.
class StepLimit {
 public:
  struct Reached {};

  void begin() noexcept { steps_ = 0; }
  /// Errors:  throws Reached.
  void count(std::uint64_t steps) {
    steps_ += steps;
    if (steps_ > most) throw Reached();
  }

 private:
  static constexpr std::uint64_t most = 100'000'000;
  std::uint64_t steps_ = 0;
};

/// Returns find().
/// Errors:  throws std::invalid_argument with the name of the motions, if the limit is reached.
template <class Name, class Find>
double within_limit(const char* query, const Name& name, const Find& find) {
  try {
    return find();
  } catch (const StepLimit::Reached&) {
    reject(
        query,
        name() +
            ": more than 1e8 steps, as from key to key of clips within reach; ask about a shorter interval");
  }
}

}  // namespace bch::detail
