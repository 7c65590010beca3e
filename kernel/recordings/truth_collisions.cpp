// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/truth_collisions.hpp"

#include <algorithm>
#include <sstream>

#include "kernel/recordings/frame_run.hpp"

namespace bch::detail {

TruthCollisions::TruthCollisions(TrajectoryReader& truth, double fps) : truth_(truth) {
  if (truth.info().fps != fps) {
    std::ostringstream text;
    text << truth.place_of(0) << ": has " << truth.info().fps << " frames a second, and the prediction "
         << fps;
    throw TrajectoryError(std::move(text).str());
  }
  at_end_ = !truth_.next(read_frame_, read_);
}

void TruthCollisions::add(const CheckedFrame& frame) {
  now_ = {};
  for (const CheckedPerson& person : frame.people)
    now_.predicted.push_back({person.walker.id, person.walker.x, person.walker.y});
  read_truth(frame.frame);
  find(halfway(last_.predicted, now_.predicted), halfway(last_.true_ones, now_.true_ones));
  find(now_.predicted, now_.true_ones);
  std::swap(last_, now_);
}

void TruthCollisions::read_truth(std::int64_t frame) {
  while (!at_end_ && read_frame_ < frame) {
    read_.clear();
    at_end_ = !truth_.next(read_frame_, read_);
  }
  if (at_end_ || read_frame_ > frame) return;
  ++frames_;
  for (const TrackedPerson& person : read_) now_.true_ones.push_back({person.id, person.x, person.y});
}

/// Returns the people who are there before and after, in the middle of their way, but those who jump.
std::vector<TruthCollisions::Place> TruthCollisions::halfway(std::span<const Place> from,
                                                             std::span<const Place> to) {
  std::vector<Place> places;
  auto before = from.begin();
  for (const Place& place : to) {
    while (before != from.end() && before->id < place.id) ++before;
    if (before == from.end() || before->id > place.id) continue;
    const double x = place.x - before->x, y = place.y - before->y;
    if (x * x + y * y <= FrameRun::farthest_step * FrameRun::farthest_step)
      places.push_back({place.id, before->x + x / 2, before->y + y / 2});
  }
  return places;
}

/// Finds whose discs touch those of anybody else.
void TruthCollisions::find(std::span<const Place> predicted, std::vector<Place> others) {
  constexpr double touching = 2 * measured_disc;
  std::sort(others.begin(), others.end(),
            [](const Place& a, const Place& b) { return a.x != b.x ? a.x < b.x : a.id < b.id; });
  for (const Place& own : predicted) {
    auto other = std::lower_bound(others.begin(), others.end(), own.x - touching,
                                  [](const Place& place, double x) { return place.x < x; });
    for (; other != others.end() && other->x <= own.x + touching; ++other) {
      const double x = other->x - own.x, y = other->y - own.y;
      if (other->id == own.id || x * x + y * y > touching * touching) continue;
      colliding_.insert(static_cast<std::uint64_t>(own.id));
      break;
    }
  }
}

}  // namespace bch::detail
