// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <string>

#include <bch/files.hpp>

#include "kernel/recordings/walker_cast.hpp"

namespace bch::detail {

/// Says how fast people walk in the clips of a name, metres a second; 0: they stand.
struct ClipSpeed {
  std::string clip;
  double speed;
};

/// Takes the characters of a baked set for the people of a recording: its shapes are their poses, as large as they were baked. The set
/// shows them from above alone, so that speeds have to be told; clips without one are for rows that name them.
/// Errors:  throws std::invalid_argument, naming the file, where the set does not say what its shapes show, on shapes without outlines, on
///          a speed of a clip that is not there, and on a character without a clip that walks.
Cast baked_cast(const BakedShapes& baked, const std::string& file, std::span<const ClipSpeed> speeds);

}  // namespace bch::detail
