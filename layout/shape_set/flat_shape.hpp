// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

#include <bch/outline.hpp>

#include "layout/format/shape_arrays.hpp"
#include "layout/shape_set/shape_flattener.hpp"

namespace bch::detail {

/// Returns a shape of a set as it was given to ShapeStorage::store(), but without its plan and its outline's grid
/// step, which are not stored. From a set of single discs it returns only the roots.
FlatBody flat_body(const ShapeArrays& arrays, std::size_t shape);

/// Returns a shape's outline without its grid step, which is not stored. The outline has no contours if the set has
/// no outlines.
Outline outline_of(const ShapeArrays& arrays, std::size_t shape);

}  // namespace bch::detail
