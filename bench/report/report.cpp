// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/report.hpp"

#include <fmt/chrono.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>

#include "bch_commit.hpp"
#include "bench/base/output.hpp"
#include "bench/base/progress.hpp"
#include "bench/workload/scene.hpp"

namespace bch::report {
namespace {

constexpr Experiment all_experiments[] = {
    {"error_time", run_error_time, true},
    {"bodies", run_bodies, true},
    {"construction", run_construction},
    {"query_time", run_query_time},
    {"distance", run_distance, true},
    {"depth", run_depth, true},
    {"volume", run_volume},
    {"mesh_detail", run_mesh_detail},
    {"density", run_density},
    {"detail", run_detail},
    {"motions", run_motions},
    {"stability", run_stability},
    {"stiff", run_stiff},
};

bool wants(const Options& options, std::string_view experiment) {
  return options.experiments.empty() || std::ranges::count(options.experiments, experiment) > 0;
}

std::string processor_name() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.find(": ") + 2, line.size()));
  return "unknown";
}

std::string system_name() {
  utsname name;
  return uname(&name) == 0 ? fmt::format("{} {}, {}", name.sysname, name.release, name.machine) : "unknown";
}

/// What was run, on what, by what.
Table facts_of(const Options& options) {
  std::vector<std::string_view> sets;
  for (const Implementation& one : implementations())
    if (one.supported()) sets.emplace_back(one.name);
  const double gibibytes =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE)) / (1 << 30);
  const Sizes& sizes = options.sizes;
#ifdef __clang__
  constexpr const char* compiler = "Clang " __clang_version__;
#else
  constexpr const char* compiler = "GCC " __VERSION__;
#endif
  const std::pair<const char*, Cell> facts[] = {
      {"processor", processor_name()},
      {"cores", sysconf(_SC_NPROCESSORS_ONLN)},
      {"instruction sets", fmt::format("{}", fmt::join(sets, ", "))},
      {"memory (GiB)", fmt::format("{:.1f}", gibibytes)},
      {"system", system_name()},
      {"compiler", compiler},
      {"build", BCH_BUILD},
      {"commit", BCH_COMMIT},
      {"time", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)))},
      {"command", options.command},
      {"characters", fmt::format("{}", fmt::join(options.characters, ", "))},
      {"seed", options.seed},
      {"poses of a character", sizes.poses},
      {"pairs of a workload", sizes.pairs},
      {"agents of the crowd", sizes.agents},
      {"cases of people who slide", sizes.cases},
      {"runs of what is timed", sizes.runs},
      {"people who are packed", sizes.people},
      {"packings", sizes.packings}};
  Table table({"what", "value"});
  for (const auto& [what, value] : facts) table.add({what, value});
  return table;
}

}  // namespace

std::span<const Experiment> experiments() {
  return all_experiments;
}

void Run::write(const std::string& name, const Table& table) const {
  cli::write_file(options.folder / (name + ".csv"), table.csv());
}

void run_report(const Options& options) {
  bench::Scene scene({.characters = options.characters,
                      .poses = options.sizes.poses,
                      .pose_seed = options.seed,
                      .sizes = {options.sizes.pairs, options.sizes.agents},
                      .draft_models = options.sizes.drafts});
  // First, as a bad file should neither cost minutes nor leave files, and an import wants a process without threads.
  scene.characters();
  cli::make_folder(options.folder);
  cli::write_file(options.folder / "run.csv", facts_of(options).csv());

  std::vector<Experiment> wanted;
  std::ranges::copy_if(all_experiments, std::back_inserter(wanted), [&](const Experiment& experiment) {
    return wants(options, experiment.name) &&
           (!experiment.needs_distances || bench::has_kind("fcl_obb_full"));
  });
  cli::Progress progress("report", wanted.size());
  progress.show();
  for (const Experiment& experiment : wanted) {
    Run run{options, scene};
    experiment.run(run);
    progress.advance();
  }
}

}  // namespace bch::report
