// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>

#include "layout/shape_set/shape_storage.hpp"

namespace bch::detail {

/// Holds where a set that is being built ends: how many shapes and parts there are, and where the next one begins.
struct BuilderMark {
  std::size_t shapes = 0;
  ShapeExtent extent{.rows = first_row};
};

}  // namespace bch::detail
