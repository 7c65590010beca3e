// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/jupedsim.hpp"

namespace bch::detail::trajectory {

std::unique_ptr<RowSource> open_jupedsim(const std::filesystem::path& file, const TrajectoryOptions&) {
  Places{file, false}.reject("is SQLite, and this program was built without SQLite");
}

}  // namespace bch::detail::trajectory
