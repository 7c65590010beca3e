// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/recent_steps.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/recordings/frame_run.hpp"
#include "kernel/runtime/task_ranges.hpp"

namespace bch::detail {
namespace {

constexpr double step_cell = 1;  ///< metres
constexpr double touching = 2 * measured_disc;

std::int64_t step_column(double x) {
  return static_cast<std::int64_t>(std::floor(x / step_cell));
}

std::uint64_t step_key(std::int64_t column, std::int64_t row) {
  return static_cast<std::uint64_t>(column) << 32 ^ static_cast<std::uint64_t>(row & 0xffff'ffff);
}

}  // namespace

void RecentSteps::add(double seconds, std::span<const CheckedPerson> people,
                      std::span<MeasuredPerson> measures) {
  now_.clear();
  auto before = last_.begin();
  for (const CheckedPerson& person : people) {
    const Place& to = now_.emplace_back(Place{person.walker.id, person.walker.x, person.walker.y});
    while (before != last_.end() && before->id < to.id) ++before;
    const bool was_there = before != last_.end() && before->id == to.id;
    const double x = was_there ? to.x - before->x : 0, y = was_there ? to.y - before->y : 0;
    const bool walked = was_there && x * x + y * y <= FrameRun::farthest_step * FrameRun::farthest_step;
    remember(walked ? *before : to, to, walked ? last_seconds_ : seconds, seconds);
  }
  for_ranges(now_.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) measures[i].encroachment = since(now_[i], seconds);
  });
  last_.swap(now_);
  last_seconds_ = seconds;
  if (seconds - forgotten_ > measured_seconds) forget(seconds - measured_seconds), forgotten_ = seconds;
}

/// Adds a step to all cells that it comes near.
void RecentSteps::remember(const Place& from, const Place& to, double begin, double end) {
  const auto [left, right] = std::minmax(from.x, to.x);
  const auto [low, high] = std::minmax(from.y, to.y);
  for (std::int64_t row = step_column(low - touching); row <= step_column(high + touching); ++row)
    for (std::int64_t column = step_column(left - touching); column <= step_column(right + touching);
         ++column) {
      const double corner_x = static_cast<double>(column) * step_cell,
                   corner_y = static_cast<double>(row) * step_cell;
      cells_[step_key(column, row)].push_back(
          {from.id, end, static_cast<float>(end - begin), static_cast<float>(from.x - corner_x),
           static_cast<float>(from.y - corner_y), static_cast<float>(to.x - from.x),
           static_cast<float>(to.y - from.y)});
    }
}

/// Returns how long before `seconds` somebody else last touched a disc: of each step the last time of touching, from the newest step on.
float RecentSteps::since(const Place& place, double seconds) const {
  const std::int64_t column = step_column(place.x), row = step_column(place.y);
  const auto found = cells_.find(step_key(column, row));
  if (found == cells_.end()) return MeasuredPerson::infinite;
  const double own_x = place.x - static_cast<double>(column) * step_cell,
               own_y = place.y - static_cast<double>(row) * step_cell;
  double least = measured_seconds;
  bool is_found = false;
  const std::vector<Step>& steps = found->second;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    const double duration = static_cast<double>(step->duration), ended = seconds - step->end;
    if (ended > least) break;
    if (step->id == place.id) continue;
    // Back from the end of the step.
    const double way_x = static_cast<double>(step->way_x), way_y = static_cast<double>(step->way_y),
                 x = static_cast<double>(step->x) + way_x - own_x,
                 y = static_cast<double>(step->y) + way_y - own_y;
    const double back = disc_collision(x, y, -way_x, -way_y, touching);
    if (!(back <= 1)) continue;
    const double since = ended + back * duration;
    if (since <= least) least = since, is_found = true;
  }
  return is_found ? static_cast<float>(least) : MeasuredPerson::infinite;
}

/// Drops the steps that end before a time.
void RecentSteps::forget(double before) {
  for (auto entry = cells_.begin(); entry != cells_.end();) {
    std::vector<Step>& steps = entry->second;
    const auto kept =
        std::find_if(steps.begin(), steps.end(), [&](const Step& step) { return step.end >= before; });
    if (kept == steps.end()) {
      entry = cells_.erase(entry);
      continue;
    }
    steps.erase(steps.begin(), kept);
    ++entry;
  }
}

}  // namespace bch::detail
