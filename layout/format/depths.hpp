// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

namespace bch {

/// The depth of a cut that has no limit: its discs are the leaves.
constexpr std::uint32_t all_depths = 0xffffffff;

}  // namespace bch
