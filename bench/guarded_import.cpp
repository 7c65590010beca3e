// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/guarded_import.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

#include "bench/exit_codes.hpp"

namespace bch::cli {
namespace {

constexpr rlim_t seconds_limit = 60;
constexpr rlim_t memory_limit = rlim_t{4} << 30;

void limit(decltype(RLIMIT_CPU) resource, rlim_t value) {
  const rlimit both{value, value};
  setrlimit(resource, &both);
}

[[noreturn]] void try_import(const std::string& file, const ImportOptions& options) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) signal(number, SIG_DFL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, seconds_limit);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // whose shadow memory alone is larger
  limit(RLIMIT_AS, memory_limit);
#endif
  // The parent speaks for both.
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  try {
    import_character(file, options);
  } catch (const std::exception& error) {
    // What memory was missing here would be missing there, but the parent has no limit to stop at.
    const bool memory = std::string_view(error.what()).find("needs more memory") != std::string_view::npos;
    _exit(memory ? 1 : 0);
  }
  _exit(0);
}

std::string reason(int status) {
  if (WIFEXITED(status))
    return fmt::format("reading it takes more than {} GiB of memory", memory_limit >> 30);
  if (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)
    return fmt::format("reading it takes more than {} seconds", seconds_limit);
  return fmt::format("malformed: the importer crashes on it (signal {})", WTERMSIG(status));
}

}  // namespace

ImportedCharacter guarded_import(const std::string& file, const ImportOptions& options) {
  const pid_t child = fork();
  if (child == 0) try_import(file, options);
  if (child > 0) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
      if (errno != EINTR) throw std::runtime_error("the importing process was lost");
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw InputError(file + ": " + reason(status));
  }
  return import_character(file, options);
}

}  // namespace bch::cli
