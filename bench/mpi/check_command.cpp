// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <memory>
#include <string>
#include <vector>

#include "bench/base/exit_codes.hpp"
#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/mpi/crowd.hpp"
#include "bench/recordings/recording_check.hpp"
#include "kernel/distributed/agreement.hpp"

namespace bch::cli {
namespace {

struct CheckRanksOptions {
  CheckInput input;
  CheckOutputs outputs;
  std::string folder;
  std::uint32_t parts = 0;  ///< 0: as many as ranks
  std::uint32_t threads = 1;
};

/// Writes the answers of all parts. Returns why the check fails, as its user asked for, or nothing.
std::string merge_all(const CheckRanksOptions& options, std::uint32_t count) {
  std::vector<std::string> manifests;
  for (std::uint32_t k = 1; k <= count; ++k)
    manifests.push_back(PartFiles(options.folder, {k, count}).manifest());
  try {
    const WholeRun whole = find_parts(manifests);
    require_outputs(options.outputs.files(), whole.files);
    merge_check(whole, options.outputs);
    return {};
  } catch (const CheckFailed& error) {
    return error.what();
  }
}

void check_on_ranks(const CLI::App& command, const CheckRanksOptions& options, MPI_Comm comm) {
  int rank = 0, size = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  const std::uint32_t count = options.parts == 0 ? static_cast<std::uint32_t>(size) : options.parts;
  const Threads threads(options.threads);
  detail::agree(comm, [&] {
    options.input.require_fitting(command);
    if (rank == 0) require_outputs(options.outputs.files(), options.input.files());
    const nlohmann::ordered_json run = run_of(command, options.input.files());
    for (std::uint32_t k = static_cast<std::uint32_t>(rank); k < count; k += static_cast<std::uint32_t>(size))
      check_part(options.input, {options.folder, {k + 1, count}}, run);
  });
  std::string failure;
  detail::agree(comm, [&] {
    if (rank == 0) failure = merge_all(options, count);
  });
  int fails = failure.empty() ? 0 : 1;
  MPI_Bcast(&fails, 1, MPI_INT, 0, comm);
  if (fails != 0) throw CheckFailed(failure);
}

}  // namespace

std::function<void()> add_check_command(CLI::App& program, MPI_Comm comm) {
  const auto options = std::make_shared<CheckRanksOptions>();
  CLI::App& command = *program.add_subcommand(
      "check", "Check a recording as bch check does, with its parts divided among the ranks");
  command.footer(
      R"(Writes the same bytes as bch check. Parts stay in the folder. A complete part of the same run that is already there
is skipped. bch check --part makes the same parts.
Example: mpirun -n 16 bch_mpi check long.sqlite --into parts --parts 64 --json check.json)");
  options->input.add_to(command);
  add_outputs_to(command, options->outputs);
  const OptionAdder add(command);
  add("--into", options->folder, "DIR", "Folder of the parts, which all ranks have to see")->required();
  add("--parts", options->parts, "N", "Number of parts, which ranks take in turn [as many as ranks]",
      whole_between(1, 1'000'000));
  add("--threads", options->threads, "N", "Threads per rank [1]", whole_between(1, 1024));
  return [options, &command, comm] { check_on_ranks(command, *options, comm); };
}

}  // namespace bch::cli
