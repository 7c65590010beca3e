// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/geometry.hpp>
#include <bch/outline.hpp>
#include <bch/shape_set.hpp>

namespace bch::report {

/// The pixel size of the grid for counting areas: 6.25 megapixels per square metre; the paper has more than
/// 6.
constexpr double pixel = 0.0004;  // metres

/// Holds areas in square metres, by counting the pixels whose centres are covered.
struct Coverage {
  double discs = 0;    ///< by some disc
  double filled = 0;   ///< by some disc or the inside of the outline
  double outline = 0;  ///< by the inside of the outline
};

Coverage rasterise(const Outline& outline, std::span<const Disc> discs);

}  // namespace bch::report
