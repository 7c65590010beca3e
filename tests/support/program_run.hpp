// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <chrono>

#include "tests/support/standard.hpp"
#include "tests/support/temporary_folder.hpp"

namespace bch::test {

/// The output of a program and how it ended.
struct Ending {
  int code = 0;  ///< exit code, or minus the signal that ended it
  std::string out, err;
};

struct Streams {
  std::string out;                               ///< where standard output goes; empty: into the Ending
  std::chrono::milliseconds interrupt_after{0};  ///< send SIGINT then; 0: never
  std::size_t largest_file = 0;                  ///< bytes: none that it writes may be larger; 0: no limit
};

Ending run_program(const std::string& program, const std::vector<std::string>& arguments,
                   const Streams& streams = {});

/// Starts a program and sends it a signal once `until` holds. Returns the code of its Ending.
/// Errors:  throws std::runtime_error where that is not so within a minute.
int run_until(const std::function<bool()>& until, int signal, const std::string& program,
              const std::vector<std::string>& arguments);

}  // namespace bch::test
