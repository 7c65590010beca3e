// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/walkers.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "layout/base/number_class.hpp"
#include "layout/base/random.hpp"
#include "layout/default_character/pedestrian_speeds.hpp"

namespace bch::detail {
namespace {

constexpr double smoothing = 0.4;           ///< seconds before and after
constexpr double jump = 100;                ///< metres
constexpr double fastest = 20;              ///< metres a second, a jump aside
constexpr std::size_t few_people = 1024;    ///< are not worth looking for those who have left
constexpr double slowest_direction = 0.15;  ///< metres a second: who is slower has no direction
constexpr double first_step = 0.25;         ///< metres: heads of those who stand sway by less
constexpr double look_ahead = 10;           ///< seconds, at most, for that step
constexpr std::size_t max_rows_ahead = 200'000;

Random random_of(std::int64_t id) {
  return Random(0x9e3779b97f4a7c15u ^ static_cast<std::uint64_t>(id));
}

}  // namespace

bool is_female_by_id(std::int64_t id) {
  return random_of(id).below(2) == 0;
}

/// About normal, by the sum of uniform numbers: means and deviations of adults in Europe, to two digits.
double stature_by_id(std::int64_t id, bool is_female) {
  Random random = random_of(id);
  random.next();  // that which the sex is drawn from
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.uniform(1);
  return is_female ? 1.66 + 0.065 * sum : 1.79 + 0.07 * sum;
}

WalkerReader::WalkerReader(TrajectoryReader& reader, double facing)
    : reader_(reader),
      fps_(reader.info().fps),
      window_(std::max<std::int64_t>(1, std::llround(smoothing * fps_))),
      facing_(facing) {}

/// Counts a person's step. Nobody moves so far so fast as in a jump: ids were mixed up, or places.
void WalkerReader::measure(const Place& from, const TrackedPerson& to, std::int64_t frame) {
  const double x = to.x - from.x, y = to.y - from.y, way = std::sqrt(x * x + y * y);
  const double seconds = static_cast<double>(frame - from.frame) / fps_;
  speeds_.way += way, speeds_.seconds += seconds;
  if (way > speeds_.fastest * seconds) {
    speeds_.fastest = way / seconds;
    speeds_.person = to.id, speeds_.frame = frame;
  }
  if (way < jump || way < fastest * seconds) return;
  std::ostringstream text;
  text << reader_.place_of(to.row) << ": person " << to.id << " jumps by " << way << " m, from (" << from.x
       << ", " << from.y << ") in frame " << from.frame << " to (" << to.x << ", " << to.y << ") in frame "
       << frame;
  throw TrajectoryError(std::move(text).str());
}

bool WalkerReader::read_one() {
  Frame next;
  if (at_end_ || !reader_.next(next.frame, next.people)) {
    at_end_ = true;
    return false;
  }
  // Mostly those of the frame before; both are in the order of ids.
  const Frame* const before = ahead_.empty() ? nullptr : &ahead_.back();
  std::size_t k = 0;
  for (const TrackedPerson& person : next.people) {
    while (before != nullptr && k < before->people.size() && before->people[k].id < person.id) ++k;
    const bool was_there =
        before != nullptr && k < before->people.size() && before->people[k].id == person.id;
    Track& track = was_there ? *before->tracks[k] : track_of(person.id);
    if (!track.places.empty()) measure(track.places.back(), person, next.frame);
    track.places.push_back({next.frame, person.x, person.y});
    next.tracks.push_back(&track);
  }
  rows_ahead_ += next.people.size();
  ahead_.push_back(std::move(next));
  return true;
}

WalkerReader::Track& WalkerReader::track_of(std::int64_t id) {
  const auto [entry, is_new] = tracks_.try_emplace(id);
  Track& track = entry->second;
  if (!is_new) return track;
  track.is_female = is_female_by_id(id);
  track.stature = stature_by_id(id, track.is_female);
  if (const auto found = left_.find(id); found != left_.end()) {
    const Left& left = found->second;
    track.places.push_back(left.last);
    track.heading = left.heading, track.phase = left.phase, track.way = left.way;
    track.last_frame = left.last.frame;
    track.has_heading = left.has_heading, track.has_walked = true;
    left_.erase(found);
  }
  return track;
}

/// Forgets the places of people who have left, but for the last one: none before it is within the window of a later frame. All people
/// have walked to this frame.
void WalkerReader::let_go(std::int64_t frame) {
  if (tracks_.size() < many_tracks_) return;
  for (auto entry = tracks_.begin(); entry != tracks_.end();) {
    const Track& track = entry->second;
    const Place last = track.places.back();
    const bool has_left = last.frame < frame - window_;
    if (has_left) left_[entry->first] = {last, track.heading, track.phase, track.way, track.has_heading};
    entry = has_left ? tracks_.erase(entry) : std::next(entry);
  }
  many_tracks_ = std::max(few_people, 2 * tracks_.size());
}

Walker WalkerReader::walk(const TrackedPerson& person, Track& track, std::int64_t frame) const {
  // Those before the window go, but for the last one before this frame, which recordings of few frames need.
  while (track.places.size() > 1 && track.places[0].frame < frame - window_ && track.places[1].frame < frame)
    track.places.pop_front();
  const Place first = track.places.front();
  // The last one within the window, or, where there is none, the next.
  auto last = track.places.end();
  while (last != track.places.begin() && std::prev(last)->frame > frame + window_) --last;
  const bool is_there_at_end = std::prev(last)->frame == window_end_;
  if (last == track.places.end() || std::prev(last)->frame > frame) --last;
  const double seconds = static_cast<double>(last->frame - first.frame) / fps_;
  const double dx = last->x - first.x, dy = last->y - first.y;
  const double speed = seconds > 0 ? std::sqrt(dx * dx + dy * dy) / seconds : 0;

  const bool told = !is_nan(person.heading), moves = speed > slowest_direction;
  if (told || moves) {
    track.heading = told ? static_cast<double>(person.heading) : std::atan2(dy, dx);
    track.has_heading = true;
  }
  if (!track.has_walked) {
    track.phase = random_of(person.id).uniform(1);
    track.way = 100 * track.phase;
  }
  const double since = track.has_walked ? static_cast<double>(frame - track.last_frame) / fps_ : 0;
  track.has_walked = true;
  if (speed > 0.05) track.phase += since * strides_per_second(speed);
  track.way += since * speed;
  track.phase -= std::floor(track.phase);
  track.last_frame = frame;
  const double stature = is_nan(person.stature) ? track.stature : static_cast<double>(person.stature);
  return {person.id,
          person.x,
          person.y,
          track.heading,
          speed,
          track.phase,
          stature,
          track.is_female,
          !told && !moves,
          track.way,
          static_cast<double>(frame) / fps_ + static_cast<double>(static_cast<std::uint64_t>(person.id) % 97),
          person.motion,
          person.clip_seconds,
          seconds > 0 ? dx / seconds : 0,
          seconds > 0 ? dy / seconds : 0,
          first.frame != window_begin_ || !is_there_at_end};
}

/// Finds where a person who is new, and stands, will go. That is his heading until he walks, if it is found.
void WalkerReader::find_first_step(const TrackedPerson& person, Track& track, std::int64_t frame) {
  const std::int64_t end = frame + std::llround(look_ahead * fps_);
  for (std::size_t at = 0;; ++at) {
    while (at == track.places.size())
      if (ahead_.back().frame >= end || rows_ahead_ >= max_rows_ahead || !read_one()) return;
    const double dx = track.places[at].x - person.x, dy = track.places[at].y - person.y;
    if (track.places[at].frame <= frame || dx * dx + dy * dy < first_step * first_step) continue;
    track.heading = std::atan2(dy, dx);
    track.has_heading = true;
    return;
  }
}

/// Who has not moved yet faces the way in which the others walk.
void WalkerReader::face_the_crowd(WalkerFrame& frame, const std::vector<Track*>& tracks) const {
  if (std::all_of(tracks.begin(), tracks.end(), [](const Track* track) { return track->has_heading; }))
    return;
  double x = 0, y = 0;
  for (const Walker& walker : frame.people)
    if (!walker.is_guessed) x += std::cos(walker.heading), y += std::sin(walker.heading);
  if (x == 0 && y == 0) return;
  for (std::size_t i = 0; i < tracks.size(); ++i)
    if (!tracks[i]->has_heading) frame.people[i].heading = std::atan2(y, x);
}

/// Reads what the first frame of those ahead needs, and finds out which frames are within its window.
void WalkerReader::read_window() {
  while (ahead_.empty() || ahead_.back().frame <= ahead_.front().frame + window_)
    if (!read_one()) break;
  if (ahead_.empty()) return;
  const std::int64_t frame = ahead_.front().frame;
  while (!before_.empty() && before_.front() < frame - window_) before_.pop_front();
  window_begin_ = before_.empty() ? frame : before_.front();
  auto end = std::prev(ahead_.end());
  while (end->frame > frame + window_) --end;
  window_end_ = end->frame;
  before_.push_back(frame);
}

bool WalkerReader::next(WalkerFrame& frame) {
  read_window();
  if (ahead_.empty()) return false;
  for (std::size_t i = 0; i < ahead_.front().people.size(); ++i) {
    Track& track = *ahead_.front().tracks[i];
    if (!track.has_walked && is_nan(ahead_.front().people[i].heading))
      find_first_step(ahead_.front().people[i], track, ahead_.front().frame);
  }
  const Frame now = std::move(ahead_.front());
  ahead_.pop_front();
  rows_ahead_ -= now.people.size();
  frame.frame = now.frame;
  frame.people.clear();
  for (std::size_t i = 0; i < now.people.size(); ++i)
    frame.people.push_back(walk(now.people[i], *now.tracks[i], now.frame));
  face_the_crowd(frame, now.tracks);
  for (Walker& walker : frame.people) walker.heading -= facing_;
  let_go(now.frame);
  return true;
}

}  // namespace bch::detail
