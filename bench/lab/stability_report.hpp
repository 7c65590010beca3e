// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string>

#include "bench/report/table.hpp"
#include "bench/stability/stability.hpp"

namespace bch::cli {

/// Writes a table for each family.
std::string text_of(std::span<const bench::StabilityRow> rows);
/// Returns a row for each value, with columns for all that was measured.
report::Table table_of(std::span<const bench::StabilityRow> rows);

}  // namespace bch::cli
