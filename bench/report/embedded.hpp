// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string_view>

// Files of bench/report that the program carries with it.

namespace bch::report {

/// Returns page.html.
std::string_view page_template();

/// Holds a gnuplot script, NAME.gp.
struct ChartScript {
  std::string_view name, text;
};
std::span<const ChartScript> chart_scripts();

}  // namespace bch::report
