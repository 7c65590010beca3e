// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <span>

#include <bch/geometry.hpp>

namespace bch::detail {

/// The most planes that cut a mesh.
constexpr std::size_t most_planes = 63;

/// Requires planes to be finite, to ascend, and to be no more than that.
/// Errors:  throws std::invalid_argument, naming the plane.
void require_planes(std::span<const float> planes);

/// Returns the height of a plane, between the float that names it and the next one, so that no vertex lies in it.
double height_of(float plane);

}  // namespace bch::detail
