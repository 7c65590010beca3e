// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/recorded_crowds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/report/words.hpp"

namespace bch::report {
namespace {

std::vector<Source> sources() {
  return {{"juelich_bottleneck_040_c_56_h.txt", made_by_people},
          {"juelich_unidirectional_uo-050-180-180.txt", made_by_people, {.fps = 16, .unit = 0.01}},
          {"data_archive_00_01a.h5", made_by_people},
          {"single_file_n56_cam1.csv", made_by_people, {.fps = 25}},
          {"jpscore_corner_traj.txt", "simulator"},
          {"jupedsim_v2_demo.sqlite", "simulator"},
          {"pathfinder.csv", "simulator"}};
}

}  // namespace

const Bodies outlines{"segments", all_depths, Leaves::segments};
const Bodies four_slabs{"4 slabs", all_depths, Leaves::segments, {0.4f, 0.85f, 1.05f}};

std::vector<Source> wanted_sources(const Run& run) {
  std::vector<Source> kept;
  for (const Source& source : sources())
    if (std::filesystem::exists(run.recordings() / source.file) &&
        open(run, source)->info().rows <= run.sizes().rows)
      kept.push_back(source);
  return kept;
}

std::unique_ptr<detail::TrajectoryReader> open(const Run& run, const Source& source) {
  return detail::open_trajectory(run.recordings() / source.file, source.options);
}

detail::CheckOptions Bodies::options() const {
  detail::CheckOptions options;
  options.plan = {.depths = {depth}, .slices = slices};
  options.leaves = leaves;
  return options;
}

std::vector<Bodies> all_bodies() {
  return {{"single cylinder of the pose", 0, Leaves::discs},
          {"depth 3", 3, Leaves::discs},
          {"depth 6", 6, Leaves::discs},
          {"all depths", all_depths, Leaves::discs},
          outlines,
          four_slabs};
}

double square_distance(const detail::CheckedPerson& a, const detail::CheckedPerson& b) {
  const double x = a.walker.x - b.walker.x, y = a.walker.y - b.walker.y;
  return x * x + y * y;
}

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? std::nan("") : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string range_in(const Table& table, std::string_view of, std::string_view column) {
  const std::size_t colon = of.find(": ");
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::size_t i = 0; i < table.rows().size(); ++i) {
    if (table.text(i, "made by") != of.substr(0, colon) || table.text(i, "structure") != of.substr(colon + 2))
      continue;
    least = std::min(least, table.number(i, column));
    most = std::max(most, table.number(i, column));
  }
  return fmt::format("{} to {}", brief(least), brief(most));
}

}  // namespace bch::report
