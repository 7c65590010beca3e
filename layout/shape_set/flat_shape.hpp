// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

#include <bch/outline.hpp>

#include "layout/format/shape_arrays.hpp"
#include "layout/shape_set/shape_flattener.hpp"

namespace bch::detail {

/// Returns a shape of a set as ShapeStorage::put() was given it, except for its plan and its outline's grid step, which
/// are not stored. Of a set of single discs only the roots.
FlatBody flat_body(const ShapeArrays& arrays, std::size_t shape);

/// Reads a shape's outline from a set, without its grid step, which is not stored; without contours where the set has none.
Outline outline_of(const ShapeArrays& arrays, std::size_t shape);

}  // namespace bch::detail
