// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <windows.h>

#include <limits>

#include "layout/base/system_memory.hpp"

namespace bch::detail {

std::uint64_t all_memory() noexcept {
  MEMORYSTATUSEX system{};
  system.dwLength = sizeof system;
  return GlobalMemoryStatusEx(&system) ? system.ullTotalPageFile
                                       : (std::numeric_limits<std::uint64_t>::max)();
}

void advise_large_pages(void*, std::size_t) noexcept {}  // they are for administrators' programs

}  // namespace bch::detail
