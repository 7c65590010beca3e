// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/standard.hpp"

namespace bch::test {

/// Makes a model at once: triangles in groups by their places at rest, each group in a sphere about its middle that moves with one of its
/// vertices. Triangles with an edge longer than `longest_edge`, in units of the mesh, are cut there, twice over.
BodyModel plain_model(const Character& character, std::uint32_t spheres, float longest_edge = 0.05f);

}  // namespace bch::test
