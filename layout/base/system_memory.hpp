// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

namespace bch::detail {

/// Returns the bytes of memory and of its extension on disk: what no process can have more of. The most there is where the system does not say.
std::uint64_t all_memory() noexcept;
/// Asks the system for large pages, where it takes such advice: without them it only takes longer.
void advise_large_pages(void* memory, std::size_t bytes) noexcept;

}  // namespace bch::detail
