// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <CLI/CLI.hpp>

#include "bench/workload/scene.hpp"

namespace bch::bench {

/// Adds the options by which a command line chooses how much to measure on.
void add_size_options(CLI::App& program, SceneOptions& options);

}  // namespace bch::bench
