// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "baselines/pair_distances.hpp"
#include "bench/report/contestants.hpp"
#include "bench/report/table.hpp"
#include "bench/workload/scene.hpp"

namespace bch::report {

/// Holds how much is measured, and of discs of which radius.
struct Sizes {
  std::uint32_t poses = 100;      ///< of a character
  std::uint32_t pairs = 20'000;   ///< of a workload
  std::uint32_t agents = 10'000;  ///< of the crowd
  std::uint32_t cases = 500;      ///< of people who slide at each other
  std::uint32_t runs = 9;         ///< of what is timed
  std::uint32_t people = 1'000;   ///< that are packed
  std::uint32_t packings = 3;
  std::uint32_t contacts = 400;    ///< that are near, of a row of the stability tables
  double pressed = 4;              ///< seconds of penalty forces
  std::uint64_t rows = 1'000'000;  ///< of a recording; longer ones are left out
  double disc_radius = 0.2;        ///< metres, of the discs that simulators move
};
constexpr Sizes full_sizes;
constexpr Sizes quick_sizes{20, 2'000, 2'000, 100, 3, 200, 2, 40, 1, 20'000};

/// Limits the poses of a character in experiments that take up to a hundred megabytes, or long, for these.
constexpr std::uint32_t most_costly_poses = 40;

constexpr double millimetres = 1000;  ///< of a metre

/// Represents the context of an experiment: what it runs on and where its tables go.
class Run {
 public:
  using Write = std::function<void(const std::string& name, const Table& table)>;
  using Done = std::function<void(double share)>;

  /// Keeps references to the scene and to the real characters.
  Run(bench::Scene& scene, std::span<const cli::LoadedCharacter> real_characters,
      std::filesystem::path recordings, const Sizes& sizes, std::uint64_t seed, Write write, Done done);

  bench::Scene& scene() { return scene_; }
  /// Returns the real characters; none where there is no folder of them.
  std::span<const cli::LoadedCharacter> real_characters() const { return real_characters_; }
  /// Returns the folder of recordings; it need not be there.
  const std::filesystem::path& recordings() const { return recordings_; }
  const Sizes& sizes() const { return sizes_; }
  std::uint64_t seed() const { return seed_; }
  Contestants& contestants() { return contestants_; }

  /// Returns the distances between the bodies in space; null in a build without FCL.
  const baselines::PairDistances* distances();

  /// Hands over a table, which becomes NAME.csv.
  void write(const std::string& name, const Table& table) const { write_(name, table); }
  /// Reports which share of this experiment is done.
  void done(double share) const { done_(share); }

 private:
  bench::Scene& scene_;
  std::span<const cli::LoadedCharacter> real_characters_;
  std::filesystem::path recordings_;
  Sizes sizes_;
  std::uint64_t seed_;
  Contestants contestants_;
  std::unique_ptr<baselines::PairDistances> distances_;
  Write write_;
  Done done_;
};

/// Returns a table of an experiment, as it was read back.
using Results = std::function<const Table&(std::string_view name)>;

/// Return medians of the experiment `construction`, microseconds: of building a structure, and of one stage of the library's own.
double build_us(const Results& results, std::string_view structure);
double stage_us(const Results& results, std::string_view stage);

/// Represents a number or words of the page that are no cell of a table: {{NAME}} or {{NAME: OF}} in
/// page.html.
struct Computed {
  std::string_view name;
  std::string (*text)(const Results& results, std::string_view of);  ///< in HTML
};

struct Experiment {
  std::string_view name;
  std::string_view title;
  double seconds;        ///< that the full run takes, roughly: the unit of the progress bar
  bool needs_distances;  ///< cannot do without FCL
  void (*run)(Run& run);
  std::vector<Computed> computed = {};
};

/// Returns all experiments, in the order of the page.
std::span<const Experiment> experiments();

extern const Experiment construction_experiment, query_time_experiment, distance_experiment, depth_experiment,
    volume_experiment, threshold_experiment, mesh_detail_experiment, error_time_experiment,
    density_experiment, detail_experiment, motions_experiment, real_experiment, recordings_experiment,
    simulated_experiment, stability_experiment;

}  // namespace bch::report
