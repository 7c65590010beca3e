// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include <bch/obstacles.hpp>

namespace bch::detail {

/// Returns which walls, by number, are borders of the floor: rings that no other ring encloses. Those of solid obstacles are none.
std::vector<std::uint8_t> borders_of(const ObstacleSet& walls);

}  // namespace bch::detail
