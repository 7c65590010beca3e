// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/check/frame_block.hpp"

#include <algorithm>
#include <cmath>

namespace bch::detail {
namespace {

constexpr double between_frames = 20;  ///< metres, and at least so much for the extent of the places
constexpr double farthest = 4e8;       ///< of a block's frames from each other

}  // namespace

std::size_t FrameBlock::find(std::size_t i, std::int64_t id) const noexcept {
  const auto people = people_of(i);
  const auto found =
      std::lower_bound(people.begin(), people.end(), id,
                       [](const Walker& walker, std::int64_t wanted) { return walker.id < wanted; });
  if (found == people.end() || found->id != id) return people_.size();
  return begin_[i] + static_cast<std::size_t>(found - people.begin());
}

void FrameBlock::keep_last() {
  if (frames_.size() < 2) return;
  const std::int64_t last = frames_.back();
  people_.erase(people_.begin(), people_.begin() + static_cast<std::ptrdiff_t>(begin_[frames_.size() - 1]));
  frames_ = {last};
  begin_ = {0, people_.size()};
}

void FrameBlock::add(const WalkerFrame& frame) {
  frames_.push_back(frame.frame);
  people_.insert(people_.end(), frame.people.begin(), frame.people.end());
  begin_.push_back(people_.size());
}

bool FrameBlock::read(WalkerReader& reader, std::size_t people) {
  keep_last();
  WalkerFrame next;
  bool at_end = false;
  while (!at_end && (people_.size() < people || frames_.size() < 2)) {
    at_end = !reader.next(next);
    if (!at_end) add(next);
  }
  place();
  return at_end;
}

double FrameBlock::longest_step() const noexcept {
  double square = 0;
  for (std::size_t i = 0; i + 1 < frames(); ++i)
    for (const Walker& walker : people_of(i)) {
      const std::size_t next = find(i + 1, walker.id);
      if (next == people_.size()) continue;
      const double dx = people_[next].x - walker.x, dy = people_[next].y - walker.y;
      square = std::max(square, dx * dx + dy * dy);
    }
  return std::sqrt(square);
}

void FrameBlock::place() {
  double low = 0, high = 0;
  for (const Walker& walker : people_) low = std::min(low, walker.x), high = std::max(high, walker.x);
  const double spacing =
      std::min(high - low + between_frames, farthest / static_cast<double>(frames_.size()));
  x_.clear(), y_.clear(), heading_.clear(), own_x_.clear(), frame_of_.clear();
  for (std::size_t i = 0; i < frames_.size(); ++i)
    for (const Walker& walker : people_of(i)) {
      x_.push_back(walker.x + spacing * static_cast<double>(i));
      y_.push_back(walker.y);
      heading_.push_back(walker.heading);
      own_x_.push_back(walker.x);
      frame_of_.push_back(i);
    }
}

}  // namespace bch::detail
