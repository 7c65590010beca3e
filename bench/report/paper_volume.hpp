// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "bench/report/experiment.hpp"

namespace bch::report {

/// Writes volume_paper.csv: figure 7 and table 1 of the paper, in its own terms, of the scene's characters and, where these
/// have the built-in man, of the bulky one.
void measure_paper_volumes(Run& run);

}  // namespace bch::report
