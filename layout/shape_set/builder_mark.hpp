// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

#include "layout/shape_set/shape_storage.hpp"

namespace bch::detail {

/// Marks the end of a set that is being built: the number of its shapes, and where the parts of the next shape begin.
struct BuilderMark {
  std::size_t shapes = 0;
  ShapeExtent extent{.rows = first_row};
};

}  // namespace bch::detail
