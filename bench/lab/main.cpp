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

constexpr const char* description = "Measures bounding cylinder hierarchies against the paper and against exact arithmetic.";

int run(int argc, char** argv) {
  CLI::App program(description, "bch_lab");
  program.footer("The exit codes are those of bch.");
  program.set_version_flag("--version", "bch_lab " BCH_VERSION);
  program.require_subcommand(1);
  program.get_formatter()->column_width(24);
  const std::pair<const char*, std::function<void()>> commands[] = {
      {"report", add_report_command(program)},
      {"stability", add_stability_command(program)},
  };
  if (!parse_command_line(program, argc, argv)) return exit_success;
  for (const auto& [name, command] : commands)
    if (program.got_subcommand(name)) command();
  return exit_success;
}

}  // namespace

int main(int argc, char** argv) {
  clean_up_on_signals(OnRequest::say_so);
  return run_main("bch_lab", [&] { return run(argc, argv); });
}
