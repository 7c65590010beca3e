// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/mpi/crowd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/base/text.hpp"

namespace bch::cli {
namespace {

constexpr std::size_t fields = sizeof(RankReport) / sizeof(double);
static_assert(sizeof(RankReport) == fields * sizeof(double));

double sum(const std::vector<RankReport>& ranks, double RankReport::*field) {
  double sum = 0;
  for (const RankReport& rank : ranks) sum += rank.*field;
  return sum;
}

std::string whole(double number) {
  return grouped(static_cast<std::uint64_t>(number + 0.5));
}

std::string row(std::size_t rank, const RankReport& one) {
  return fmt::format(
      "| {} | {} | {} | {} | {:.1f} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} |\n",
      rank, whole(one.agents), whole(one.halo), whole(one.pairs), one.arrived, whole(one.neighbours),
      one.sent_bytes / std::max(1.0, one.agents), 1e3 * one.cut_seconds, 1e3 * one.migration_seconds,
      1e3 * one.halo_seconds, 1e3 * one.pairs_seconds, 1e3 * one.answer_seconds, 1e-6 * one.memory_bytes);
}

}  // namespace

void RankReport::add(const DistributedCrowd::Counters& step, double steps) {
  const auto mean = [steps](std::uint64_t count) { return static_cast<double>(count) / steps; };
  agents += mean(step.agents), halo += mean(step.halo), pairs += mean(step.pairs);
  arrived += mean(step.arrived), sent_bytes += mean(step.migration_bytes + step.halo_bytes);
  neighbours = std::max(neighbours, static_cast<double>(step.neighbours));
  cut_seconds += step.cut_seconds / steps, migration_seconds += step.migration_seconds / steps;
  halo_seconds += step.halo_seconds / steps, pairs_seconds += step.pairs_seconds / steps;
  answer_seconds += step.answer_seconds / steps;
}

double CrowdReport::agents() const {
  return sum(ranks, &RankReport::agents);
}

double CrowdReport::imbalance() const {
  double most = 0;
  for (const RankReport& rank : ranks) most = std::max(most, rank.pairs);
  return most == 0 ? 1 : most * static_cast<double>(ranks.size()) / sum(ranks, &RankReport::pairs);
}

double CrowdReport::bytes_an_agent() const {
  return sum(ranks, &RankReport::sent_bytes) / std::max(1.0, agents());
}

std::vector<RankReport> gather(MPI_Comm comm, const RankReport& report) {
  int rank, size;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  std::vector<RankReport> all(rank == 0 ? static_cast<std::size_t>(size) : 0);
  MPI_Gather(&report, static_cast<int>(fields), MPI_DOUBLE, all.data(), static_cast<int>(fields), MPI_DOUBLE,
             0, comm);
  return all;
}

std::string text(const CrowdReport& report) {
  std::string table = fmt::format(
      "{} agents on {}, means of {}\n\n"
      "| rank | agents | halo | pairs | arrived | neighbours | bytes sent an agent | ms: cut | migration | "
      "halo | "
      "pairs | answers | MB |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      whole(report.agents()), counted(report.ranks.size(), "rank"),
      counted(static_cast<std::uint64_t>(report.steps), "step"));
  for (std::size_t rank = 0; rank < report.ranks.size(); ++rank) table += row(rank, report.ranks[rank]);
  table += fmt::format(
      "\nA step: {:.2f} ms (median). Imbalance: {:.3f} (the most pairs of a rank over the mean). "
      "Sent: {:.2f} bytes an agent. Cut {}.\n",
      1e3 * report.step_seconds, report.imbalance(), report.bytes_an_agent(),
      counted(static_cast<std::uint64_t>(report.cuts), "time"));
  return table + fmt::format("Collisions of all steps: {}, digest {:016x}\n", whole(report.collisions),
                             report.digest);
}

nlohmann::ordered_json to_json(const CrowdReport& report) {
  nlohmann::ordered_json ranks = nlohmann::ordered_json::array();
  for (const RankReport& one : report.ranks)
    ranks.push_back({{"agents", one.agents},
                     {"halo", one.halo},
                     {"pairs", one.pairs},
                     {"arrived", one.arrived},
                     {"sent_bytes", one.sent_bytes},
                     {"neighbours", one.neighbours},
                     {"seconds",
                      {{"cut", one.cut_seconds},
                       {"migration", one.migration_seconds},
                       {"halo", one.halo_seconds},
                       {"pairs", one.pairs_seconds},
                       {"answers", one.answer_seconds}}},
                     {"memory_bytes", one.memory_bytes}});
  return {{"agents", report.agents()},
          {"steps", report.steps},
          {"step_seconds", report.step_seconds},
          {"imbalance", report.imbalance()},
          {"bytes_an_agent", report.bytes_an_agent()},
          {"cuts", report.cuts},
          {"collisions", report.collisions},
          {"digest", fmt::format("{:016x}", report.digest)},
          {"ranks", ranks}};
}

}  // namespace bch::cli
