// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/frame_block.hpp"

#include <algorithm>

namespace bch::detail {
namespace {

constexpr double between_frames = 20;  ///< metres, and at least so much for the extent of the places
constexpr double farthest = 4e8;       ///< of a block's frames from each other

}  // namespace

void FrameBlock::begin_with_last_of(const FrameBlock& before) {
  frames_.clear(), people_.clear();
  begin_ = {0};
  if (before.frames() == 0) return;
  frames_.push_back(before.frames_.back());
  people_.assign(before.people_.begin() + static_cast<std::ptrdiff_t>(before.begin(before.frames() - 1)),
                 before.people_.end());
  begin_.push_back(people_.size());
}

void FrameBlock::add(const WalkerFrame& frame) {
  frames_.push_back(frame.frame);
  people_.insert(people_.end(), frame.people.begin(), frame.people.end());
  begin_.push_back(people_.size());
}

bool FrameBlock::read(WalkerReader& reader, std::size_t people, const FrameBlock& before) {
  begin_with_last_of(before);
  WalkerFrame next;
  bool at_end = false;
  while (!at_end && (people_.size() < people || frames_.size() < 2)) {
    at_end = !reader.next(next);
    if (!at_end) add(next);
  }
  place();
  next_of_.assign(people_.size(), nobody);
  for (std::size_t i = 0; i + 1 < frames_.size(); ++i) find_next(i);
  return at_end;
}

/// Both frames are in the order of ids.
void FrameBlock::find_next(std::size_t frame) {
  std::size_t next = begin_[frame + 1];
  for (std::size_t i = begin_[frame]; i < begin_[frame + 1]; ++i) {
    while (next < begin_[frame + 2] && people_[next].id < people_[i].id) ++next;
    if (next < begin_[frame + 2] && people_[next].id == people_[i].id)
      next_of_[i] = static_cast<std::uint32_t>(next);
  }
}

void FrameBlock::place() {
  double low = 0, high = 0;
  for (const Walker& walker : people_) low = std::min(low, walker.x), high = std::max(high, walker.x);
  const double spacing =
      std::min(high - low + between_frames, farthest / static_cast<double>(frames_.size()));
  for (std::vector<double>* const values : {&x_, &y_, &heading_, &apart_x_}) values->resize(people_.size());
  frame_of_.resize(people_.size());
  for (std::size_t i = 0; i < frames_.size(); ++i)
    for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k) {
      const Walker& walker = people_[k];
      x_[k] = walker.x, y_[k] = walker.y, heading_[k] = walker.heading;
      apart_x_[k] = walker.x + spacing * static_cast<double>(i);
      frame_of_[k] = static_cast<std::uint32_t>(i);
    }
}

}  // namespace bch::detail
