// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/workload/scene_options.hpp"

namespace bch::bench {

void add_size_options(CLI::App& program, SceneOptions& options) {
  program.add_option("--poses", options.poses, "Poses of a character [100]")
      ->type_name("N")
      ->check(CLI::Range(1u, 100'000u));
  program.add_option("--pairs", options.sizes.pairs, "Pairs of a workload, the crowd's aside [20000]")
      ->type_name("N")
      ->check(CLI::Range(1u, 10'000'000u));
  program.add_option("--agents", options.sizes.agents, "Agents of the crowd [10000]")
      ->type_name("N")
      ->check(CLI::Range(2u, 1'000'000u));
}

}  // namespace bch::bench
