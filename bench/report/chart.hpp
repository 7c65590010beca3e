// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace bch::report {

/// Puts the scripts of all charts beside the CSV files that they read, so that draw() and other programs can
/// use them.
void write_chart_scripts(const std::filesystem::path& folder);

/// Returns whether gnuplot is installed and can draw SVG.
bool can_draw();

/// Draws a chart by the folder's NAME.gp.
/// Returns: NAME.svg for embedding in a page with others: without prologue, its identifiers beginning with
///          the name; nothing where gnuplot failed.
std::optional<std::string> draw(const std::filesystem::path& folder, std::string_view name);

}  // namespace bch::report
