// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/recordings/resolved_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>

#include "bench/base/text.hpp"
#include "kernel/runtime/task_ranges.hpp"

// Small are to be the shifts and, times a time squared, their changes: sum |s|^2 + T^2 |ds/dt|^2, where nobody may overlap anybody. Two steps
// in turn approach that: each frame is resolved from the shifts that it has, and the shifts of each person are smoothed in time. A step
// down this sum is a convolution with exp(-|t| / w), times a factor below 1. Resolving comes last.

namespace bch::cli {
namespace {

constexpr int passes = 6;
constexpr double width_seconds = 0.3, factor = 0.9;
constexpr double gap = 0.005;  // metres, in all passes but the last, so that little is left to that one
constexpr std::uint32_t last_sweeps = 400;
constexpr std::size_t frames_of_task = 16;
constexpr std::size_t no_row = static_cast<std::size_t>(-1);

}  // namespace

ResolvedRecording::ResolvedRecording(const OpenedCheck& opened)
    : opened_(opened), bodies_(opened.bodies, opened.library) {}

void ResolvedRecording::add(const detail::CheckedFrame& frame) {
  for (const detail::CheckedPair& pair : frame.pairs) before_ += pair.overlap;
  poses_.insert(poses_.end(), frame.poses.begin(), frame.poses.end());
  for (const detail::CheckedPerson& person : frame.people) {
    const detail::Walker& walker = person.walker;
    const auto [last, is_new] = last_row_.try_emplace(walker.id, size());
    previous_.push_back(is_new ? no_row : last->second);
    last->second = size();
    ids_.push_back(walker.id), seconds_.push_back(frame.seconds);
    x_.push_back(walker.x), y_.push_back(walker.y), heading_.push_back(walker.heading);
    stature_.push_back(walker.stature);
  }
  begin_.push_back(size());
}

void ResolvedRecording::resolve() {
  shift_x_.assign(size(), 0), shift_y_.assign(size(), 0), left_.assign(begin_.size() - 1, 0);
  bodies_.prepare(poses_);
  for (int pass = 0; pass < passes; ++pass) {
    if (pass > 0) smooth(shift_x_), smooth(shift_y_);
    resolve_frames(pass + 1 == passes);
  }
}

void ResolvedRecording::resolve_frames(bool is_last) {
  detail::for_ranges(left_.size(), frames_of_task, [&](std::size_t begin, std::size_t end) {
    const auto crowd = crowds_.borrow([] { return bch::Crowd(); });
    for (std::size_t i = begin; i < end; ++i) resolve_frame(*crowd, i, is_last);
  });
}

void ResolvedRecording::resolve_frame(bch::Crowd& crowd, std::size_t frame, bool is_last) {
  const std::size_t begin = begin_[frame], count = begin_[frame + 1] - begin;
  const BodySet bodies = bodies_.pose(std::span(poses_).subspan(begin, count));
  std::vector<std::uint32_t> shape(count);
  std::iota(shape.begin(), shape.end(), 0);
  std::vector<double> x(count), y(count);
  for (std::size_t i = 0, row = begin; i < count; ++i, ++row)
    x[i] = x_[row] + shift_x_[row], y[i] = y_[row] + shift_y_[row];
  bch::Crowd::ResolveOptions how;
  how.obstacles = opened_.walls ? &*opened_.walls : nullptr;
  if (is_last)
    how.sweeps = last_sweeps;
  else
    how.gap = gap;
  const bch::Crowd::Resolved found =
      crowd.resolve(bodies, {shape, x, y, std::span(heading_).subspan(begin, count)}, how);
  left_[frame] = found.left.size() + found.agents_at_walls.size();
  for (std::size_t i = 0, row = begin; i < count; ++i, ++row)
    shift_x_[row] = found.x[i] - x_[row], shift_y_[row] = found.y[i] - y_[row];
}

/// Takes the mean of each person's shifts, weighted by exp(-|t| / w): sums of earlier rows and of later ones are recursions. Where a person
/// comes or goes, the rows that there are make the mean.
void ResolvedRecording::smooth(std::vector<double>& shift) const {
  std::vector<double> earlier = shift, later = shift, earlier_weight(size(), 1), later_weight(size(), 1);
  const auto add = [&](std::vector<double>& sum, std::vector<double>& weight, std::size_t to,
                       std::size_t from) {
    const double fraction = std::exp(-std::abs(seconds_[to] - seconds_[from]) / width_seconds);
    sum[to] += fraction * sum[from], weight[to] += fraction * weight[from];
  };
  for (std::size_t i = 0; i < size(); ++i)
    if (previous_[i] != no_row) add(earlier, earlier_weight, i, previous_[i]);
  for (std::size_t i = size(); i-- > 0;)
    if (previous_[i] != no_row) add(later, later_weight, previous_[i], i);
  for (std::size_t i = 0; i < size(); ++i)
    shift[i] = factor * (earlier[i] + later[i] - shift[i]) / (earlier_weight[i] + later_weight[i] - 1);
}

std::string ResolvedRecording::csv() const {
  std::string out = "id,time,x,y,heading,stature\n";
  for (std::size_t i = 0; i < size(); ++i)
    fmt::format_to(std::back_inserter(out), "{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}\n", ids_[i], seconds_[i],
                   x_[i] + shift_x_[i], y_[i] + shift_y_[i], heading_[i], stature_[i]);
  return out;
}

std::string ResolvedRecording::report() const {
  const auto mean = [](double sum, std::size_t count) {
    return sum / static_cast<double>(std::max<std::size_t>(1, count));
  };
  double shifts = 0, largest = 0, changes = 0, fastest = 0;
  std::size_t steps = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double shift = std::hypot(shift_x_[i], shift_y_[i]);
    shifts += shift, largest = std::max(largest, shift);
    const std::size_t last = previous_[i];
    if (last == no_row) continue;
    const double change = std::hypot(shift_x_[i] - shift_x_[last], shift_y_[i] - shift_y_[last]) /
                          (seconds_[i] - seconds_[last]);
    changes += change, fastest = std::max(fastest, change), ++steps;
  }
  const auto left = std::accumulate(left_.begin(), left_.end(), std::size_t{0});
  return "\n" +
         fact("resolved",
              fmt::format("{} in frames before, {} after", counted(before_, "overlap"), grouped(left))) +
         fact("shift", fmt::format("{:.4f} m on average, {:.4f} m at most", mean(shifts, size()), largest)) +
         fact("speed", fmt::format("changed by {:.4f} m/s on average, by {:.4f} m/s at most",
                                   mean(changes, steps), fastest));
}

}  // namespace bch::cli
