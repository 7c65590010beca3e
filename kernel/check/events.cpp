// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/check/events.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace bch::detail {

void EventLog::add(const CheckedFrame& frame) {
  for (const CheckedPair& pair : frame.pairs) {
    if (!pair.overlap && !pair.passing) continue;
    const auto who =
        std::lower_bound(frame.people.begin(), frame.people.end(), pair.first,
                         [](const CheckedPerson& a, std::int64_t id) { return a.walker.id < id; });
    const auto [entry, is_new] = open_.try_emplace({pair.first, pair.second, pair.is_wall});
    OverlapEvent& event = entry->second;
    if (is_new)
      event = {pair.first, pair.second, pair.is_wall, frame.frame, frame.frame, frame.frame, 0, -1, 0, 0};
    event.to = frame.frame;
    ++event.frames;
    if (pair.overlap && pair.depth > event.depth)
      event.depth = pair.depth, event.worst = frame.frame, event.x = who->walker.x, event.y = who->walker.y;
  }
  for (auto entry = open_.begin(); entry != open_.end();) {
    const auto next = std::next(entry);
    if (entry->second.to != frame.frame) {
      closed_.push_back(entry->second);
      open_.erase(entry);
    }
    entry = next;
  }
}

std::vector<OverlapEvent> EventLog::finish() {
  for (const auto& [who, event] : open_) closed_.push_back(event);
  open_.clear();
  std::sort(closed_.begin(), closed_.end(), [](const OverlapEvent& a, const OverlapEvent& b) {
    return std::tie(a.from, a.first, a.is_wall, a.second) < std::tie(b.from, b.first, b.is_wall, b.second);
  });
  return std::move(closed_);
}

}  // namespace bch::detail
