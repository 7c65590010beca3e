// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>
#include <vector>

#include "layout/recordings/row.hpp"
#include "layout/recordings/trajectory.hpp"

// Private to the readers of recordings: text, CSV and tables in memory.

namespace bch::detail::trajectory {

/// Opens a text whose lines are rows of numbers, as table_layout() says.
std::unique_ptr<RowSource> open_table(const std::filesystem::path& file, const TrajectoryOptions& options);

/// Stands for the file's name in messages about columns in memory.
constexpr const char* table_in_memory = "recording";

/// Opens columns in memory, as open_columns() says.
std::unique_ptr<RowSource> open_column_table(std::vector<ColumnView> columns, std::size_t rows,
                                             const TrajectoryOptions& options);

}  // namespace bch::detail::trajectory
