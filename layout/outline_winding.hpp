// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include "layout/outline_walk.hpp"

namespace bch {

/// Whether a point is inside a contour or on it, exactly.
bool covers(std::span<const Stretch> contour, GridPoint point);

}  // namespace bch
