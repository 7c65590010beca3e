// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/peak_memory.hpp"

#include <malloc.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace bch::bench {
namespace {

/// A line of /proc/self/status that counts kilobytes; see proc(5).
std::size_t status_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return std::stoul(line.substr(name.size() + 1)) * 1024;
  throw std::runtime_error("/proc/self/status has no " + name);
}

}  // namespace

PeakMemory::PeakMemory() {
  malloc_trim(0);  // or memory that was given back would be taken again unseen
  std::ofstream("/proc/self/clear_refs") << "5\n";
  begin_ = status_bytes("VmRSS");
}

std::size_t PeakMemory::bytes() const {
  const std::size_t peak = status_bytes("VmHWM");
  return peak > begin_ ? peak - begin_ : 0;
}

}  // namespace bch::bench
