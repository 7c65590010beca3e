// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/hierarchy.hpp>

namespace bch::detail {

/// Returns per node the least radius about its disc's centre that holds the discs of all nodes below, rounded up: what a search
/// for the nearest discs of the binary tree may prune by. A leaf's is its disc's.
std::vector<float> bounding_radii(const Hierarchy& hierarchy);

/// Returns one past the last node of the subtree under each node.
std::vector<std::uint32_t> subtree_ends(std::span<const Hierarchy::Node> nodes);

}  // namespace bch::detail
