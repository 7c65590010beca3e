// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>

#include "layout/recordings/row.hpp"
#include "layout/recordings/trajectory.hpp"

// Private to the readers of recordings: JuPedSim's SQLite files.

namespace bch::detail::trajectory {

/// Opens a file of JuPedSim, of version 1 to 3.
std::unique_ptr<RowSource> open_jupedsim(const std::filesystem::path& file, const TrajectoryOptions& options);

}  // namespace bch::detail::trajectory
