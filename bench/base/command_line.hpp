// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bench/base/did_you_mean.hpp"
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

/// Says which argument a program and the command that was named do not know, an option first, and which it may stand for.
inline std::string unexpected(const CLI::App& program) {
  const std::vector<std::string> words = program.remaining(true);
  const auto option = std::find_if(words.begin(), words.end(),
                                   [](const std::string& word) { return word.starts_with("--"); });
  if (option == words.end()) return "expected no argument '" + words.front() + "'";
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands())
    for (const CLI::Option* each : command->get_options()) names.push_back(each->get_name());
  return "unknown option " + *option + did_you_mean(option->substr(0, option->find('=')), names);
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
  } catch (const CLI::ExtrasError&) {
    throw UsageError(unexpected(program) + " (--help tells more)");
  } catch (const CLI::ParseError& error) {
    std::string line = error.what();
    while (line.ends_with('\n') || line.ends_with(' ')) line.pop_back();
    for (char& c : line)
      if (c == '\n') c = ' ';
    throw UsageError(line + " (--help tells more)");
  }
  return false;
}

/// Represents a subcommand: its name, and what runs it once the command line was read.
using Command = std::pair<std::string, std::function<void()>>;

/// Prepares a program of subcommands, which are to be added.
inline void set_up(CLI::App& program, const std::string& version, const std::string& footer) {
  program.footer(footer);
  program.set_version_flag("--version", program.get_name() + " " + version);
  program.require_subcommand(1);
  program.get_formatter()->column_width(24);
}

/// Runs the subcommand that the command line names. Returns: the exit code.
/// Errors:  throws UsageError, and as the subcommand throws.
inline int run_command(CLI::App& program, const std::vector<Command>& commands, int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "-";
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.first);
  if (word[0] != '-' && std::find(names.begin(), names.end(), word) == names.end())
    throw UsageError(
        fmt::format("no command '{}'{} ({})", word, did_you_mean(word, names), fmt::join(names, ", ")));
  if (!parse_command_line(program, argc, argv)) return exit_success;
  for (const auto& [name, run] : commands)
    if (program.got_subcommand(name)) run();
  return exit_success;
}

/// Adds options to a command, or to a group of them that --help shows together.
class OptionAdder {
 public:
  explicit OptionAdder(CLI::App& command, const char* group = "Options") : command_(command), group_(group) {}

  /// Adds an option. `type`: what --help calls a value; `check`: what a value has to be.
  template <class Value>
  CLI::Option* operator()(const char* name, Value& value, const char* type, const std::string& help,
                          const CLI::Validator& check = {}) const {
    return command_.add_option(name, value, help)->type_name(type)->check(check)->group(group_);
  }

 private:
  CLI::App& command_;
  const char* group_;
};

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
