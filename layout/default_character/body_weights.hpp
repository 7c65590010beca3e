// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <bch/characters.hpp>

#include "layout/default_character/body_surface.hpp"

namespace bch::detail {

/// Gives a character without clips its skin: vertices, triangles and weights, a bone for each joint. The tags
/// of the surface are weights that jump from ring to ring; they are diffused along the mesh so that a joint
/// bends over about a hand's breadth. At most `max_influences` bones a vertex.
inline constexpr std::size_t max_influences = 5;
void attach_skin(Character& character, const BodySurface& surface, const JointPositions& joints);

}  // namespace bch::detail
