// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/motion/moving_body.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/motion/path.hpp"
#include "layout/base/number_class.hpp"

namespace bch::detail {
namespace {

/// Returns the fraction of the interval [from, to] before `time`; 0 if both are equal, as rounding may make
/// them.
double fraction_between(double from, double to, double time) noexcept {
  return from < to ? std::clamp((time - from) / (to - from), 0.0, 1.0) : 0;
}

}  // namespace

MotionFacts::MotionFacts(const Motion& motion)
    : tree(&motion.shape->tree()), path(motion.path), clip_begin(motion.clip_begin) {
  for (std::size_t k = 0; k < path.size(); ++k) {
    farthest = std::max({farthest, std::abs(path[k].x), std::abs(path[k].y), std::abs(path[k].z)});
    if (k == 0) continue;
    const PathKey &from = path[k - 1], &to = path[k];
    const double x = to.x - from.x, y = to.y - from.y, seconds = to.time - from.time;
    path_speed = std::max(path_speed, std::sqrt(x * x + y * y) / seconds);
  }
}

double MovingBody::path_end(double time) noexcept {
  const auto& path = facts_->path;
  while (next_on_path_ < path.size() && path[next_on_path_].time <= time) ++next_on_path_;
  return next_on_path_ < path.size() ? path[next_on_path_].time : std::numeric_limits<double>::infinity();
}

double MovingBody::time_slack(double time) const noexcept {
  constexpr double largest_time = 1e6 + 1;
  const auto& path = facts_->path;
  const bool is_before = next_on_path_ == 0, goes = !is_before && next_on_path_ < path.size();
  const double end = is_before || goes ? path[next_on_path_].time : largest_time,
               latest = std::max(std::abs(goes ? path[next_on_path_ - 1].time : time), std::abs(end)),
               of_clip = std::max(std::abs(tree().begin()), std::abs(tree().end()));
  const double rounding = time_rounding * (latest + 2 * std::abs(facts_->clip_begin) + 3 * of_clip),
               of_discs = std::min(2 * (tree().max_extent + tree().height), rounding * tree().speed);
  if (!goes) return of_discs;
  const PathKey &from = path[next_on_path_ - 1], &to = path[next_on_path_];
  const double x = to.x - from.x, y = to.y - from.y, z = to.z - from.z,
               turn = std::abs(to.heading - from.heading);
  const double fraction = std::min(1.0, rounding / (to.time - from.time));
  return of_discs + fraction * (std::sqrt(x * x + y * y + z * z) + turn * tree().max_extent);
}

PathKey MovingBody::pose(double time) const noexcept {
  const auto& path = facts_->path;
  const auto standing = [time](PathKey key) { return key.time = time, key; };
  if (next_on_path_ == 0) return standing(path.front());
  if (next_on_path_ == path.size()) return standing(path.back());
  return between_keys(path[next_on_path_ - 1], path[next_on_path_], time);
}

double MovingBody::clip_end(double time) noexcept {
  constexpr int chunks_before_search = 4;
  if (clip_end_ > time) return clip_end_;
  if (chunks_begun_ == 0) find_key(time);
  for (int i = 0; i < chunks_before_search && clip_end_ <= time; ++i) {
    const bool is_over = !is_before_begin_ && chunk().times.back() + shift_ <= time;
    if (is_over) key_ = chunk().times.size() - 2;
    next_key();
  }
  if (clip_end_ <= time) find_key(time);
  while (clip_end_ <= time) next_key();  // needed only after rounding
  return clip_end_;
}

double MovingBody::period(double time) noexcept {
  if (tree().loops) return tree().length();
  return is_infinite(clip_end(time)) ? 0 : std::numeric_limits<double>::infinity();
}

/// Before its beginning and after its end a clip stands still at its first or last key; fraction() then
/// clamps.
void MovingBody::find_key(double time) noexcept {
  begin_cycle(tree().loops ? std::floor((time - facts_->clip_begin) / tree().length()) : 0);
  const KeyPlace place = key_place(tree(), time - shift_);
  chunk_ = place.chunk, key_ = place.key;
  ++chunks_begun_;
  const bool is_over = !tree().loops && time - shift_ >= tree().end();
  is_before_begin_ = !tree().loops && time - shift_ < tree().begin();
  clip_end_ = is_over ? std::numeric_limits<double>::infinity() : time_of(is_before_begin_ ? 0 : key_ + 1);
}

void MovingBody::next_key() noexcept {
  if (is_before_begin_) {
    is_before_begin_ = false;
  } else if (key_ + 2 < chunk().times.size()) {
    ++key_;
  } else if (chunk_ + 1 < tree().chunks.size()) {
    ++chunk_, key_ = 0, ++chunks_begun_;
  } else if (tree().loops) {
    begin_cycle(cycle_ + 1);
    chunk_ = 0, key_ = 0, ++chunks_begun_;
  } else {
    clip_end_ = std::numeric_limits<double>::infinity();
    return;
  }
  clip_end_ = time_of(key_ + 1);
}

/// Computes the shift from the number of the cycle, so that rounding does not accumulate.
void MovingBody::begin_cycle(double cycle) noexcept {
  cycle_ = cycle;
  shift_ = facts_->clip_begin - tree().begin() + cycle * tree().length();
}

double MovingBody::fraction(double time) const noexcept {
  return fraction_between(time_of(key_), time_of(key_ + 1), time);
}

double MovingBody::hull_end(unsigned level) const noexcept {
  const bool moves = !is_before_begin_ && is_finite(clip_end_);
  return moves ? hull(level).end + shift_ : clip_end_;
}

double MovingBody::hull_fraction(double time, unsigned level) const noexcept {
  return fraction_between(hull(level).begin + shift_, hull(level).end + shift_, time);
}

}  // namespace bch::detail
