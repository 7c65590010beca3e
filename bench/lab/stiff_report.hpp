// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>

#include "bench/report/table.hpp"
#include "bench/stability/stiff_contact.hpp"

namespace bch::cli {

std::string text_of(const bench::StiffReport& report);
/// Returns a row for each measure and depth, with columns for all that was measured.
report::Table table_of(const bench::StiffReport& report);

}  // namespace bch::cli
