// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace bch::report {

/// Returns whether gnuplot is installed and can draw SVG.
bool can_draw();

/// Draws by the script bench/report/NAME.gp from the CSV files in a folder, where it puts the script, and those
/// that it loads, for other programs to use.
/// Returns: whether gnuplot is installed and succeeded.
bool draw(const std::filesystem::path& folder, std::string_view name);

/// Returns the folder's NAME.svg for embedding in a page with others: without prologue, its identifiers
/// beginning with the name; empty if there is none.
std::string embedded_picture(const std::filesystem::path& folder, const std::string& name);

}  // namespace bch::report
