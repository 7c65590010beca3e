// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/hierarchy.hpp>

namespace bch::detail {

/// Returns, per node, the least radius about its disc's centre that encloses the discs of all its descendants,
/// rounded up. A search for nearest discs can prune by it. For a leaf it is the radius of its disc.
std::vector<float> bounding_radii(const Hierarchy& hierarchy);

/// Returns, per node, the index after the last node of its subtree.
std::vector<std::uint32_t> subtree_ends(std::span<const Hierarchy::Node> nodes);

}  // namespace bch::detail
