// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <functional>

#include "layout/format/shape_arrays.hpp"

namespace bch::detail {

/// Checks all of shape_preconditions(). With arrays that pass, queries read nothing out of bounds, and a pair takes
/// at most a small multiple of the time that it takes in an honest set of that size. Culling data, discs and outlines
/// are not checked against each other, because that takes longer than building them: see verify().
/// `before_nodes`, if given, is called before each tree is read, tree after tree, with the position where the tree's
/// nodes begin, which may be beyond their end. So a caller can process the nodes at the same time.
/// Errors:  throws std::invalid_argument naming the array, the place in it and the value.
/// Cost:    one pass over the arrays, no allocation.
void validate(const ShapeArrays& arrays, const std::function<void(std::size_t)>& before_nodes = {});

}  // namespace bch::detail
