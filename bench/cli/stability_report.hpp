// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "bench/stability/stability.hpp"

namespace bch::cli {

/// Writes a table for each family.
std::string text_of(std::span<const bench::StabilityRow> rows);
std::string csv_of(std::span<const bench::StabilityRow> rows);
nlohmann::ordered_json json_of(std::span<const bench::StabilityRow> rows);

}  // namespace bch::cli
