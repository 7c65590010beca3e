// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/command_line.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/interrupt.hpp"
#include "bench/cli/commands.hpp"
#include "bench/recordings/recording_check.hpp"

namespace {

using namespace bch::cli;

constexpr const char* description =
    "Checks collisions between virtual characters in crowds, by bounding cylinder hierarchies.\n"
    "Lengths are in metres. Headings are in radians, counter-clockwise. The ground plane is x-y.";
constexpr const char* footer =
    "Data goes to standard output, messages to standard error.\n"
    "Exit codes:\n"
    "  0        success\n"
    "  1        a check failed (--fail-above of check)\n"
    "  2        wrong usage\n"
    "  3        a file cannot be read or written, or is not valid\n"
    "  4        internal error\n"
    "  128 + N  ended by signal N (129 hang-up, 130 interrupt, 143 termination)\n"
    "No incomplete output file is left behind.";

int run(int argc, char** argv) {
  CLI::App program(description, "bch");
  set_up(program, BCH_VERSION, footer);
  return run_command(program,
                     {{"bake", add_bake_command(program)},
                      {"check", add_check_command(program)},
                      {"crowd", add_crowd_command(program)},
                      {"inspect", add_inspect_command(program)},
                      {"outline", add_outline_command(program)},
                      {"place", add_place_command(program)},
                      {"query", add_query_command(program)},
                      {"resolve", add_resolve_command(program)}},
                     argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  clean_up_on_signals(OnRequest::say_so);
  return run_main("bch", [&] { return run(argc, argv); });
}
