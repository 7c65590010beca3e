// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>
#include <sys/resource.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include <bch/crowd.hpp>
#include <bch/distributed_crowd.hpp>
#include <bch/files.hpp>

#include "bench/base/exit_codes.hpp"
#include "bench/base/options.hpp"
#include "bench/base/output.hpp"
#include "bench/base/stopwatch.hpp"
#include "bench/mpi/crowd.hpp"
#include "kernel/distributed/agreement.hpp"
#include "layout/base/random.hpp"

namespace bch::cli {
namespace {

constexpr double stride = 1.3 / 30;           ///< metres a step
constexpr std::uint32_t steps_to_settle = 3;  ///< all agents migrate, then the crowd is cut by pairs

struct WalkOptions {
  std::string file, kind = "uniform", json;
  std::uint32_t agents = 100'000, steps = 10, threads = 1;
  double density = 3, imbalance = DistributedCrowdOptions{}.imbalance, agent_pairs = 0;
  bool is_plain = false;
};

double occupied_bytes() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<double>(usage.ru_maxrss);
}

std::uint64_t hash(std::uint32_t first, std::uint32_t second) {
  return detail::Random(std::uint64_t{first} << 32 | second).next();
}

/// The numbers of the agents that a rank draws: every so many-th, from everywhere.
std::vector<DistributedCrowd::Agent> draw_agents(const WalkOptions& options, std::uint32_t shapes, int rank,
                                                 int size) {
  const Scenery scenery(options.kind, options.agents, options.density);
  std::vector<DistributedCrowd::Agent> agents;
  agents.reserve(options.agents / static_cast<std::uint32_t>(size) + 1);
  for (std::uint64_t i = static_cast<std::uint64_t>(rank); i < options.agents;
       i += static_cast<std::uint64_t>(size))
    agents.push_back(scenery.agent(i, shapes));
  return agents;
}

void walk_on(std::vector<DistributedCrowd::Agent>& agents) {
  for (DistributedCrowd::Agent& agent : agents)
    agent.x += stride * std::cos(agent.heading), agent.y += stride * std::sin(agent.heading);
}

/// The crowd of all ranks.
class RankWalk {
 public:
  RankWalk(MPI_Comm comm, const ShapeSet& shapes, std::vector<DistributedCrowd::Agent> agents,
           const WalkOptions& options)
      : crowd_(comm, shapes, std::move(agents),
               {.imbalance = options.imbalance, .agent_pairs = options.agent_pairs}) {}
  void step() { crowd_.update(), pairs_ = crowd_.collide_all(); }
  void move() { walk_on(crowd_.agents()); }
  DistributedCrowd::Counters counters() const { return crowd_.counters(); }
  void count(double& collisions, std::uint64_t& digest) const {
    collisions += static_cast<double>(pairs_.size());
    for (const Pair& pair : pairs_) digest += hash(pair.first, pair.second);
  }

 private:
  DistributedCrowd crowd_;
  std::span<const Pair> pairs_;
};

/// The same crowd in one process, asked by Crowd: what the above is compared with.
class PlainWalk {
 public:
  PlainWalk(const ShapeSet& shapes, std::vector<DistributedCrowd::Agent> agents)
      : shapes_(shapes), agents_(std::move(agents)) {}
  void step() {
    using Agent = DistributedCrowd::Agent;
    pairs_ = finder_.collisions(shapes_, {member(&Agent::shape), member(&Agent::x), member(&Agent::y),
                                          member(&Agent::heading), member(&Agent::level)});
  }
  void move() { walk_on(agents_); }
  DistributedCrowd::Counters counters() const { return {.agents = agents_.size()}; }
  void count(double& collisions, std::uint64_t& digest) const {
    for (const auto [i, j] : pairs_) ++collisions, digest += hash(i, j);
  }

 private:
  template <class Value>
  Strided<Value> member(Value DistributedCrowd::Agent::*value) const {
    if (agents_.empty()) return {};
    return {&(agents_[0].*value), agents_.size(), sizeof(DistributedCrowd::Agent)};
  }

  const ShapeSet& shapes_;
  std::vector<DistributedCrowd::Agent> agents_;
  bch::Crowd finder_;
  bch::Crowd::Pairs pairs_;
};

/// Walks, and reports of the steps after those to settle; `before`: what the process occupied already.
template <class Walk>
CrowdReport report_of(Walk& walk, MPI_Comm comm, std::uint32_t steps, double before) {
  CrowdReport report;
  report.steps = static_cast<double>(steps);
  RankReport here;
  std::vector<double> seconds;
  for (std::uint32_t i = 0; i < steps + steps_to_settle; ++i, walk.move()) {
    MPI_Barrier(comm);
    const double begin = MPI_Wtime();
    walk.step();
    double took = MPI_Wtime() - begin;
    walk.count(report.collisions, report.digest);
    MPI_Allreduce(MPI_IN_PLACE, &took, 1, MPI_DOUBLE, MPI_MAX, comm);
    if (i < steps_to_settle) continue;
    seconds.push_back(took);
    here.add(walk.counters(), report.steps);
  }
  here.memory_bytes = occupied_bytes() - before;
  MPI_Allreduce(MPI_IN_PLACE, &report.collisions, 1, MPI_DOUBLE, MPI_SUM, comm);
  MPI_Allreduce(MPI_IN_PLACE, &report.digest, 1, MPI_UINT64_T, MPI_SUM, comm);
  report.step_seconds = bench::median(seconds);
  report.cuts = walk.counters().cuts;
  report.ranks = gather(comm, here);
  return report;
}

CrowdReport walk_crowd(const WalkOptions& options, MPI_Comm comm, int rank, int size) {
  std::optional<BakedShapes> baked;
  std::vector<DistributedCrowd::Agent> agents;
  double before = 0;
  detail::agree(comm, [&] {
    baked.emplace(load_baked(options.file, FileAccess::map));
    before = occupied_bytes();
    agents = draw_agents(options, baked->set.shape_count(), rank, size);
    for (DistributedCrowd::Agent& agent : agents)
      agent.level = static_cast<std::uint8_t>(baked->set.level_count() - 1);
  });
  if (options.is_plain) {
    PlainWalk walk(baked->set, std::move(agents));
    return report_of(walk, comm, options.steps, before);
  }
  RankWalk walk(comm, baked->set, std::move(agents), options);
  return report_of(walk, comm, options.steps, before);
}

void run(const WalkOptions& options, MPI_Comm comm) {
  int rank, size;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  if (options.is_plain && size > 1) throw UsageError("--plain: one process, and there are several ranks");
  detail::agree(comm, [&] {
    if (rank == 0) require_outputs({{"--json", options.json}}, {options.file});
  });
  const Threads threads(options.threads);
  const CrowdReport report = walk_crowd(options, comm, rank, size);
  detail::agree(comm, [&] {
    if (rank != 0) return;
    write_standard_output(text(report));
    write_json(options.json, to_json(report));
  });
}

}  // namespace

std::function<void()> add_crowd_command(CLI::App& program, MPI_Comm comm) {
  const auto options = std::make_shared<WalkOptions>();
  CLI::App& command = *program.add_subcommand(
      "crowd", "Walk a crowd that is divided among the ranks, and report the work and time of each rank");
  const OptionAdder add(command);
  add("file", options->file, "FILE", "Baked file of shapes (bch bake); every rank maps it")->required();
  add("--agents", options->agents, "N", "Total number of agents [100000]", whole_between(1, 4'000'000'000));
  add("--kind", options->kind, "NAME",
      "Kind of crowd: uniform, spot (a dense place), stadium or street [uniform]", one_of(scenery_kinds));
  add("--density", options->density, "D", "Agents per square metre [3]", number_between(1e-6, 1e3));
  add("--steps", options->steps, "N", "Number of measured steps [10]", whole_between(1, 1'000'000));
  add("--imbalance", options->imbalance, "R",
      "Divide the crowd anew if a rank has more than R times the mean number of pairs [1.04]",
      number_between(1, 1e6));
  add("--agent-pairs", options->agent_pairs, "N",
      "Weight of an agent, in pairs, when work is balanced; 1.3 balances time [0]", number_between(0, 1000));
  add("--threads", options->threads, "N", "Threads per rank [1]", whole_between(1, 1024));
  command.add_flag("--plain", options->is_plain, "Use Crowd in one process instead, for comparison");
  add("--json", options->json, "FILE", "Write the report as JSON");
  return [options, comm] { run(*options, comm); };
}

}  // namespace bch::cli
