// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

namespace bch::test {

// These functions are for programs that are linked with allocation_count.cpp, which replaces operator new.

/// Returns the number of calls of operator new so far.
std::size_t allocation_count();

/// Returns the number of allocations by operator new that have not been freed.
std::size_t live_allocations();

enum class Failing { none, one, all };

/// Makes operator new fail: so many calls succeed; then one, or all until stop_failing_allocations(), has no
/// memory.
void fail_allocations(Failing mode, std::size_t after);
/// Ends the failures of operator new. Returns: how many calls failed.
std::size_t stop_failing_allocations();

}  // namespace bch::test
