// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/interrupt.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <string_view>

#include "bench/base/exit_codes.hpp"
#include "bench/base/printable.hpp"

namespace bch::cli {
namespace {

/// The signals by which people and systems ask a program to end.
constexpr int requests[] = {SIGINT, SIGTERM, SIGHUP};
/// The signals that end no program, cannot be caught, or mean something else here.
constexpr int left_alone[] = {SIGKILL, SIGSTOP, SIGTSTP, SIGTTIN,  SIGTTOU,
                              SIGCONT, SIGCHLD, SIGURG,  SIGWINCH, SIGXFSZ};

/// A file in an open folder.
struct Unfinished {
  int folder;
  char name[RemovedOnSignal::longest_name + 1];
};
/// Never freed: a handler on another thread may still look at it when its owner has gone.
Unfinished place;
std::atomic<const Unfinished*> unfinished{nullptr};
static_assert(std::atomic<const Unfinished*>::is_always_lock_free);

/// The stack on which handlers run when the main thread has used up its own.
alignas(64) char handler_stack[std::size_t{64} << 10];

/// Removes the file under construction by calls that signal handlers may make.
void remove_unfinished() {
  if (const Unfinished* const file = unfinished.load()) unlinkat(file->folder, file->name, 0);
}

/// Removes the file under construction, writes the words and leaves. Only calls that signal handlers may make: before one that does not
/// return, an address sanitizer would ask for the bounds of the stack, under a lock that the interrupted thread may hold.
[[noreturn, gnu::no_sanitize_address]] void leave_saying(int code, std::string_view words) {
  remove_unfinished();
  // A progress bar ends without a new line; elsewhere the message stands alone.
  [[maybe_unused]] ssize_t written = isatty(STDERR_FILENO) == 1 ? write(STDERR_FILENO, "\n", 1) : 0;
  written = write(STDERR_FILENO, words.data(), words.size());
  _exit(code);
}

/// Leaves from here instead of setting a flag: an import or a batch may be far from the next place that would
/// look at one.
extern "C" [[gnu::no_sanitize_address]] void leave(int signal) {
  leave_saying(exit_signal + signal, "bch: interrupted\n");
}

/// Has the signal again when this returns, and then nothing catches it (SA_RESETHAND).
extern "C" void clean_up(int signal) {
  remove_unfinished();
  raise(signal);
}

template <class Act>
void for_each_ending_signal(Act act) {
  for (int number = 1; number <= SIGRTMAX; ++number)
    if (std::ranges::find(left_alone, number) == std::ranges::end(left_alone)) act(number);
}

void catch_signal(int number) {
  struct sigaction action = {};
  // The C library keeps some numbers for itself.
  if (sigaction(number, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) return;
  const bool request = std::ranges::find(requests, number) != std::ranges::end(requests);
  action = {};
  action.sa_handler = request ? leave : clean_up;
  action.sa_flags = SA_ONSTACK | (request ? 0 : SA_RESETHAND);
  sigfillset(&action.sa_mask);
  sigaction(number, &action, nullptr);
}

}  // namespace

void clean_up_on_signals() {
  stack_t stack = {};
  stack.ss_sp = handler_stack;
  stack.ss_size = sizeof handler_stack;
  sigaltstack(&stack, nullptr);
  for_each_ending_signal(catch_signal);
  signal(SIGXFSZ, SIG_IGN);
}

void leave_at_once(int code, const std::string& line) {
  leave_saying(code, "bch: " + printable_line(line) + "\n");
}

RemovedOnSignal::RemovedOnSignal(int folder, std::string_view name) {
  if (name.size() > longest_name) throw std::length_error("name too long: " + std::string(name));
  unfinished = nullptr;
  place = {folder, {}};
  std::ranges::copy(name, place.name);
  unfinished = &place;
}

RemovedOnSignal::~RemovedOnSignal() {
  unfinished = nullptr;
}

}  // namespace bch::cli
