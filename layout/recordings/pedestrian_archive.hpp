// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>

#include "layout/recordings/row.hpp"
#include "layout/recordings/trajectory.hpp"

// Private to the readers of recordings: HDF5 of the Pedestrian Dynamics Data Archive and of JuPedSim.

namespace bch::detail::trajectory {

/// Opens an HDF5 file with a dataset "trajectory".
/// Errors:  throws TrajectoryError, also in builds without HDF5.
std::unique_ptr<RowSource> open_pedestrian_archive(const std::filesystem::path& file,
                                                   const TrajectoryOptions& options);

}  // namespace bch::detail::trajectory
