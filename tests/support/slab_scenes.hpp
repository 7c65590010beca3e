// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <vector>

#include <bch/shape_set.hpp>

#include "tests/support/scenes.hpp"

// Bodies in slabs, and crowds at different heights.

namespace bch::test {

inline const std::vector<float> three_slabs = {0.4f, 1.0f},
                                eight_slabs = {0.35f, 0.7f, 0.85f, 0.95f, 1.05f, 1.2f, 1.45f};

/// A plan of three levels.
ShapeSetPlan levels_of(std::vector<float> slices, bool culling = true);

/// People in poses, with slabs, and bodies of other kinds that are the same from their bottom to their top.
std::vector<Shape> bodies(Random& random, const ShapeSetPlan& plan);

/// Gives half of the agents heights of their own.
void raise(Random& random, PairScene& scene);

}  // namespace bch::test
