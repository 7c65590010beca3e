// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

namespace bch::detail {

/// Returns the bytes of memory plus swap, an upper bound for any process; the largest integer if the system does not
/// say.
std::uint64_t all_memory() noexcept;
/// Asks the system for large pages, if it takes such advice. Without them, access only takes longer.
void advise_large_pages(void* memory, std::size_t bytes) noexcept;

}  // namespace bch::detail
