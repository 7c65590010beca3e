// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "kernel/obstacles/near_segments.hpp"

namespace bch::detail {

/// Finds the largest value of a linear function at the ends of segments. A corner of their convex hull has it; along the hull
/// the values ascend to it and descend again, so that n queries of n ends take n log n steps.
///
/// The hull is computed in double: an end that is wrongly taken for one inside protrudes by no more than rounding moves ends.
class EndsHull {
 public:
  using Point = ObstaclePlace::Vector;

  void clear() noexcept { ends_.clear(); }
  void add(Point end) { ends_.push_back(end); }
  /// Computes the hull of the ends that were added, at least one.
  void close() {
    std::sort(ends_.begin(), ends_.end(),
              [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    make_chain(lower_, 1);
    make_chain(upper_, -1);
  }

  /// Returns the largest value of a function that is linear except for rounding. (On one of the chains it may descend first; the
  /// other one then has the largest value, and no computed value is too large.)
  template <class Linear>
  double most(const Linear& of) const {
    return std::max(top_of(lower_, of), top_of(upper_, of));
  }

 private:
  /// Makes the chain of corners from the first end to the last that turns left at every corner (1) or right (-1).
  void make_chain(std::vector<Point>& chain, double turn) {
    chain.clear();
    for (const Point& end : ends_) {
      while (chain.size() > 1 && !(turn * side(chain[chain.size() - 2], chain.back(), end) > 0))
        chain.pop_back();
      chain.push_back(end);
    }
  }
  static double side(Point a, Point b, Point c) noexcept {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }

  template <class Linear>
  static double top_of(const std::vector<Point>& chain, const Linear& of) {
    std::size_t low = 0, high = chain.size() - 1;
    while (low < high) {
      const std::size_t middle = low + (high - low) / 2;
      if (of(chain[middle]) < of(chain[middle + 1]))
        low = middle + 1;
      else
        high = middle;
    }
    return of(chain[low]);
  }

  std::vector<Point> ends_, lower_, upper_;
};

}  // namespace bch::detail
