// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernel/motion/moving_body.hpp"
#include "kernel/motion/moving_disc.hpp"
#include "layout/base/heading.hpp"

namespace bch::detail {

/// The nodes of a moving body over an interval within which its path goes straight on, it turns evenly, and its discs move straight on
/// from key to key: each as a disc that moves straight on from where it is in the beginning to where it is in the end. What
/// turning makes of that is at most bend() away from it.
///
/// Derivation: a centre is p(s) = R(h + turn s) (c + way s), 0 <= s <= 1, beside the straight way of the body. Its second derivative
/// is turn^2 R c(s), turned by half a round, and 2 turn R way, turned by a quarter: no longer than turn^2 reach + 2 |turn| |way|.
/// A curve is at most an eighth of that away from the straight line between its ends, at equal s.
class PlacedNodes {
 public:
  /// Places the root of a body, relative to a point that moves straight on, in an interval before the ends of its path and of its keys.
  void place(const MovingBody& body, const PathKey& from, const PathKey& to) {
    const std::size_t key = body.key();
    chunk_ = &body.chunk(), first_ = chunk_->key(key), last_ = chunk_->key(key + 1);
    share_ = body.share(from.time), share_at_end_ = body.share(to.time);
    turn_ = rotation(from.heading), turn_at_end_ = rotation(to.heading);
    x_ = from.x, y_ = from.y, x_at_end_ = to.x, y_at_end_ = to.y;
    const double turn = std::abs(to.heading - from.heading),
                 way = double{chunk_->speed} * (chunk_->times[key + 1] - chunk_->times[key]) *
                       (share_at_end_ - share_);
    bend_ = (turn * turn * body.tree().reach + 2 * turn * way) / 8;
    const std::size_t room = chunk_->nodes() + animated_width;
    if (discs_[0].size() < room)
      for (std::vector<double>& numbers : discs_) numbers.resize(room);
    if (placed_in_.size() < chunk_->first_leaf()) placed_in_.resize(chunk_->first_leaf(), 0);
    if (++interval_ == 0) std::fill(placed_in_.begin(), placed_in_.end(), 0), interval_ = 1;
    place_eight(0);
  }

  double bend() const noexcept { return bend_; }
  const AnimatedTreeChunk& chunk() const noexcept { return *chunk_; }

  /// Returns a node whose parent was divided, or the root.
  MovingDisc operator[](std::uint32_t node) const noexcept {
    return {discs_[0][node], discs_[1][node], discs_[2][node],
            discs_[3][node], discs_[4][node], discs_[5][node]};
  }
  double radius(std::uint32_t node) const noexcept { return discs_[2][node]; }

  /// Places the children of a node.
  NodeRange divide(std::uint32_t node) noexcept {
    const NodeRange children = chunk_->children(node);
    if (placed_in_[node] != interval_) placed_in_[node] = interval_, place_eight(children.begin);
    return children;
  }
  /// Finds the first times at which eight nodes and a disc are at most `room` apart, as first_overlap() does.
  void first_overlaps(std::uint32_t from, const MovingDisc& other, double room, double last,
                      std::array<double, animated_width>& times) const noexcept {
    const double *const x = discs_[0].data() + from, *const y = discs_[1].data() + from,
                        *const radius = discs_[2].data() + from, *const way_x = discs_[3].data() + from,
                        *const way_y = discs_[4].data() + from, *const growth = discs_[5].data() + from;
    for (std::uint32_t lane = 0; lane < animated_width; ++lane)
      times[lane] = first_overlap({x[lane], y[lane], radius[lane], way_x[lane], way_y[lane], growth[lane]},
                                  other, room, last);
  }

 private:
  /// Places eight nodes, as many of which as are children of one are asked for; what is behind them is there, or comes out the same.
  void place_eight(std::uint32_t from) noexcept {
    // Not members, which a compiler takes to change with what is written.
    const double step = chunk_->step, share = share_, share_at_end = share_at_end_;
    const double cosine = turn_.cosine, sine = turn_.sine, cosine_at_end = turn_at_end_.cosine,
                 sine_at_end = turn_at_end_.sine;
    const double body_x = x_, body_y = y_, body_x_at_end = x_at_end_, body_y_at_end = y_at_end_;
    const auto in_metres = [step](const auto* numbers) {
      std::array<double, animated_width> metres;
      for (std::uint32_t lane = 0; lane < animated_width; ++lane)
        metres[lane] = double{static_cast<float>(numbers[lane])} * step;  // by float, which is vectorised
      return metres;
    };
    auto first_x = in_metres(first_.x + from), first_y = in_metres(first_.y + from),
         first_radius = in_metres(first_.radius + from), last_x = in_metres(last_.x + from),
         last_y = in_metres(last_.y + from), last_radius = in_metres(last_.radius + from);
    std::array<std::array<double, animated_width>, 6> placed;
    auto& [x, y, radius, way_x, way_y, growth] = placed;
    for (std::uint32_t lane = 0; lane < animated_width; ++lane) {
      const double dx = last_x[lane] - first_x[lane], dy = last_y[lane] - first_y[lane],
                   growing = last_radius[lane] - first_radius[lane];
      const double from_x = first_x[lane] + dx * share, from_y = first_y[lane] + dy * share;
      const double to_x = first_x[lane] + dx * share_at_end, to_y = first_y[lane] + dy * share_at_end;
      x[lane] = body_x + (cosine * from_x - sine * from_y);
      y[lane] = body_y + (sine * from_x + cosine * from_y);
      radius[lane] = first_radius[lane] + growing * share;
      way_x[lane] = body_x_at_end + (cosine_at_end * to_x - sine_at_end * to_y) - x[lane];
      way_y[lane] = body_y_at_end + (sine_at_end * to_x + cosine_at_end * to_y) - y[lane];
      growth[lane] = growing * (share_at_end - share);
    }
    for (std::size_t part = 0; part < placed.size(); ++part)
      std::copy(placed[part].begin(), placed[part].end(), discs_[part].begin() + from);
  }

  const AnimatedTreeChunk* chunk_ = nullptr;
  NodesAtKey first_{}, last_{};
  double share_ = 0, share_at_end_ = 0;
  Rotation turn_, turn_at_end_;
  double x_ = 0, y_ = 0, x_at_end_ = 0, y_at_end_ = 0;
  double bend_ = 0;
  std::array<std::vector<double>, 6> discs_;  ///< per node: the members of its MovingDisc
  std::vector<std::uint32_t> placed_in_;      ///< per node with children: the interval that these are of
  std::uint32_t interval_ = 0;
};

/// Finds a first contact in an interval of time, and halves what is behind it until turning bends less than half the tolerance.
/// first_straight(from, end): the share of an interval at which there is one, or never, and what turning bends.
template <class FirstStraight>
double first_halving(double from, double end, double tolerance, const FirstStraight& first_straight) {
  const auto [found, bend] = first_straight(from, end);
  if (found == never) return never;
  const double time = std::min(from + found * (end - from), end), half = time + (end - time) / 2;
  if (2 * bend <= tolerance || !(time < half && half < end)) return time;
  const double sooner = first_halving(time, half, tolerance, first_straight);
  return sooner < never ? sooner : first_halving(half, end, tolerance, first_straight);
}

}  // namespace bch::detail
