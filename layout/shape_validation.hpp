// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <functional>

#include "layout/shape_arrays.hpp"

namespace bch {

/// Checks all that queries rely on, so that no arrays that pass make them read elsewhere, whatever else they hold: each
/// begins on a cache line; sizes fit each other; the blocks of a level are a tree in breadth-first order with fewer than most_wide_levels
/// levels; windows lie among their level's discs; offsets ascend; floats are numbers within the library's domain,
/// discs have no negative radius, and what is padding overlaps nothing.
/// `before_nodes`, where there is one, is called before each tree is read, tree after tree, with where its nodes begin,
/// which may be beyond their end: for who wants to look at them at the same time.
/// Errors:  throws std::invalid_argument naming the array, the place in it and the value.
/// Cost:    one pass over the arrays, no allocation.
void validate(const ShapeArrays& arrays, const std::function<void(std::size_t)>& before_nodes = {});

}  // namespace bch
