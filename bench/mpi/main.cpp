// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <malloc.h>

#include <string>

#include <bch/distributed_crowd.hpp>

#include "bench/base/command_line.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/interrupt.hpp"
#include "bench/mpi/crowd.hpp"
#include "kernel/distributed/session.hpp"

namespace {

using namespace bch::cli;
using bch::detail::Session;

constexpr const char* description =
    R"(Queries crowds on many processes, started by MPI: mpirun -n 4 bch_mpi crowd people.bch
Lengths are in metres. Headings are in radians, counter-clockwise. The ground plane is x-y.)";
constexpr const char* footer =
    R"(Rank 0 writes all output. If one rank fails, all ranks end, with one message that names it.
The exit codes are those of bch.)";

int run_program(const Session& session, int argc, char** argv) {
  CLI::App program(description, "bch_mpi");
  set_up(program, BCH_VERSION, footer);
  if (argc > 1 && argv[1][0] == '-' && session.rank() != 0) return exit_success;  // help and version once
  return run_command(program, {{"crowd", add_crowd_command(program, session.comm())}}, argc, argv);
}

/// Ends with an error that all ranks know of: rank 0 alone writes it.
template <class Error>
int end_together(const Session& session, const Error& error, int code) {
  if (session.rank() != 0) return code;
  return run_main("bch_mpi", [&]() -> int { throw error; });
}

int run_rank(const Session& session, int argc, char** argv) {
  try {
    return run_program(session, argc, argv);
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
