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
#include "bench/base/text.hpp"

namespace bch::cli {
namespace {

/// The signals by which people and systems ask a program to end.
constexpr int requests[] = {SIGINT, SIGTERM, SIGHUP};
/// The signals that end no program, cannot be caught, or mean something else here.
constexpr int left_alone[] = {SIGKILL, SIGSTOP, SIGTSTP, SIGTTIN,  SIGTTOU,
                              SIGCONT, SIGCHLD, SIGURG,  SIGWINCH, SIGXFSZ};

/// A file in an open folder.
struct Unfinished {
  enum : int { free, filling, named };
  std::atomic<int> state{free};
  int folder;
  char name[RemoveOnSignal::longest_name + 1];
};
static_assert(std::atomic<int>::is_always_lock_free);
/// Never freed: a handler on another thread may still examine one when its owner has gone.
Unfinished unfinished[RemoveOnSignal::max_files];

OnRequest on_request = OnRequest::say_so;

/// Removes the files under construction by calls that signal handlers may make.
void remove_unfinished() {
  for (const Unfinished& file : unfinished)
    if (file.state == Unfinished::named) unlinkat(file.folder, file.name, 0);
}

/// Removes the files under construction, writes the words and leaves. Only calls that signal handlers may make: before one that does not
/// return, an address sanitizer would ask for the bounds of the stack, under a lock that the interrupted thread may hold.
[[noreturn, gnu::no_sanitize_address]] void leave_saying(int code, std::string_view words) {
  remove_unfinished();
  // A progress bar ends without a new line; elsewhere the message stands alone.
  [[maybe_unused]] ssize_t written = isatty(STDERR_FILENO) == 1 ? write(STDERR_FILENO, "\n", 1) : 0;
  written = write(STDERR_FILENO, words.data(), words.size());
  _exit(code);
}

/// Leaves from here instead of setting a flag: an import or a batch may be far from the next place that would
/// examine one.
extern "C" [[gnu::no_sanitize_address]] void leave(int signal) {
  leave_saying(exit_signal + signal, "bch: interrupted\n");
}

/// Has the signal again when this returns, and then nothing catches it (SA_RESETHAND).
extern "C" void clean_up(int signal) {
  remove_unfinished();
  raise(signal);
}

void catch_signal(int number) {
  struct sigaction action = {};
  // The C library keeps some numbers for itself.
  if (sigaction(number, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) return;
  const bool says_so =
      on_request == OnRequest::say_so && std::ranges::find(requests, number) != std::ranges::end(requests);
  action = {};
  action.sa_handler = says_so ? leave : clean_up;
  action.sa_flags = says_so ? 0 : static_cast<int>(SA_RESETHAND);
  sigfillset(&action.sa_mask);
  sigaction(number, &action, nullptr);
}

}  // namespace

void clean_up_on_signals(OnRequest what) {
  on_request = what;
  for (int number = 1; number <= SIGRTMAX; ++number)
    if (std::ranges::find(left_alone, number) == std::ranges::end(left_alone)) catch_signal(number);
  signal(SIGXFSZ, SIG_IGN);
}

void exit_now(int code, const std::string& line) {
  leave_saying(code, "bch: " + printable_line(line) + "\n");
}

RemoveOnSignal::RemoveOnSignal(int folder, std::string_view name) {
  if (name.size() > longest_name) throw std::length_error("name too long: " + std::string(name));
  for (place_ = 0; place_ < max_files; ++place_) {
    Unfinished& place = unfinished[place_];
    int expected = Unfinished::free;
    if (!place.state.compare_exchange_strong(expected, Unfinished::filling)) continue;
    place.folder = folder;
    *std::ranges::copy(name, place.name).out = '\0';
    place.state = Unfinished::named;
    return;
  }
  throw std::length_error("too many files at a time");
}

RemoveOnSignal::~RemoveOnSignal() {
  unfinished[place_].state = Unfinished::free;
}

}  // namespace bch::cli
