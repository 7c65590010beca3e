// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/pedestrian_archive.hpp"

namespace bch::detail::trajectory {

std::unique_ptr<RowSource> open_pedestrian_archive(const std::filesystem::path& file,
                                                   const TrajectoryOptions&) {
  Places{file, false}.reject("is HDF5, and this program was built without HDF5");
}

}  // namespace bch::detail::trajectory
