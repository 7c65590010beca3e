// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

namespace bch::detail {

/// The margin that spheres leave about what they hold, times its extent and the error allowed. Of these lengths a centre is off by
/// sqrt(3) 2^-24 where its coordinates are rounded to float, a radius by 2 x 2^-24 (it is no longer than both and what a sphere sticks out), and
/// what is computed in double by less than 2^-45.
constexpr double cover_rounding = 0x1p-21;
static_assert(cover_rounding >= (1.7321 + 2) * 0x1p-24 + 0x1p-40);

}  // namespace bch::detail
