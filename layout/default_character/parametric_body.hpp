// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/default_character/body_shape.hpp"
#include "layout/default_character/body_surface.hpp"

namespace bch::detail {

/// Returns the skin of a body at rest: one closed surface, lofted through the sections of trunk, limbs and feet;
/// hands have four fingers and a thumb.
/// Units:   metres, z up, facing +x, soles at z = 0, the crown at the stature.
BodySurface parametric_body(const BodyShape& shape);

}  // namespace bch::detail
