// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string>

#include <bch/files.hpp>

#include "kernel/recordings/character_library.hpp"

namespace bch::detail {

/// Gives the speed at which people walk in the clips of that name, metres per second; 0: they stand.
struct ClipSpeed {
  std::string clip;
  double speed;
};

/// Returns the characters of a baked set for the people of a recording. Its shapes are their poses, in the
/// sizes that they were baked with. Shapes do not contain speeds, so these are given; clips without a speed
/// are for rows that name them.
/// Errors:  throws std::invalid_argument, naming the file, if the set does not describe its shapes' poses, on
///          shapes without outlines, on a speed of an unknown clip, and on a character without a clip that
///          walks.
CharacterLibrary baked_library(const BakedShapes& baked, const std::string& file,
                               std::span<const ClipSpeed> speeds);

}  // namespace bch::detail
