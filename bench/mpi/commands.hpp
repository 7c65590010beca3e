// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <mpi.h>

#include <CLI/CLI.hpp>
#include <functional>

namespace bch::cli {

/// Adds the command that checks a recording in parts, which ranks take in turn. Returns what runs the
/// command.
std::function<void()> add_check_command(CLI::App& program, MPI_Comm comm);

/// Adds the command that lets a crowd walk on all ranks, and tells what each of them did. Returns what runs
/// the command.
std::function<void()> add_crowd_command(CLI::App& program, MPI_Comm comm);

/// Adds the command that tells how a crowd of any size would be cut, by counting alone, on rank 0. Returns
/// what runs the command.
std::function<void()> add_simulate_command(CLI::App& program, MPI_Comm comm);

}  // namespace bch::cli
