// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernel/motion/moving_body.hpp"
#include "kernel/motion/moving_disc.hpp"
#include "layout/base/heading.hpp"

namespace bch::detail {

/// Holds the nodes of a moving body over an interval of time, each as a disc that moves along the chord from
/// its first to its last position. In the interval the path is a straight line, the rotation is even, and in
/// the body's frame every disc moves along a straight line. Rotation makes a disc deviate from its chord by
/// at most deviation().
///
/// Derivation. For 0 <= s <= 1, a centre is
///
///     p(s) = R(h + turn s) (c + v s) + (the straight path of the body)
///     |p''| <= turn^2 |c + v s| + 2 |turn| |v| <= turn^2 extent + 2 |turn| |v|
///
/// and a curve deviates from its chord, at equal s, by at most max |p''| / 8.
class PlacedNodes {
 public:
  /// Places the root of a body relative to a point that moves along a straight line. The interval contains no
  /// key of the path or clip. `in_space`: as spheres, if the body has spheres; otherwise as discs seen from
  /// above.
  void place(const MovingBody& body, const PathKey& from, const PathKey& to, bool in_space);

  double deviation() const noexcept { return deviation_; }
  const AnimatedTreeChunk& chunk() const noexcept { return *chunk_; }

  /// Returns the root, or a node whose parent was passed to divide().
  MovingDisc operator[](std::uint32_t node) const noexcept {
    return {discs_[0][node], discs_[1][node], discs_[2][node], discs_[3][node],
            discs_[4][node], discs_[5][node], discs_[6][node], discs_[7][node]};
  }
  double radius(std::uint32_t node) const noexcept { return discs_[2][node]; }

  /// Places the children of a node.
  NodeRange divide(std::uint32_t node) noexcept {
    const NodeRange children = chunk_->children(node);
    if (placed_in_[node] != interval_) placed_in_[node] = interval_, place_eight(children.begin);
    return children;
  }
  /// Calls first_overlap() for eight nodes and a disc.
  void first_overlaps(std::uint32_t from, const MovingDisc& other, double margin, double last,
                      std::array<double, animated_width>& times) const noexcept;

 private:
  /// Places eight successive nodes: the children of one node and, if these are fewer than eight, nodes behind
  /// them. Memory for those exists, and their values do not depend on which call places them.
  void place_eight(std::uint32_t from) noexcept;

  const AnimatedTreeChunk* chunk_ = nullptr;
  NodesAtKey first_{}, last_{};
  double fraction_ = 0, fraction_at_end_ = 0;
  Rotation turn_, turn_at_end_;
  double x_ = 0, y_ = 0, x_at_end_ = 0, y_at_end_ = 0;
  double z_ = 0, z_at_end_ = 0;
  bool in_space_ = false;
  double deviation_ = 0;
  std::array<std::vector<double>, 8> discs_;  ///< per node: the members of its MovingDisc
  std::vector<std::uint32_t>
      placed_in_;  ///< per node with children: the interval for which these were placed
  std::uint32_t interval_ = 0;
};

/// Finds the first contact in an interval of time by bisection. Where discs on chords touch, the rest of the
/// interval is halved and searched again, until the deviation from chords is at most half the tolerance.
/// first_by_chords(from, end): the fraction of an interval at which discs on chords first touch, or never,
/// and the deviation.
template <class FirstStraight>
double first_by_bisection(double from, double end, double tolerance, const FirstStraight& first_by_chords) {
  const auto [found, deviation] = first_by_chords(from, end);
  if (found == never) return never;
  const double time = std::min(from + found * (end - from), end), half = time + (end - time) / 2;
  if (2 * deviation <= tolerance || !(time < half && half < end)) return time;
  const double sooner = first_by_bisection(time, half, tolerance, first_by_chords);
  return sooner < never ? sooner : first_by_bisection(half, end, tolerance, first_by_chords);
}

}  // namespace bch::detail
