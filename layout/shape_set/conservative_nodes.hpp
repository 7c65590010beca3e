// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include "layout/format/cut_discs.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Returns whether every node above a disc of a cut encloses it with the margin of layout/base/rounding.hpp, VIII. So
/// do the nodes of bodies made of discs. The nodes of outlines do not, because a node's disc is the smallest around
/// the outline below it, not around the discs.
/// `inner`: as Bvh8::inner_nodes. `max_extent`: of the shape, metres.
bool conservative_nodes(const CutDiscs& discs, std::span<const InnerNode> inner, double max_extent) noexcept;

}  // namespace bch::detail
