// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/system.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>
#include <string>

#include "bench/base/exit_codes.hpp"

namespace bch::cli {
namespace {

constexpr rlim_t least_stack = 320;  ///< KiB, which queries need: <bch/query.hpp>

}  // namespace

void prepare_process() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 &&
        open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) != stream)
      throw std::runtime_error("standard streams are closed, and there is no /dev/null in their place");
  rlimit stack;
  if (getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur / 1024 < least_stack)
    throw UsageError("the stack is limited to " + std::to_string(stack.rlim_cur / 1024) +
                     " KiB (ulimit -s), and " + std::to_string(least_stack) + " are needed");
}

bool is_terminal(int descriptor) {
  return isatty(descriptor) == 1;
}

std::ptrdiff_t write_some(int descriptor, std::string_view text) {
  return write(descriptor, text.data(), text.size());
}

/// See proc(5), statm.
double own_memory() {
#ifdef BCH_SANITIZED  // whose shadow memory would count
  return 0;
#else
  std::FILE* file = std::fopen("/proc/self/statm", "re");
  if (file == nullptr) return 0;
  unsigned long size = 0, resident = 0, shared = 0;
  const int read = std::fscanf(file, "%lu %lu %lu", &size, &resident, &shared);
  std::fclose(file);
  if (read != 3) return 0;
  return static_cast<double>(resident - shared) * static_cast<double>(sysconf(_SC_PAGESIZE)) * 0x1p-30;
#endif
}

}  // namespace bch::cli
