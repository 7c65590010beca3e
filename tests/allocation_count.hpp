// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

namespace bch::test {

/// Calls of operator new so far. For programs that are linked with allocation_count.cpp, which replaces it.
std::size_t allocation_count();

}  // namespace bch::test
