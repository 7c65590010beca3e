// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cmath>

#include <bch/hierarchy.hpp>

#include "layout/base/rounding.hpp"

namespace bch::detail {

/// Computes the published radii of discs from the squared radii of the smallest discs: enlarged by a margin and
/// rounded up.
class OutwardRadii {
 public:
  /// Takes the margin that is added to radii, metres.
  explicit OutwardRadii(double margin) : margin_(margin) {}

  void write(double square, Hierarchy::Node& node) const {
    node.disc.radius = rounding::round_up(std::sqrt(square) * (1 + 0x1p-50) + margin_);
  }

 private:
  double margin_;
};

}  // namespace bch::detail
