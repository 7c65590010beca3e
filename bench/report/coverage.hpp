// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include "layout/base/disc.hpp"
#include "layout/format/outline.hpp"

namespace bch::report {

/// The pixel size of the grid for counting areas: 6.25 megapixels per square metre; the paper has more than
/// 6.
constexpr double pixel = 0.0004;  // metres

/// Areas in square metres, by counting the pixels whose centres are covered.
struct Coverage {
  double discs = 0;    ///< by some disc
  double filled = 0;   ///< by some disc or the inside of the outline
  double outline = 0;  ///< by the inside of the outline
};

Coverage rasterise(const Outline& outline, std::span<const Disc> discs);

}  // namespace bch::report
