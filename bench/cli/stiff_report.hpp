// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bench/stability/stiff_contact.hpp"

namespace bch::cli {

std::string text_of(const bench::StiffReport& report);
/// Writes a row for each measure and depth, with columns for all that was measured.
std::string csv_of(const bench::StiffReport& report);
nlohmann::ordered_json json_of(const bench::StiffReport& report);

}  // namespace bch::cli
