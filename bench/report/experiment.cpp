// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/experiment.hpp"

#include <utility>

namespace bch::report {

Run::Run(bench::Scene& scene, std::span<const cli::LoadedCharacter> real_characters,
         std::filesystem::path recordings, const Sizes& sizes, std::uint64_t seed, Write write, Done done)
    : scene_(scene),
      real_characters_(real_characters),
      recordings_(std::move(recordings)),
      sizes_(sizes),
      seed_(seed),
      contestants_(scene),
      write_(std::move(write)),
      done_(std::move(done)) {}

const baselines::PairDistances* Run::distances() {
  if (!distances_) distances_ = baselines::fcl_mesh_distances(scene_.bodies());
  return distances_.get();
}

std::span<const Experiment> experiments() {
  static const Experiment all[] = {error_time_experiment, construction_experiment, query_time_experiment,
                                   distance_experiment,   real_experiment,         depth_experiment,
                                   volume_experiment,     threshold_experiment,    mesh_detail_experiment,
                                   density_experiment,    detail_experiment,       motions_experiment,
                                   recordings_experiment, simulated_experiment,    stability_experiment};
  return all;
}

}  // namespace bch::report
