// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/events.hpp"

#include <algorithm>
#include <tuple>

namespace bch::detail {
namespace {

/// Returns whom an overlap is about, a pair of a frame or an event: what the pairs of a frame are in the order of.
template <class Overlap>
auto who(const Overlap& overlap) {
  return std::tie(overlap.first, overlap.is_wall, overlap.second);
}

OverlapEvent pass_of(const CheckedPair& pair, const Walker& first) {
  return {pair.first,
          pair.second,
          false,
          pair.frame,
          pair.frame,
          static_cast<double>(pair.frame) + static_cast<double>(pair.after),
          1,
          -1,
          first.x + static_cast<double>(pair.way_x),
          first.y + static_cast<double>(pair.way_y)};
}

}  // namespace

void EventLog::add(const CheckedFrame& frame) {
  still_open_.clear();
  auto open = open_.begin();
  auto person = frame.people.begin();
  for (const CheckedPair& pair : frame.pairs) {
    if (!pair.overlap && !pair.passing) continue;
    while (person->walker.id != pair.first) ++person;
    if (pair.passing) {
      closed_.push_back(pass_of(pair, person->walker));
      continue;
    }
    for (; open != open_.end() && who(*open) < who(pair); ++open) closed_.push_back(*open);
    const bool goes_on = open != open_.end() && who(*open) == who(pair);
    OverlapEvent& event =
        still_open_.emplace_back(goes_on ? *open++
                                         : OverlapEvent{pair.first, pair.second, pair.is_wall, frame.frame,
                                                        frame.frame, 0, 0, -1, 0, 0});
    event.to = frame.frame;
    ++event.frames;
    if (pair.depth > event.depth)
      event.depth = pair.depth, event.worst = static_cast<double>(frame.frame), event.x = person->walker.x,
      event.y = person->walker.y;
  }
  closed_.insert(closed_.end(), open, open_.end());
  open_.swap(still_open_);
}

std::vector<OverlapEvent> EventLog::finish() {
  closed_.insert(closed_.end(), open_.begin(), open_.end());
  open_.clear();
  std::sort(closed_.begin(), closed_.end(), [](const OverlapEvent& a, const OverlapEvent& b) {
    return std::tie(a.from, a.first, a.is_wall, a.second) < std::tie(b.from, b.first, b.is_wall, b.second);
  });
  return std::move(closed_);
}

}  // namespace bch::detail
