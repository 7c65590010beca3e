// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "bench/commands.hpp"
#include "bench/exit_codes.hpp"
#include "bench/interrupt.hpp"
#include "bench/output.hpp"
#include "layout/baked_file.hpp"
#include "layout/import.hpp"

namespace {

using namespace bch::cli;

constexpr const char* description =
    "Collision checking between virtual characters in crowds by bounding cylinder hierarchies.\n"
    "Lengths are in metres, headings in radians, counter-clockwise; the ground plane is x-y.";
constexpr const char* footer =
    "Data goes to standard output, messages to standard error.\n"
    "Exit codes: 0 success; 2 usage; 3 a file that cannot be read, believed or written; 4 internal error;\n"
    "            130 interrupted. No half-written file stays behind.";

constexpr const char* more_help = " (--help tells more)";

int report(int code, const std::string& message) {
  std::fprintf(stderr, "bch: %s\n", message.c_str());
  return code;
}

/// The parser's message in one line.
std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

int run(int argc, char** argv) {
  CLI::App program(description, "bch");
  program.footer(footer);
  program.set_version_flag("--version", "bch " BCH_VERSION);
  program.require_subcommand(1);
  program.get_formatter()->column_width(24);
  const std::pair<const char*, std::function<void()>> commands[] = {
      {"bake", add_bake_command(program)},       {"crowd", add_crowd_command(program)},
      {"inspect", add_inspect_command(program)}, {"query", add_query_command(program)},
      {"report", add_report_command(program)},   {"stability", add_stability_command(program)},
  };
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    write_standard_output(std::string(version.what()) + "\n");
    return exit_success;
  } catch (const CLI::CallForHelp&) {
    write_standard_output(program.help() + "\n");
    return exit_success;
  } catch (const CLI::RequiredError& error) {
    const std::string word = argc > 1 ? argv[1] : "";
    if (program.get_subcommands().empty() && !word.empty() && word[0] != '-')
      throw UsageError("no command '" + word + "' (bake, crowd, inspect, query, report, stability)");
    throw UsageError(one_line(error.what()) + more_help);
  } catch (const CLI::ParseError& error) {
    throw UsageError(one_line(error.what()) + more_help);
  }
  for (const auto& [name, command] : commands)
    if (program.got_subcommand(name)) command();
  return exit_success;
}

}  // namespace

int main(int argc, char** argv) {
  clean_up_on_signals();
  try {
    return run(argc, argv);
  } catch (const UsageError& error) {
    return report(exit_usage, error.what());
  } catch (const InputError& error) {
    return report(exit_bad_input, error.what());
  } catch (const InputErrors& errors) {
    for (const std::string& line : errors.lines) report(exit_bad_input, line);
    return exit_bad_input;
  } catch (const bch::ImportError& error) {
    return report(exit_bad_input, error.what());
  } catch (const bch::BakedFileError& error) {
    return report(exit_bad_input, error.what());
  } catch (const std::bad_alloc&) {
    return report(exit_internal, "not enough memory");
  } catch (const std::exception& error) {
    return report(exit_internal, std::string("internal error: ") + error.what());
  }
}
