// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include <bch/character.hpp>
#include <bch/geometry.hpp>

namespace bch::detail {

/// Returns the heights that triangles of a character take at all real times of a clip, rounded outward.
///
/// Heights are looked at in short windows, in each of which a vertex leaves the chord between its ends by at most A h^2 / 8: h is the
/// window's length, and A bounds the acceleration.
/// Errors:  throws std::invalid_argument as MotionBounds does.
Heights clip_heights(const Character& character, std::uint32_t clip);

}  // namespace bch::detail
