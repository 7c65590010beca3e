// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <bch/baked.hpp>

#include "bench/base/output.hpp"
#include "bench/base/text.hpp"
#include "bench/cli/options.hpp"
#include "bench/mpi/commands.hpp"
#include "bench/mpi/cut_simulation.hpp"
#include "kernel/distributed/agreement.hpp"
#include "kernel/distributed/exchange.hpp"

namespace bch::cli {
namespace {

constexpr int collectives = 10;  ///< of all ranks in a step

struct SimulationOptions {
  std::string file;
  std::vector<std::string> kinds = {"uniform", "stadium", "street"};
  std::uint64_t agents = 100'000'000;
  std::uint32_t ranks = 256;
  double density = 3;
  double agent_ns = 110, pair_ns = 85, microseconds = 5, gigabits = 10, agent_pairs = 0;
};

/// What the ranks of a simulated crowd have in common.
struct Figures {
  double agents = 0, pairs = 0, most_pairs = 0, most_agents = 0, halo = 0, most_halo = 0, bytes = 0;
  double most_neighbours = 0, compute_ms = 0, network_ms = 0;
};

Figures figures_of(const std::vector<SimulatedRank>& ranks, const SimulationOptions& options) {
  const detail::AgentType copied(false, false), whole(true, false);
  const auto copy_bytes = static_cast<double>(copied.bytes()),
             migrant_bytes = static_cast<double>(whole.bytes());
  Figures all;
  const double tree = collectives * std::log2(static_cast<double>(ranks.size())) * options.microseconds;
  for (const SimulatedRank& rank : ranks) {
    const auto halo = static_cast<double>(rank.halo);
    const double bytes =
        copy_bytes * static_cast<double>(rank.sent) + migrant_bytes * static_cast<double>(rank.migrants);
    const auto neighbours = static_cast<double>(rank.neighbours.size());
    all.agents += rank.agents, all.pairs += rank.pairs, all.halo += halo, all.bytes += bytes;
    all.most_agents = std::max(all.most_agents, rank.agents),
    all.most_pairs = std::max(all.most_pairs, rank.pairs);
    all.most_halo = std::max(all.most_halo, halo / std::max(1.0, rank.agents));
    all.most_neighbours = std::max(all.most_neighbours, neighbours);
    all.compute_ms = std::max(
        all.compute_ms, 1e-6 * (options.agent_ns * (rank.agents + halo) + options.pair_ns * rank.pairs));
    all.network_ms = std::max(all.network_ms, 1e-3 * (tree + 2 * neighbours * options.microseconds) +
                                                  1e3 * 8 * bytes / (options.gigabits * 1e9));
  }
  return all;
}

std::string row(const std::string& kind, const Figures& all, double ranks) {
  return fmt::format("| {} | {} | {:.3f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} | {:.2f} | {:.1f} | {:.2f} |\n",
                     kind, grouped(static_cast<std::uint64_t>(all.agents)),
                     all.most_pairs * ranks / all.pairs, all.most_agents * ranks / all.agents,
                     100 * all.halo / all.agents, 100 * all.most_halo, all.most_neighbours,
                     all.bytes / all.agents, all.compute_ms, all.network_ms);
}

std::string table(const SimulationOptions& options) {
  const BakedShapes baked = load_baked(options.file, FileAccess::map);
  const SimulatedBodies bodies = bodies_of(baked.set);
  std::string text = fmt::format(
      "{}, squares of {:.2f} m, counted; times of one thread a rank\n\n"
      "| crowd | agents | imbalance of pairs | of agents | halo % | most | neighbours, most | bytes an agent "
      "| ms: kernel | "
      "network |\n|---|---|---|---|---|---|---|---|---|---|\n",
      counted(options.ranks, "rank"), std::max(1.0, 4 * bodies.reach));
  for (const std::string& kind : options.kinds) {
    const Scenery scenery(kind, options.agents, options.density);
    const auto ranks = simulate_cut(scenery, bodies, static_cast<int>(options.ranks), options.agent_pairs);
    text += row(kind, figures_of(ranks, options), options.ranks);
  }
  return text;
}

void add_model_options(CLI::App& command, SimulationOptions& options) {
  const auto add = [&](const char* name, double& value, const char* type, const char* what, double low = 0) {
    command.add_option(name, value, fmt::format("{} [{}]", what, value))
        ->type_name(type)
        ->check(number_between(low, 1e9));
  };
  add("--agent-pairs", options.agent_pairs, "N", "Weight of an agent, in pairs, when work is balanced");
  add("--agent-ns", options.agent_ns, "NS", "Time per agent, without its pairs, nanoseconds");
  add("--pair-ns", options.pair_ns, "NS", "Time per pair, nanoseconds");
  add("--latency-us", options.microseconds, "US", "Time per message, microseconds");
  add("--gigabits", options.gigabits, "G", "Bandwidth of a rank, gigabits per second", 1e-3);
}

}  // namespace

std::function<void()> add_simulate_command(CLI::App& program, MPI_Comm comm) {
  const auto options = std::make_shared<SimulationOptions>();
  CLI::App& command = *program.add_subcommand(
      "simulate",
      "Predict imbalance, halos and traffic of a crowd of any size, on one process, without queries");
  command.add_option("file", options->file, "Baked file of shapes (bch bake), whose radii are used")
      ->type_name("FILE")
      ->required();
  command.add_option("--agents", options->agents, "Total number of agents [100000000]")
      ->type_name("N")
      ->check(whole_between(1, 4'000'000'000));
  command.add_option("--ranks", options->ranks, "Number of ranks [256]")
      ->type_name("N")
      ->check(whole_between(1, 1'000'000));
  command
      .add_option("--kinds", options->kinds,
                  "Kinds of crowds: uniform, spot, stadium, street [uniform,stadium,street]")
      ->type_name("LIST")
      ->delimiter(',')
      ->check(one_of(scenery_kinds));
  command.add_option("--density", options->density, "Agents per square metre [3]")
      ->type_name("D")
      ->check(number_between(1e-6, 1e3));
  add_model_options(command, *options);
  return [options, comm] {
    int rank;
    MPI_Comm_rank(comm, &rank);
    detail::agree(comm, [&] {
      if (rank == 0) write_standard_output(table(*options));
    });
  };
}

}  // namespace bch::cli
