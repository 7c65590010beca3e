// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bench/base/csv_input.hpp"
#include "bench/workload/scene.hpp"

// The paper's experiments. They write what they measure, value by value, as CSV files; report.py says what that means.

namespace bch::report {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Holds a text as CSV has it, or a number in as many digits as tell it from every other double; NaN is an empty cell.
struct Cell {
  std::string text;

  Cell(std::string_view words) : text(cli::csv_field(std::string(words))) {}
  Cell(const std::string& words) : Cell(std::string_view(words)) {}
  Cell(const char* words) : Cell(std::string_view(words)) {}
  Cell(double number) : text(std::isnan(number) ? std::string() : fmt::format("{}", number)) {}
  template <std::integral Integer>
  Cell(Integer number) : text(std::to_string(number)) {}
};

/// Builds a CSV file. Columns of numbers name their unit.
class Table {
 public:
  explicit Table(const std::vector<Cell>& columns) : columns_(columns.size()) { add(columns); }

  /// Adds a row. Shapes: as many cells as columns, else throws std::logic_error.
  void add(const std::vector<Cell>& cells) {
    if (cells.size() != columns_)
      throw std::logic_error(fmt::format("a table of {} columns got a row of {}", columns_, cells.size()));
    for (std::size_t i = 0; i < cells.size(); ++i) (csv_ += i > 0 ? "," : "") += cells[i].text;
    csv_ += '\n';
  }

  const std::string& csv() const { return csv_; }

 private:
  std::size_t columns_;
  std::string csv_;
};

/// Holds how much is measured.
struct Sizes {
  std::uint32_t poses = 100;      ///< of a character
  std::uint32_t pairs = 20'000;   ///< of a workload
  std::uint32_t agents = 10'000;  ///< of the crowd
  std::uint32_t cases = 500;      ///< of people who slide at each other
  std::uint32_t runs = 9;         ///< of what is timed
  std::uint32_t people = 1'000;   ///< that are packed
  std::uint32_t packings = 3;
  std::uint32_t contacts = 400;     ///< that are near, of a row of the stability tables
  std::uint32_t max_spheres = 512;  ///< of a body
  bool drafts = false;              ///< models of spheres that nobody improved
};
constexpr Sizes full_sizes;
constexpr Sizes quick_sizes{20, 2'000, 2'000, 100, 3, 200, 2, 40, 256, true};
constexpr Sizes smallest_sizes{2, 60, 80, 6, 1, 10, 1, 4, 64, true};

/// Limits the poses of a character in experiments that take up to a hundred megabytes, or long, for these.
constexpr std::uint32_t max_costly_poses = 40;

struct Options {
  std::filesystem::path folder;
  std::vector<std::string> characters = {"default:male", "default:female"};
  std::vector<std::string> experiments;  ///< none: all
  Sizes sizes = full_sizes;
  std::uint64_t seed = 1;
  std::string command;  ///< that does all this again
};

/// Represents the context of an experiment: what it runs on and where its tables go.
struct Run {
  const Options& options;
  bench::Scene& scene;

  const Sizes& sizes() const { return options.sizes; }
  std::uint64_t seed() const { return options.seed; }
  /// Writes NAME.csv.
  void write(const std::string& name, const Table& table) const;
};

struct Experiment {
  std::string_view name;
  void (*run)(Run& run);
  bool needs_distances = false;  ///< cannot do without FCL
};

/// Returns all experiments, in the order of the page.
std::span<const Experiment> experiments();

void run_error_time(Run& run);
void run_bodies(Run& run);
void run_construction(Run& run);
void run_query_time(Run& run);
void run_distance(Run& run);
void run_depth(Run& run);
void run_volume(Run& run);
void run_mesh_detail(Run& run);
void run_density(Run& run);
void run_detail(Run& run);
void run_motions(Run& run);
void run_stability(Run& run);
void run_stiff(Run& run);

/// Runs experiments, in the order of the page, and writes the tables of each, NAME*.csv, into the folder; and run.csv with machine,
/// compiler, commit, seed, options and command.
/// Errors:  throws cli::InputError where something cannot be read or written, as cli::load_character() does, and
///          whatever an experiment finds wrong.
void run_report(const Options& options);

}  // namespace bch::report
