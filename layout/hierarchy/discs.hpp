// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include <bch/hierarchy.hpp>

namespace bch::detail {

/// Builds the hierarchy of shape_from_discs(), with the same errors. The leaves are in the order of the discs.
Hierarchy disc_hierarchy(std::span<const Disc> discs);

}  // namespace bch::detail
