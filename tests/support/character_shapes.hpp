// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/scenes.hpp"

namespace bch::test {

/// Returns the folder that the environment variable BCH_TEST_DATA names; empty where it is unset.
std::optional<std::filesystem::path> test_data();

/// Builds contour hierarchies at 1 cm of poses spread over the character's clips; on all threads.
std::vector<Shape> pose_shapes(const Character& character, std::uint32_t poses);

/// Returns people in poses, and bodies of other kinds, some of them without a bottom and a top.
std::vector<Shape> bodies_with_heights(Random& random);

/// Gives half of the agents heights of their own.
void raise(Random& random, Crowd& crowd);

}  // namespace bch::test
