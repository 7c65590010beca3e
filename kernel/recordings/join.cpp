// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <utility>

#include "kernel/recordings/check.hpp"
#include "kernel/recordings/events.hpp"

namespace bch::detail {
namespace {

/// Goes on with an event in the next interval. Of equally deep frames the first one is the worst.
void go_on(OverlapEvent& event, const OverlapEvent& later) {
  event.to = later.to;
  event.frames += later.frames;
  if (later.depth <= event.depth) return;
  event.depth = later.depth, event.worst = later.worst;
  event.x = later.x, event.y = later.y;
}

/// Joins the events of intervals.
class EventChain {
 public:
  void add(const CheckSummary& interval);
  std::vector<OverlapEvent> finish();

 private:
  std::vector<OverlapEvent> open_;  ///< still in the last frame of the interval; ordered by who()
  std::vector<OverlapEvent> closed_;
};

void EventChain::add(const CheckSummary& interval) {
  std::vector<OverlapEvent> still_open;
  std::vector<std::uint8_t> goes_on(open_.size(), 0);
  for (OverlapEvent event : interval.events) {
    if (event.is_pass()) {
      closed_.push_back(event);
      continue;
    }
    const auto before = std::lower_bound(open_.begin(), open_.end(), event,
                                         [](const auto& a, const auto& b) { return who(a) < who(b); });
    if (event.from == interval.first_frame && before != open_.end() && who(*before) == who(event)) {
      goes_on[static_cast<std::size_t>(before - open_.begin())] = 1;
      go_on(*before, event);
      event = *before;
    }
    (event.to == interval.last_frame ? still_open : closed_).push_back(event);
  }
  for (std::size_t i = 0; i < open_.size(); ++i)
    if (goes_on[i] == 0) closed_.push_back(open_[i]);
  std::sort(still_open.begin(), still_open.end(),
            [](const auto& a, const auto& b) { return who(a) < who(b); });
  open_ = std::move(still_open);
}

std::vector<OverlapEvent> EventChain::finish() {
  closed_.insert(closed_.end(), open_.begin(), open_.end());
  sort_events(closed_);
  return std::move(closed_);
}

}  // namespace

CheckSummary join(std::span<const CheckSummary> intervals) {
  CheckSummary all;
  EventChain events;
  for (const CheckSummary& interval : intervals) {
    all.people = std::max(all.people, interval.people);
    if (interval.frames == 0) continue;
    if (all.frames == 0) all.first_frame = interval.first_frame;
    all.last_frame = interval.last_frame;
    all.frames += interval.frames, all.guessed += interval.guessed, all.passings += interval.passings;
    all.all += interval.all;
    for (std::size_t k = 0; k < all.by_density.size(); ++k) all.by_density[k] += interval.by_density[k];
    all.poses.insert(interval.poses.begin(), interval.poses.end());
    events.add(interval);
  }
  all.events = events.finish();
  return all;
}

}  // namespace bch::detail
