// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <memory>

#include "layout/recordings/row.hpp"
#include "layout/recordings/trajectory.hpp"

// Private to the readers of recordings: TrajNet++'s lines of JSON.

namespace bch::detail::trajectory {

/// Opens a file of lines such as {"track": {"f": 780, "p": 1, "x": 8.46, "y": 3.59}} and
/// {"scene": {"id": 1, "p": 1, "s": 780, "e": 980, "fps": 2.5}}. Of several predictions, the first is taken.
std::unique_ptr<RowSource> open_ndjson(const std::filesystem::path& file, const TrajectoryOptions& options);

}  // namespace bch::detail::trajectory
