// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <string>

#include "kernel/motion/valid_motions.hpp"

namespace bch::detail {

/// Counts the steps of a search, most of them from key to key of clips within reach, and ends one that short loops, long paths or fine
/// tolerances make endless to all intents. An hour of clips with a hundred keys a second has 400 000.
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

/// Returns what find() finds.
/// Errors:  throws std::invalid_argument with the name of what was examined, where the limit is reached.
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
