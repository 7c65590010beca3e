// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bench/report/experiment.hpp"
#include "kernel/recordings/check.hpp"

// The recordings of the test data and the bodies that experiments put on them.

namespace bch::report {

constexpr double near = 1.2;  ///< metres, of neighbours
constexpr std::string_view made_by_people = "people";

/// Represents a recording of the test data, and what its file does not say.
struct Source {
  const char* file;
  std::string_view made_by;  ///< people or a simulator
  detail::TrajectoryOptions options = {};
};

/// Returns the recordings that are there and not too long.
std::vector<Source> wanted_sources(const Run& run);
std::unique_ptr<detail::TrajectoryReader> open(const Run& run, const Source& source);

/// Selects how bodies are tested.
struct Bodies {
  const char* name;
  std::uint32_t depth;
  Leaves leaves;
  std::vector<float> slices = {};

  detail::CheckOptions options() const;
};

extern const Bodies outlines, four_slabs;
/// Returns all kinds of bodies, looser ones first; `outlines` and `four_slabs` are the last.
std::vector<Bodies> all_bodies();

double square_distance(const detail::CheckedPerson& a, const detail::CheckedPerson& b);
/// Returns a share in percent; NaN of nothing.
double percent(std::uint64_t part, std::uint64_t whole);

/// Returns the least and the greatest number in a column, of all recordings that were made by "people" or a "simulator" and tested with a
/// structure: of "people: segments".
std::string range_in(const Table& table, std::string_view of, std::string_view column);

}  // namespace bch::report
