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

/// Holds the nodes of a moving body over an interval within which its path goes straight on, it turns evenly, and its discs move straight
/// on from key to key: each as a disc that moves straight on from where it is in the beginning to where it is in the end. What
/// turning makes of that is at most deviation() away from it.
///
/// Derivation: a centre is p(s) = R(h + turn s) (c + v s), 0 <= s <= 1, plus the straight path of the body. Its second derivative
/// is turn^2 R c(s), turned by half a round, and 2 turn R v, turned by a quarter: no longer than turn^2 reach + 2 |turn| |v|.
/// A curve is at most an eighth of that away from the straight line between its ends, at equal s.
class PlacedNodes {
 public:
  /// Places the root of a body, relative to a point that moves straight on, in an interval before the ends of its path and of its keys:
  /// as spheres, which it has then, or as discs seen from above.
  void place(const MovingBody& body, const PathKey& from, const PathKey& to, bool in_space);

  double deviation() const noexcept { return deviation_; }
  const AnimatedTreeChunk& chunk() const noexcept { return *chunk_; }

  /// Returns a node whose parent was divided, or the root.
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
  /// Finds the first times at which eight nodes and a disc are at most `margin` apart, as first_overlap() does.
  void first_overlaps(std::uint32_t from, const MovingDisc& other, double margin, double last,
                      std::array<double, animated_width>& times) const noexcept;

 private:
  /// Places eight nodes, as many of which as are children of one are asked for; what is behind them is there, or comes out the same.
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
  std::vector<std::uint32_t> placed_in_;      ///< per node with children: the interval that these are of
  std::uint32_t interval_ = 0;
};

/// Finds a first contact in an interval of time, and halves what is behind it until rotation deviates from the chord by less than half the tolerance.
/// first_by_chords(from, end): the fraction of an interval at which there is one, or never, and the deviation from a chord by rotation.
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
