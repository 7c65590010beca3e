// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string>

#include "bench/base/table.hpp"
#include "bench/stability/stability.hpp"
#include "bench/stability/stiff_contact.hpp"

// Where tests of discs fail, and how depths behave as springs: texts for people, and tables.

namespace bch::bench {

/// Returns a text table for each family.
std::string text_of(std::span<const StabilityRow> rows);
/// Returns a row for each value, with columns for all that was measured.
Table table_of(std::span<const StabilityRow> rows);

std::string text_of(const StiffReport& report);
/// Return a row for each measure, depth and scene of people who press; for each measure and depth of people who touch.
Table press_table(const StiffReport& report);
Table touch_table(const StiffReport& report);

}  // namespace bch::bench
