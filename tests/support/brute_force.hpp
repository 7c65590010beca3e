// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "baselines/placement.hpp"
#include "baselines/structure.hpp"

// What is true of two bodies, without trees: every facet that reaches into the other body's bounding box
// against every such facet, by the exact tests.

namespace bch::test {

bool meshes_meet(const baselines::Body& a, const baselines::Body& b, const baselines::Placement& at);
bool outlines_meet(const Outline& a, const Outline& b, const baselines::Placement& at);
bool projections_meet(const baselines::Body& a, const baselines::Body& b, const baselines::Placement& at);

}  // namespace bch::test
