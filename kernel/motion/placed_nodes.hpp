// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kernel/motion/moving_body.hpp"
#include "kernel/motion/moving_disc.hpp"
#include "layout/base/heading.hpp"

namespace bch::detail {

/// The nodes of a moving body over an interval within which its path goes straight on, it turns evenly, and its discs move straight on
/// through a window of keys: each as a disc that moves straight on from where it is in the beginning to where it is in the end. What
/// turning makes of that is at most bend() away from it.
///
/// Derivation: a centre is p(s) = R(h + turn s) (c + way s), 0 <= s <= 1, beside the straight way of the body. Its second derivative
/// is turn^2 R c(s), turned by half a round, and 2 turn R way, turned by a quarter: no longer than turn^2 reach + 2 |turn| |way|.
/// A curve is at most an eighth of that away from the straight line between its ends, at equal s.
class PlacedNodes {
 public:
  /// Places a body, relative to a point that moves straight on, in an interval before the ends of its path and of its window of keys.
  void place(const MovingBody& body, unsigned level, double reach, const PathKey& from, const PathKey& to) {
    const auto [first, last] = body.window(level);
    chunk_ = &body.chunk(), first_ = chunk_->key(first), last_ = chunk_->key(last);
    const KeyWindows& windows = chunk_->windows[level];
    const std::size_t window = first / window_length(level);
    spares_ = level == 0 ? nullptr : windows.spares.data() + window * chunk_->nodes();
    share_ = body.share(from.time, level), share_at_end_ = body.share(to.time, level);
    turn_ = rotation(from.heading), turn_at_end_ = rotation(to.heading);
    x_ = from.x, y_ = from.y, x_at_end_ = to.x, y_at_end_ = to.y;
    const double turn = std::abs(to.heading - from.heading),
                 way = double{windows.steps[window]} * (share_at_end_ - share_);
    bend_ = (turn * turn * reach + 2 * turn * way) / 8;
    if (discs_.size() < chunk_->nodes())
      discs_.resize(chunk_->nodes()), placed_in_.resize(chunk_->nodes(), 0);
    if (++interval_ == 0) std::fill(placed_in_.begin(), placed_in_.end(), 0), interval_ = 1;
  }

  double bend() const noexcept { return bend_; }
  const AnimatedTreeChunk& chunk() const noexcept { return *chunk_; }

  const MovingDisc& operator[](std::uint32_t node) noexcept {
    if (placed_in_[node] != interval_) {
      placed_in_[node] = interval_;
      discs_[node] = placed(node);
      discs_[node].radius += spare(node);
    }
    return discs_[node];
  }
  /// Returns what of a node's radius is there for the keys between.
  double spare(std::uint32_t node) const noexcept {
    return spares_ == nullptr ? 0 : spares_[node] * (steps_of_spare * chunk_->step);
  }

 private:
  MovingDisc placed(std::uint32_t node) const noexcept {
    const double step = chunk_->step, x = first_.x[node] * step, y = first_.y[node] * step,
                 r = first_.radius[node] * step;
    const double way_x = last_.x[node] * step - x, way_y = last_.y[node] * step - y,
                 growth = last_.radius[node] * step - r;
    const double from_x = x + way_x * share_, from_y = y + way_y * share_, radius = r + growth * share_;
    const double to_x = x + way_x * share_at_end_, to_y = y + way_y * share_at_end_;
    MovingDisc disc{x_ + (turn_.cosine * from_x - turn_.sine * from_y),
                    y_ + (turn_.sine * from_x + turn_.cosine * from_y),
                    radius,
                    0,
                    0,
                    growth * (share_at_end_ - share_)};
    disc.way_x = x_at_end_ + (turn_at_end_.cosine * to_x - turn_at_end_.sine * to_y) - disc.x;
    disc.way_y = y_at_end_ + (turn_at_end_.sine * to_x + turn_at_end_.cosine * to_y) - disc.y;
    return disc;
  }

  const AnimatedTreeChunk* chunk_ = nullptr;
  NodesAtKey first_{}, last_{};
  const std::uint16_t* spares_ = nullptr;  ///< or none
  double share_ = 0, share_at_end_ = 0;
  Rotation turn_, turn_at_end_;
  double x_ = 0, y_ = 0, x_at_end_ = 0, y_at_end_ = 0;
  double bend_ = 0;
  std::vector<MovingDisc> discs_;
  std::vector<std::uint32_t> placed_in_;  ///< per node: the interval that its disc is of
  std::uint32_t interval_ = 0;
};

}  // namespace bch::detail
