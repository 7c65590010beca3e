// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/motion/moving_body.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/motion/path.hpp"

namespace bch::detail {

MotionFacts::MotionFacts(const Motion& motion, const AnimatedShape& body)
    : tree(&body.tree()), path(motion.path), clip_begin(motion.clip_begin) {
  double turning = 0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    farthest = std::max({farthest, std::abs(path[k].x), std::abs(path[k].y)});
    if (k == 0) continue;
    const PathKey &from = path[k - 1], &to = path[k];
    const double x = to.x - from.x, y = to.y - from.y, seconds = to.time - from.time;
    path_speed = std::max(path_speed, std::sqrt(x * x + y * y) / seconds);
    turning = std::max(turning, std::abs(to.heading - from.heading) / seconds);
  }
  speed = path_speed + tree->speed + turning * tree->reach;
}

double MovingBody::path_end(double time) noexcept {
  const auto& path = facts_->path;
  while (next_on_path_ < path.size() && path[next_on_path_].time <= time) ++next_on_path_;
  return next_on_path_ < path.size() ? path[next_on_path_].time : std::numeric_limits<double>::infinity();
}

PathKey MovingBody::pose(double time) const noexcept {
  const auto& path = facts_->path;
  const auto standing = [time](const PathKey& key) { return PathKey{time, key.x, key.y, key.heading}; };
  if (next_on_path_ == 0) return standing(path.front());
  if (next_on_path_ == path.size()) return standing(path.back());
  return between_keys(path[next_on_path_ - 1], path[next_on_path_], time);
}

double MovingBody::clip_end(double time) noexcept {
  constexpr int chunks_before_search = 4;
  if (clip_end_ > time) return clip_end_;
  if (chunks_begun_ == 0) find_key(time);
  for (int i = 0; i < chunks_before_search && clip_end_ <= time; ++i) {
    const bool is_over = chunk().times.back() + shift_ <= time && clip_end_ != time_of(0);
    if (is_over) key_ = chunk().times.size() - 2;
    next_key();
  }
  if (clip_end_ <= time) find_key(time);
  while (clip_end_ <= time) next_key();  // by what rounding may leave
  return clip_end_;
}

/// Before its beginning and after its end a clip stands still: at the first or last key, in share().
void MovingBody::find_key(double time) noexcept {
  const double begin = tree().begin(), length = tree().end() - begin;
  shift_ = facts_->clip_begin - begin;
  if (tree().loops) shift_ += std::floor((time - facts_->clip_begin) / length) * length;
  const KeyPlace place = key_place(tree(), time - shift_);
  chunk_ = place.chunk, key_ = place.key;
  ++chunks_begun_;
  const bool is_over = !tree().loops && time - shift_ >= tree().end();
  clip_end_ = is_over ? std::numeric_limits<double>::infinity() : time_of(key_ + 1);
  if (!tree().loops && time - shift_ < begin) clip_end_ = time_of(0);
}

void MovingBody::next_key() noexcept {
  if (clip_end_ == time_of(0)) {
    // A clip that had not begun.
  } else if (key_ + 2 < chunk().times.size()) {
    ++key_;
  } else if (chunk_ + 1 < tree().chunks.size()) {
    ++chunk_, key_ = 0, ++chunks_begun_;
  } else if (tree().loops) {
    shift_ += tree().end() - tree().begin(), chunk_ = 0, key_ = 0, ++chunks_begun_;
  } else {
    clip_end_ = std::numeric_limits<double>::infinity();
    return;
  }
  clip_end_ = time_of(key_ + 1);
}

double MovingBody::share(double time) const noexcept {
  const double from = time_of(key_), to = time_of(key_ + 1);
  return std::clamp((time - from) / (to - from), 0.0, 1.0);
}

double MovingBody::hull_end(unsigned level) const noexcept {
  const bool moves = clip_end_ == time_of(key_ + 1);
  return moves ? hull(level).end + shift_ : clip_end_;
}

double MovingBody::hull_share(double time, unsigned level) const noexcept {
  const double from = hull(level).begin + shift_, to = hull(level).end + shift_;
  return std::clamp((time - from) / (to - from), 0.0, 1.0);
}

}  // namespace bch::detail
