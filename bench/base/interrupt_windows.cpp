// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/interrupt.hpp"

#include <windows.h>

#include <string>
#include <string_view>

#include "bench/base/exit_codes.hpp"
#include "bench/base/system.hpp"
#include "bench/base/text.hpp"

namespace bch::cli {
namespace {

constexpr int interrupt = 2;  ///< the number of a signal elsewhere

[[noreturn]] void leave_saying(int code, std::string_view words) {
  if (is_terminal(standard_error)) write_some(standard_error, "\n");
  write_some(standard_error, words);
  TerminateProcess(GetCurrentProcess(), static_cast<UINT>(code));
  for (;;) Sleep(INFINITE);
}

BOOL WINAPI leave(DWORD) {
  leave_saying(exit_signal + interrupt, "bch: interrupted\n");
}

}  // namespace

/// Files under construction are the system's to remove: see OutputFile.
void clean_up_on_signals(OnRequest what) {
  if (what == OnRequest::say_so) SetConsoleCtrlHandler(leave, TRUE);
}

void exit_now(int code, const std::string& line) {
  leave_saying(code, "bch: " + printable_line(line) + "\n");
}

}  // namespace bch::cli
