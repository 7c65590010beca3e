// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "layout/format/agents.hpp"
#include "layout/shape_set/shape_set.hpp"

namespace bch {

/// Throws the errors of collide() for the agents alone: sizes, shapes, levels, positions, headings.
void validate(const ShapeSet& shapes, const Agents& agents);

}  // namespace bch
