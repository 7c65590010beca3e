// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch::detail {

constexpr std::uint32_t pedestrian_speeds = 74;  ///< clips of default_pedestrian()
constexpr double pedestrian_speed_step = 0.03;   ///< of one to the next, metres per second

/// Returns what pedestrian_strides_per_second() does, for callers under a FloatingPointStateGuard.
inline double strides_per_second(double metres_per_second) {
  return 0.5 * (1.3 + 0.5 * metres_per_second);
}

}  // namespace bch::detail
