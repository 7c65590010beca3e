// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include <bch/obstacles.hpp>

namespace bch::detail {

/// Returns, by number of the wall, whether it is a border of the floor: a ring that no other ring encloses,
/// and not a solid obstacle.
std::vector<std::uint8_t> borders_of(const ObstacleSet& walls);

}  // namespace bch::detail
