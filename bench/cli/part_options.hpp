// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "bench/cli/parts.hpp"

namespace bch::cli {

/// Holds the options of a command that does a part of its work.
struct PartOptions {
  std::string part, folder;

  void add_to(CLI::App& command);
  /// Returns whether a part is wanted.
  /// Errors:  throws UsageError where one of the options is there without the other.
  bool are_given() const;
  PartFiles files() const { return {folder, parse_part(part)}; }
};

/// Returns what all parts of a command have in common: the options that were given, but for those that do not change an answer, and
/// the files that are read.
nlohmann::ordered_json run_of(const CLI::App& command, const std::vector<std::string>& inputs);

}  // namespace bch::cli
