// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace bch::report {

/// bench/report/NAME.gp.
struct ChartScript {
  std::string_view name, text;
};
std::span<const ChartScript> chart_scripts();

/// Puts the scripts of all charts beside the CSV files that they read, for draw() and others to draw by.
void write_chart_scripts(const std::filesystem::path& folder);

/// Whether gnuplot is there and can draw SVG.
bool can_draw();

/// Draws by the folder's NAME.gp.
/// Returns: NAME.svg for a page that has others: without prologue, its identifiers beginning with the name; nothing where
///          gnuplot failed.
std::optional<std::string> draw(const std::filesystem::path& folder, std::string_view name);

}  // namespace bch::report
