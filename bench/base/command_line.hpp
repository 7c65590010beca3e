// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "bench/base/exit_codes.hpp"
#include "bench/base/output.hpp"

namespace bch::cli {

/// Refuses empty values of all options of a program and its commands: an empty name would mean the same as no
/// option.
/// Errors:  throws UsageError naming the option.
inline void require_values(const CLI::App& program) {
  for (const CLI::App* app : program.get_subcommands()) require_values(*app);
  for (const CLI::Option* option : program.get_options())
    for (const std::string& value : option->results())
      if (value.empty()) throw UsageError(option->get_name() + ": the value is empty (--help tells more)");
}

/// Reads the command line, or writes the help or the version that it asks for.
/// Returns: whether there is anything left to do.
/// Errors:  throws UsageError.
inline bool parse_command_line(CLI::App& program, int argc, char** argv) {
  try {
    program.parse(argc, argv);
    require_values(program);
    return true;
  } catch (const CLI::CallForVersion& version) {
    write_standard_output(std::string(version.what()) + "\n");
  } catch (const CLI::CallForHelp&) {
    write_standard_output(program.help() + "\n");
  } catch (const CLI::ParseError& error) {
    std::string line = error.what();
    while (line.ends_with('\n') || line.ends_with(' ')) line.pop_back();
    for (char& c : line)
      if (c == '\n') c = ' ';
    throw UsageError(line + " (--help tells more)");
  }
  return false;
}

/// Adds an option that takes one value and may be given any number of times.
inline CLI::Option& add_repeatable_option(CLI::App& program, const char* name,
                                          std::vector<std::string>& values, const std::string& help,
                                          const char* type) {
  // All values together would be a list, whose help has dots and whose values may follow each other.
  return *program.add_option(name, values, help)
              ->type_name(type)
              ->expected(1)
              ->allow_extra_args(false)
              ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace bch::cli
