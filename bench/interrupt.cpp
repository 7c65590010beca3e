// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <climits>
#include <cstring>
#include <stdexcept>

#include "bench/exit_codes.hpp"

namespace bch::cli {
namespace {

char path_buffer[PATH_MAX];
std::atomic<const char*> to_remove{nullptr};
static_assert(std::atomic<const char*>::is_always_lock_free);

/// Leaves from here instead of setting a flag: an import or a batch may be far from the next place that would
/// look at one. Only calls that signal handlers may make.
extern "C" void leave(int signal) {
  if (const char* path = to_remove.load()) unlink(path);
  constexpr char message[] = "\nbch: interrupted\n";
  // A progress bar ends without a new line; elsewhere the message stands alone.
  const bool terminal = isatty(STDERR_FILENO) == 1;
  const char* text = terminal ? message : message + 1;
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, sizeof(message) - (terminal ? 1 : 2));
  _exit(exit_signal + signal);
}

}  // namespace

void clean_up_on_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action = {};
    sigaction(number, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = leave;
    sigfillset(&action.sa_mask);
    sigaction(number, &action, nullptr);
  }
  // A file beyond the user's limit is an error of write() then, like a full disk.
  signal(SIGXFSZ, SIG_IGN);
}

RemovedOnSignal::RemovedOnSignal(const std::filesystem::path& path) {
  if (path.native().size() >= sizeof(path_buffer)) throw std::length_error("path too long: " + path.string());
  std::memcpy(path_buffer, path.c_str(), path.native().size() + 1);
  to_remove = path_buffer;
}

RemovedOnSignal::~RemovedOnSignal() {
  to_remove = nullptr;
}

}  // namespace bch::cli
