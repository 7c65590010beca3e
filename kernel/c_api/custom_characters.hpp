// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

#include <bch/characters.hpp>

#include "kernel/c_api/failure.hpp"

namespace bch::c_api {

/// Returns a mesh as a character of one joint, at the agent's position, which all vertices follow.
/// Errors:  as validate(character).
Character character_of_mesh(std::span<const bch_vec3> positions, std::span<const std::uint32_t> corners);

}  // namespace bch::c_api
