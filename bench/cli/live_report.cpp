// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/base/median.hpp"
#include "bench/base/text.hpp"
#include "bench/cli/live.hpp"

namespace bch::cli {
namespace {

double bytes_per_body(const LiveRun& run) {
  return static_cast<double>(run.bodies.set().bytes()) / run.bodies.set().body_count();
}

struct TimeRow {
  const char* name;
  std::vector<double> milliseconds;

  double least() const { return *std::min_element(milliseconds.begin(), milliseconds.end()); }
};

std::vector<TimeRow> rows_of(const FrameTimes& times) {
  return {{"posing", times.posing}, {"queries", times.queries}, {"frame", times.whole()}};
}

}  // namespace

std::vector<double> FrameTimes::whole() const {
  std::vector<double> sums = posing;
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += queries[i];
  return sums;
}

std::string text_report(const LiveRun& run) {
  std::string table = fmt::format("{:<12}{:>9} {:>9}\n", "ms a frame", "median", "least");
  for (const TimeRow& row : rows_of(run.times))
    table += fmt::format("{:<12}{:>9.2f} {:>9.2f}\n", row.name, median(row.milliseconds), row.least());
  return fact("characters", names_of(run.characters)) +
         fact("bodies", fmt::format("{} each, {:.1f} kB each", counted(run.options.spheres, "sphere"),
                                    bytes_per_body(run) / 1e3)) +
         fact("agents", agents_text(run.options, run.crowd.crowd())) +
         fact("frames", fmt::format("{} of 1/60 s, in which everybody is posed anew",
                                    grouped(run.times.posing.size()))) +
         fact("kernel", fmt::format("{}, {}", run.implementation, counted(run.threads, "thread"))) + "\n" +
         table + "\n" +
         fmt::format("{} in the last frame, of {} whose discs meet.\n",
                     counted(run.collisions.size(), "collision"), counted(run.candidates.size(), "pair")) +
         fmt::format("{} compared with brute force: the same answers.\n", counted(run.checked, "pair"));
}

nlohmann::ordered_json json_report(const LiveRun& run) {
  const CrowdOptions& options = run.options;
  nlohmann::ordered_json json{{"program", "bch " BCH_VERSION},
                              {"options",
                               {{"characters", options.characters},
                                {"agents", options.agents},
                                {"density_per_m2", options.density},
                                {"seed", options.seed},
                                {"spheres", options.spheres},
                                {"frames", options.frames}}},
                              {"kernel", {{"implementation", run.implementation}, {"threads", run.threads}}},
                              {"bytes_per_body", bytes_per_body(run)},
                              {"candidate_pairs", run.candidates.size()},
                              {"collisions", run.collisions.size()},
                              {"checked_pairs", run.checked}};
  for (const TimeRow& row : rows_of(run.times))
    json["milliseconds"][row.name] = {{"median", median(row.milliseconds)}, {"least", row.least()}};
  return json;
}

}  // namespace bch::cli
