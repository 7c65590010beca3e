// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>

#include <bch/characters.hpp>

#include "layout/default_character/body_shape.hpp"

namespace bch::detail {

/// Returns the skin and the skeleton of a built-in character, without clips.
Character character_at_rest(std::string name, const BodyShape& shape);

}  // namespace bch::detail
