// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <gtest/gtest.h>

#include <bch/bch.h>

#include "tests/support/allocation_count.hpp"
#include "tests/support/standard.hpp"

// Every allocation of a call of the C interface fails once, and once with all that follow it. So it does for what it calls of the C++
// library, which throws std::bad_alloc then.

namespace bch::test {

/// Calls, and expects that nothing but memory is lacking.
/// Returns: whether it is.
template <class Call>
bool lacks_memory(const Call& call) {
  const bch_status status = call();
  if (status == BCH_OK) return false;
  EXPECT_EQ(status, BCH_NO_MEMORY);
  EXPECT_STREQ(bch_last_error(), "out of memory");
  return true;
}

/// Makes the calls of a round that are to lack memory.
class Attempt {
 public:
  Attempt(Failing mode, std::size_t after) : mode_(mode), after_(after) {}

  /// Makes a call without the memory that it needs.
  /// Returns: whether it failed for that.
  template <class Call>
  bool fails(const Call& call) {
    fail_allocations(mode_, after_);
    const bool failed = lacks_memory(call);
    const std::size_t failures = stop_failing_allocations();
    EXPECT_EQ(failed, failures > 0) << "allocation " << after_;
    any_failed = any_failed || failures > 0;
    return failed;
  }

  /// Makes a call without the memory that it needs, asks whether all is as it was, and makes the call again with memory.
  template <class Call>
  void operator()(
      const Call& call, const std::function<bool()>& untouched = [] { return true; }) {
    if (!fails(call)) return;
    EXPECT_TRUE(untouched()) << "allocation " << after_;
    EXPECT_FALSE(lacks_memory(call)) << "after allocation " << after_;
  }

  bool any_failed = false;

 private:
  const Failing mode_;
  const std::size_t after_;
};

/// Runs a round, which leaves nothing behind, with the first, second ... allocation of what it attempts failing, or with every
/// `step`-th, until no more are left. Expects that these are more than `least`.
template <class Round>
void fail_each(std::size_t least, Round round, std::size_t step = 1) {
  Attempt first(Failing::none, 0);
  round(first);  // what is made once in a program is made
  for (std::size_t after = 0;; after += step)
    for (const Failing mode : {Failing::one, Failing::all}) {
      const std::size_t live = live_allocations();
      Attempt attempt(mode, after);
      round(attempt);
      const std::size_t leaked = live_allocations() - live;
      EXPECT_EQ(leaked, 0u) << "allocation " << after;
      if (testing::Test::HasFailure()) return;
      if (!attempt.any_failed) {
        EXPECT_GT(after, least);
        return;
      }
    }
}

}  // namespace bch::test
