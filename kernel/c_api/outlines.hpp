// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <span>

#include <bch/geometry.hpp>

#include "kernel/c_api/arguments.hpp"

namespace bch::c_api {

/// Writes contours into the arrays of a caller as far as they fit, and counts them all.
class OutlineWriter {
 public:
  explicit OutlineWriter(bch_outline* to)
      : to_(&required(to, "outline")), outline_(sized<bch_outline>(to, BCH_OUTLINE_INIT, "outline")) {
    array_of(outline_.points, outline_.point_capacity, "outline->points");
    array_of(outline_.offsets, outline_.offset_capacity, "outline->offsets");
    outline_.point_count = outline_.offset_count = 0;
    add_offset();
  }

  void add(std::span<const Vec2> contour) {
    for (const Vec2& point : contour) {
      if (outline_.point_count < outline_.point_capacity)
        outline_.points[outline_.point_count] = {point.x, point.y};
      ++outline_.point_count;
    }
    add_offset();
  }

  void finish() { fill(to_, outline_, "outline"); }

 private:
  void add_offset() {
    if (outline_.offset_count < outline_.offset_capacity)
      outline_.offsets[outline_.offset_count] = outline_.point_count;
    ++outline_.offset_count;
  }

  bch_outline* const to_;
  bch_outline outline_;
};

}  // namespace bch::c_api
