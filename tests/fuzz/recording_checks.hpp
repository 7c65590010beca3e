// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <filesystem>

#include "layout/recordings/trajectory.hpp"

namespace bch::fuzz {

/// Reads a recording of any bytes: it is refused with a TrajectoryError of one line, or frames ascend, ids in them too, and
/// every value is in range.
void check_recording(const std::filesystem::path& file, const detail::TrajectoryOptions& options);

}  // namespace bch::fuzz
