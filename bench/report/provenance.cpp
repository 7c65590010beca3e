// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/provenance.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <fstream>

#include <bch/query.hpp>

#include "bch_commit.hpp"

namespace bch::report {
namespace {

/// The value of the first line of a file that begins with the name.
std::string value_in(const char* file, std::string_view name) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos || !line.starts_with(name)) continue;
    const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
    return begin == std::string::npos ? std::string() : line.substr(begin);
  }
  return "unknown";
}

std::string system_name() {
  utsname name;
  return uname(&name) == 0 ? fmt::format("{} {}, {}", name.sysname, name.release, name.machine) : "unknown";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> provenance() {
  std::string sets;
  for (const Implementation& one : implementations())
    if (one.supported()) sets += (sets.empty() ? "" : ", ") + std::string(one.name);
  const double gibibytes =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE)) / (1 << 30);
  return {{"processor", value_in("/proc/cpuinfo", "model name")},
          {"cores", fmt::format("{}", sysconf(_SC_NPROCESSORS_ONLN))},
          {"instruction sets", sets},
          {"memory (GiB)", fmt::format("{:.1f}", gibibytes)},
          {"system", system_name()},
#ifdef __clang__
          {"compiler", "Clang " __clang_version__},
#else
          {"compiler", "GCC " __VERSION__},
#endif
          {"build", BCH_BUILD},
          {"commit", BCH_COMMIT},
          {"time", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)))}};
}

}  // namespace bch::report
