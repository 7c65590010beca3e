// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

namespace bch::detail {

/// Returns memory from a cache line on. As much as a large page or more begins on one, and the system is asked for large pages:
/// with small ones, finding out where the shapes of a large set lie costs as much as fetching them.
/// Errors:  throws std::bad_alloc.
void* allocate_aligned(std::size_t bytes);
/// Frees memory of allocate_aligned(). `bytes`: as many as were asked for.
void free_aligned(void* memory, std::size_t bytes) noexcept;

}  // namespace bch::detail
