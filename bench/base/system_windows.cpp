// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/system.hpp"

#include <fcntl.h>
#include <io.h>
#include <windows.h>

// After windows.h, whose words it uses.
#include <psapi.h>

#include <algorithm>

namespace bch::cli {
namespace {

constexpr std::size_t max_at_once = std::size_t{1} << 30;  ///< bytes

}  // namespace

/// A program's stack is what its linker was told: two megabytes by MinGW's.
void prepare_process() {
  for (const int stream : {standard_output, standard_error}) _setmode(stream, _O_BINARY);
}

bool is_terminal(int descriptor) {
  return _isatty(descriptor) != 0;
}

std::ptrdiff_t write_some(int descriptor, std::string_view text) {
  return _write(descriptor, text.data(), static_cast<unsigned>((std::min)(text.size(), max_at_once)));
}

double own_memory() {
  PROCESS_MEMORY_COUNTERS_EX memory{};
  const bool is_known = GetProcessMemoryInfo(
      GetCurrentProcess(), reinterpret_cast<PROCESS_MEMORY_COUNTERS*>(&memory), sizeof memory);
  return is_known ? static_cast<double>(memory.PrivateUsage) * 0x1p-30 : 0;
}

}  // namespace bch::cli
