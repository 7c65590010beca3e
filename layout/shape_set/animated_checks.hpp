// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/shape_set.hpp>

namespace bch::detail {

/// Checks moving discs, those of slabs too, but for their reach.
/// Errors:  throws std::invalid_argument as AnimatedShape does.
void require_valid(const AnimatedDiscs& discs);

}  // namespace bch::detail
