// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/base/command_line.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/interrupt.hpp"
#include "bench/base/run_main.hpp"
#include "bench/cli/commands.hpp"

namespace {

using namespace bch::cli;

constexpr const char* description =
    "Checks collisions between virtual characters in crowds, by bounding cylinder hierarchies.\n"
    "Lengths are in metres. Headings are in radians, counter-clockwise. The ground plane is x-y.";
constexpr const char* footer =
    "Data goes to standard output, messages to standard error.\n"
    "Exit codes:\n"
    "  0        success\n"
    "  1        a check failed (--fail-above of check and merge)\n"
    "  2        wrong usage\n"
    "  3        a file cannot be read or written, or is not valid\n"
    "  4        internal error\n"
    "  128 + N  ended by signal N (129 hang-up, 130 interrupt, 143 termination)\n"
    "No incomplete output file is left behind.";

int run(int argc, char** argv) {
  CLI::App program(description, "bch");
  program.footer(footer);
  program.set_version_flag("--version", "bch " BCH_VERSION);
  program.require_subcommand(1);
  program.get_formatter()->column_width(24);
  const std::pair<const char*, std::function<void()>> commands[] = {
      {"bake", add_bake_command(program)},   {"check", add_check_command(program)},
      {"crowd", add_crowd_command(program)}, {"inspect", add_inspect_command(program)},
      {"merge", add_merge_command(program)}, {"place", add_place_command(program)},
      {"query", add_query_command(program)},
  };
  std::vector<std::string_view> names;
  for (const auto& command : commands) names.emplace_back(command.first);
  const std::string word = argc > 1 ? argv[1] : "-";
  if (word[0] != '-' && std::ranges::find(names, word) == names.end())
    throw UsageError(fmt::format("no command '{}' ({})", word, fmt::join(names, ", ")));
  if (!parse_command_line(program, argc, argv)) return exit_success;
  for (const auto& [name, command] : commands)
    if (program.got_subcommand(name)) command();
  return exit_success;
}

}  // namespace

int main(int argc, char** argv) {
  clean_up_on_signals(OnRequest::say_so);
  return run_main("bch", [&] { return run(argc, argv); });
}
