// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/scenes.hpp"

// Bodies with heights, and crowds on different grounds.

namespace bch::test {

/// Returns people in poses, and bodies of other kinds, some of them without a bottom and a top.
std::vector<Shape> bodies_with_heights(Random& random);

/// Gives half of the agents heights of their own.
void raise(Random& random, Crowd& crowd);

}  // namespace bch::test
