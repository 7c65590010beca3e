// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <limits>
#include <span>

#include "bench/report/contestants.hpp"

namespace bch::report {

/// Holds the mean size of trees over shapes; NaN of a structure whose tree is not accessible.
struct TreeSize {
  double nodes = std::numeric_limits<double>::quiet_NaN();
  double height =
      std::numeric_limits<double>::quiet_NaN();  ///< edges on the longest way from the root to a leaf
};

/// Returns the size of hierarchies: for bodies in slabs, the nodes of all slabs and the largest height.
TreeSize tree_size(std::span<const Shape> shapes);
TreeSize tree_size(const Contestant& contestant, std::span<const baselines::Body> bodies);

}  // namespace bch::report
