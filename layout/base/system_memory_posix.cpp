// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <sys/mman.h>
#include <sys/sysinfo.h>

#include <limits>

#include "layout/base/system_memory.hpp"

namespace bch::detail {

std::uint64_t all_memory() noexcept {
  struct sysinfo system;
  if (sysinfo(&system) != 0) return std::numeric_limits<std::uint64_t>::max();
  return (std::uint64_t{system.totalram} + system.totalswap) * system.mem_unit;
}

void advise_large_pages(void* memory, std::size_t bytes) noexcept {
  madvise(memory, bytes, MADV_HUGEPAGE);
}

}  // namespace bch::detail
