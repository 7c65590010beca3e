// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "bench/recordings/recording_check.hpp"
#include "kernel/runtime/task_ranges.hpp"

namespace bch::cli {

using namespace detail;

namespace {

/// Joins lines(begin, end) of successive items, which are formatted in tasks.
template <class Lines>
std::string lines_of(std::size_t count, const Lines& lines) {
  constexpr std::size_t at_once = 512;
  std::vector<std::string> parts((count + at_once - 1) / at_once);
  for_ranges(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      parts[k] = lines(k * at_once, std::min(count, (k + 1) * at_once));
  });
  std::string all;
  for (const std::string& part : parts) all += part;
  return all;
}

}  // namespace

std::string measure_lines(const CheckedFrame& frame) {
  return lines_of(frame.people.size(), [&](std::size_t begin, std::size_t end) {
    std::string lines;
    for (std::size_t i = begin; i < end; ++i) {
      const CheckedPerson& person = frame.people[i];
      const MeasuredPerson& of = frame.measures[i];
      fmt::format_to(
          std::back_inserter(lines),
          "{},{:.4f},{},{:.3f},{:.3f},{},{},{:.4f},{:.4f},{:.3f},{:.3f},{:.3f},{:.4g},{:.4g},{:.4g},"
          "{:.4g},{:d},{:d}\n",
          frame.frame, frame.seconds, person.walker.id, person.density, of.voronoi_density, of.intimate,
          of.personal, of.clearance, of.disc_clearance, of.time, of.disc_time, of.encroachment, of.intrusion,
          of.disc_intrusion, MeasuredPerson::avoidance(of.time), MeasuredPerson::avoidance(of.disc_time),
          of.collides, of.disc_collides);
    }
    return lines;
  });
}

std::string conflict_lines(const CheckedFrame& frame) {
  return lines_of(frame.measured_pairs.size(), [&](std::size_t begin, std::size_t end) {
    std::string lines;
    for (const MeasuredPair& pair : frame.measured_pairs.subspan(begin, end - begin))
      fmt::format_to(std::back_inserter(lines), "{},{:.4f},{},{},{:.4f},{:.4f},{:.4f},{:.3f},{:.3f}\n",
                     frame.frame, frame.seconds, pair.first, pair.second, pair.distance, pair.clearance,
                     pair.disc_clearance, pair.time, pair.disc_time);
    return lines;
  });
}

}  // namespace bch::cli
