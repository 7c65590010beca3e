// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

namespace bch::detail {

/// Returns memory that begins on a cache line. Memory of at least a large page begins on one, and the system is asked
/// for large pages: with small pages, translating the addresses of a large set's shapes costs as much as fetching the
/// shapes.
/// Errors:  throws std::bad_alloc.
void* allocate_aligned(std::size_t bytes);
/// Frees memory of allocate_aligned(). `bytes`: the size that was requested.
void free_aligned(void* memory, std::size_t bytes) noexcept;

}  // namespace bch::detail
