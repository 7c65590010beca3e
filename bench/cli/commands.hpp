// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace bch::cli {

/// Adds a subcommand to the program.
/// Returns: a function that runs it once the command line was read.
/// Errors:  the returned function throws UsageError, InputError, ImportError, BakedFileError, anything else for a fault.
std::function<void()> add_bake_command(CLI::App& program);
std::function<void()> add_crowd_command(CLI::App& program);
std::function<void()> add_inspect_command(CLI::App& program);
std::function<void()> add_outline_command(CLI::App& program);
std::function<void()> add_place_command(CLI::App& program);
std::function<void()> add_query_command(CLI::App& program);
std::function<void()> add_resolve_command(CLI::App& program);

}  // namespace bch::cli
