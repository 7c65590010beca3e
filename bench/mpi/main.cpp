// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include <bch/distributed_crowd.hpp>

#include "bench/base/command_line.hpp"
#include "bench/base/interrupt.hpp"
#include "bench/base/run_main.hpp"
#include "bench/mpi/commands.hpp"
#include "kernel/distributed/session.hpp"

namespace {

using namespace bch::cli;
using bch::detail::Session;

constexpr const char* description =
    "Queries crowds on many processes, started by MPI: mpirun -n 4 bch_mpi crowd people.bch\n"
    "Lengths are in metres. Headings are in radians, counter-clockwise. The ground plane is x-y.";
constexpr const char* footer =
    "Rank 0 writes all output. If one rank fails, all ranks end, with one message that names it.\n"
    "The exit codes are those of bch.";

int run_command(const Session& session, int argc, char** argv) {
  CLI::App program(description, "bch_mpi");
  program.footer(footer);
  program.set_version_flag("--version", "bch_mpi " BCH_VERSION);
  program.require_subcommand(1);
  program.get_formatter()->column_width(24);
  const std::pair<const char*, std::function<void()>> commands[] = {
      {"check", add_check_command(program, session.comm())},
      {"crowd", add_crowd_command(program, session.comm())},
      {"simulate", add_simulate_command(program, session.comm())},
  };
  const std::string word = argc > 1 ? argv[1] : "-";
  if (word[0] != '-' && std::ranges::none_of(commands, [&](const auto& one) { return one.first == word; }))
    throw UsageError("no command '" + word + "' (check, crowd, simulate)");
  if (argc > 1 && word[0] == '-' && session.rank() != 0) return exit_success;  // help and version once
  if (!parse_command_line(program, argc, argv)) return exit_success;
  for (const auto& [name, command] : commands)
    if (program.got_subcommand(name)) command();
  return exit_success;
}

/// Ends with an error that all ranks know of: rank 0 alone writes it.
template <class Error>
int end_together(const Session& session, const Error& error, int code) {
  if (session.rank() != 0) return code;
  return run_main("bch_mpi", [&]() -> int { throw error; });
}

int run_rank(const Session& session, int argc, char** argv) {
  try {
    return run_command(session, argc, argv);
  } catch (const bch::RankError& error) {
    return end_together(session, InputError(error.what()), exit_bad_input);
  } catch (const CheckFailed& error) {
    return end_together(session, error, exit_failed);
  } catch (const UsageError& error) {  // all see the same command line
    return end_together(session, error, exit_usage);
  }
}

}  // namespace

int main(int argc, char** argv) {
  mallopt(M_MMAP_THRESHOLD, 1 << 20);  // arrays that outgrow their place leave no holes
  return run_main("bch_mpi", [&] {
    const Session session(argc, argv);
    clean_up_on_signals(OnRequest::end);  // after MPI, which catches some signals itself
    bool is_agreed = false;
    const int code = run_main(fmt::format("bch_mpi: rank {}", session.rank()).c_str(), [&] {
      const int agreed = run_rank(session, argc, argv);
      is_agreed = true;
      return agreed;
    });
    if (!is_agreed) session.abort(code);  // others may wait for this rank, and would for ever
    return code;
  });
}
