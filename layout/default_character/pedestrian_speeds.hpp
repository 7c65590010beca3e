// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch::detail {

constexpr std::uint32_t pedestrian_speeds = 74;  ///< clips of default_pedestrian()
constexpr double pedestrian_speed_step = 0.03;   ///< of one to the next, metres per second

}  // namespace bch::detail
