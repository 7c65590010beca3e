// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>

#include "layout/recordings/row.hpp"
#include "layout/recordings/trajectory.hpp"

// Private to the readers of recordings: text and CSV.

namespace bch::detail::trajectory {

/// Opens a text whose lines are rows of numbers, as table_layout() says.
std::unique_ptr<RowSource> open_table(const std::filesystem::path& file, const TrajectoryOptions& options);

}  // namespace bch::detail::trajectory
