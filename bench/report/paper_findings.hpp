// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include "bench/report/experiment.hpp"

namespace bch::report {

/// Returns what the page's list of the paper's findings needs beside cells of tables: above all verdicts, whether
/// we reproduce or reverse a finding, which the numbers decide.
std::span<const Computed> paper_findings();

}  // namespace bch::report
