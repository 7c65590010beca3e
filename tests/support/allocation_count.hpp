// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

namespace bch::test {

// For programs that are linked with allocation_count.cpp, which replaces operator new.

/// Calls of operator new so far.
std::size_t allocation_count();

/// What operator new gave and nobody has returned.
std::size_t live_allocations();

enum class Failing { none, one, all };

/// From now on, so many calls of operator new succeed; then one, or all until stop_failing_allocations(), has no memory.
void fail_allocations(Failing mode, std::size_t after);
/// Returns: how many failed.
std::size_t stop_failing_allocations();

}  // namespace bch::test
