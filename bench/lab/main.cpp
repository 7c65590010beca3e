// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <functional>
#include <utility>

#include "bench/base/command_line.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/interrupt.hpp"
#include "bench/base/run_main.hpp"
#include "bench/lab/commands.hpp"

namespace {

using namespace bch::cli;

constexpr const char* description =
    "Measures bounding cylinder hierarchies against the paper and against exact arithmetic.";

int run(int argc, char** argv) {
  CLI::App program(description, "bch_lab");
  set_up(program, BCH_VERSION, "The exit codes are those of bch.");
  return run_command(program,
                     {{"report", add_report_command(program)}, {"stability", add_stability_command(program)}},
                     argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  clean_up_on_signals(OnRequest::say_so);
  return run_main("bch_lab", [&] { return run(argc, argv); });
}
