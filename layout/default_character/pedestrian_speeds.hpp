// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch::detail {

constexpr std::uint32_t pedestrian_speeds = 74;  ///< clips of default_pedestrian()

}  // namespace bch::detail
