// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include "layout/format/cut_discs.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Returns whether every node above a disc of a cut holds it with the room of layout/base/rounding.hpp, VIII. Bodies made of discs are
/// such; those of outlines are not, because a node's disc is the smallest about the outline below it, not about the discs.
/// `inner`: as in Bvh8. `reach`: of the shape, metres.
bool nodes_hold_discs(const CutDiscs& discs, std::span<const InnerNode> inner, double reach) noexcept;

}  // namespace bch::detail
