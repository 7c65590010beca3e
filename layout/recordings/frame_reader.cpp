// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/frame_reader.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "layout/base/shortest.hpp"
#include "layout/recordings/row_sorter.hpp"
#include "layout/recordings/survey.hpp"

namespace bch::detail::trajectory {
namespace {

constexpr std::size_t batch_rows = 4096;
constexpr std::size_t max_people = 1'000'000;

std::string position(const Row& row) {
  std::string text = "(";
  return text += shortest(row.x) + ", " + shortest(row.y) + ")";
}

}  // namespace

FrameReader::FrameReader(std::unique_ptr<RowSource> source, const TrajectoryOptions& options)
    : source_(std::move(source)), batch_(batch_rows) {
  const Recording before = source_->recording();
  has_times_ = before.clock == Clock::times;
  if (before.clock == Clock::frames && !before.rate && !options.fps)
    source_->places().reject("says no frame rate: --fps has to give the frame numbers a second");
  const Survey found = survey(before.clock, options);
  if (found.rows == 0) source_->places().reject("has no rows");
  Recording recording = source_->recording();
  info_.format = std::move(recording.format);
  info_.geometry = std::move(recording.geometry);
  info_.assumptions = std::move(recording.assumptions);
  info_.notes = std::move(recording.notes);
  info_.motions = std::move(recording.motions);
  info_.rows = found.rows;
  info_.people = found.ids.count();
  if (recording.origin) settle_origin(*recording.origin, found);
  settle_rate(recording, found, options);
  info_.first_frame = frame_of(found.first);
  info_.last_frame = frame_of(found.last);
}

/// Reads all rows, sorts them if need be, and goes back to the first.
Survey FrameReader::survey(Clock clock, const TrajectoryOptions& options) {
  const auto check_cancelled = [&] {
    if (options.go_on && !options.go_on()) source_->places().reject("reading it was cancelled");
  };
  Survey found;
  if (survey_ordered(*source_, found, check_cancelled)) {
    source_->rewind();
    return found;
  }
  source_->rewind();
  found = {};
  RowSorter sorter(options.sort_memory);
  while (const std::size_t count = source_->read(batch_)) {
    check_cancelled();
    const std::span<const Row> read(batch_.data(), count);
    if (clock == Clock::frames)
      for (const Row& row : read) found.add(row);
    sorter.add(read);
  }
  sorted_ = std::move(sorter).finish();
  if (clock != Clock::frames) {  // whose steps in order matter
    survey_ordered(*sorted_, found, check_cancelled);
    sorted_->rewind();
  }
  return found;
}

/// Lets frames count from the earliest time, whatever the order of rows.
void FrameReader::settle_origin(double origin, const Survey& survey) {
  key_origin_ = survey.first;
  const auto earliest = static_cast<double>(std::llround(origin * microseconds) + survey.first);
  info_.assumptions.push_back("Times and frames count from the earliest time, " +
                              shortest(earliest / microseconds) + " s.");
}

void FrameReader::settle_rate(const Recording& recording, const Survey& survey,
                              const TrajectoryOptions& options) {
  if (options.fps) {
    info_.fps = *options.fps;
  } else if (has_times_) {
    info_.fps = checked_fps(source_->places(), rate_of_times(survey), "the rate of its times");
  } else if (!recording.rate) {
    source_->places().reject("says no frame rate: --fps has to give the frame numbers a second");
  } else {
    info_.fps = *recording.rate;
    if (recording.clock != Clock::row_steps) return;
    const auto step = static_cast<double>(std::max<std::int64_t>(survey.steps.max_common(), 1));
    info_.fps = checked_fps(source_->places(), info_.fps * step, "the rate of its rows times their step");
    info_.assumptions.push_back("The frame rate of " + shortest(*recording.rate) +
                                " is that of rows, whose frame numbers go up by " + shortest(step) +
                                ": there are " + shortest(info_.fps) + " frame numbers a second.");
  }
}

/// The rate at which every time is a frame's; where times are rounded too much for that, the rate of their steps.
double FrameReader::rate_of_times(const Survey& survey) {
  constexpr std::int64_t shortest_step = 1000;  // microseconds
  const std::int64_t common = survey.steps.max_common();
  if (common == 0) source_->places().reject("has a single time, and so no frame rate: --fps has to give it");
  double rate = microseconds / static_cast<double>(survey.steps.divisor());
  std::string how = "the smallest rate at which every time is that of a frame";
  if (survey.steps.divisor() < shortest_step) {
    rate = microseconds / static_cast<double>(common);
    if (std::abs(rate - std::round(rate)) <= 0.01 * rate) rate = std::round(rate);
    how = "that of most steps of time";
  }
  info_.assumptions.push_back("The frame rate is taken for " + shortest(rate) + ", " + how + ".");
  return rate;
}

std::int64_t FrameReader::frame_of(std::int64_t key) const {
  return has_times_ ? std::llround(static_cast<double>(key - key_origin_) / microseconds * info_.fps) : key;
}

/// Reads further rows, if there are any.
bool FrameReader::fill() {
  if (!left_.empty()) return true;
  const std::size_t count = rows().read(batch_);
  left_ = std::span<const Row>(batch_).first(count);
  for (const Row& row : left_) {
    const bool is_known = row.motion == TrackedPerson::no_motion || row.motion < info_.motions.size();
    if (!is_known || (rows_read_ > 0 && row.key < last_key_))
      source_->places().reject("changed while it was read");
    last_key_ = row.key;
    ++rows_read_;
  }
  if (count == 0 && rows_read_ != info_.rows) source_->places().reject("changed while it was read");
  return count > 0;
}

/// Takes the rows of a frame, of which there is one at least.
void FrameReader::gather(std::int64_t frame) {
  frame_rows_.clear();
  while (fill()) {
    std::size_t count = 0;
    while (count < left_.size() && frame_of(left_[count].key) == frame) ++count;
    frame_rows_.insert(frame_rows_.end(), left_.begin(), left_.begin() + static_cast<std::ptrdiff_t>(count));
    left_ = left_.subspan(count);
    if (frame_rows_.size() > max_people)
      source_->places().reject("frame " + std::to_string(frame) + " has more than 1000000 people");
    if (!left_.empty()) break;
  }
  const auto before = [](const Row& a, const Row& b) {
    return std::tie(a.id, a.number) < std::tie(b.id, b.number);
  };
  if (!std::is_sorted(frame_rows_.begin(), frame_rows_.end(), before))
    std::sort(frame_rows_.begin(), frame_rows_.end(), before);
}

void FrameReader::check_frame(std::int64_t frame) const {
  const auto twice = std::adjacent_find(frame_rows_.begin(), frame_rows_.end(),
                                        [](const Row& a, const Row& b) { return a.id == b.id; });
  if (twice == frame_rows_.end()) return;
  const Row &first = *twice, &second = *std::next(twice);
  const Places& places = source_->places();
  const std::string person = "person " + std::to_string(first.id),
                    there = " in frame " + std::to_string(frame);
  if (first.x == second.x && first.y == second.y)
    places.reject(second.number, "repeats " + places.row(first.number) + ", " + person + there);
  places.reject(second.number, person + " is at two places" + there + ", here at " + position(second) +
                                   ", by " + places.row(first.number) + " at " + position(first));
}

bool FrameReader::next(std::int64_t& frame, std::vector<TrackedPerson>& people) {
  people.clear();
  if (!fill()) return false;
  frame = frame_of(left_.front().key);
  gather(frame);
  check_frame(frame);
  people.reserve(frame_rows_.size());
  for (const Row& row : frame_rows_)
    people.push_back(
        {row.id, row.x, row.y, row.heading, row.stature, row.motion, row.clip_seconds, row.number});
  return true;
}

}  // namespace bch::detail::trajectory
