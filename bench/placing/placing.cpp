// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/placing/placing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "kernel/motion/path.hpp"
#include "layout/base/random.hpp"

namespace bch::bench {
namespace {

constexpr double key_step = 0.25;   // seconds between two keys of a path
constexpr double fastest_turn = 1;  // radians a second
constexpr int max_arcs = 10'000;    // drawn for a candidate until one stays inside

/// Draws candidates.
class Candidates {
 public:
  Candidates(std::span<const PlacedClip> clips, const PlacingOptions& options)
      : clips_(clips), options_(options), random_(options.seed) {
    for (const GivenPath& path : options.paths) {
      left_.push_back(&path);
      std::swap(left_.back(), left_[random_.below(static_cast<std::uint32_t>(left_.size()))]);
    }
  }

  /// Returns none where all given paths were tried.
  std::optional<PlacedPerson> next() {
    if (!options_.paths.empty() && left_.empty()) return std::nullopt;
    const std::uint32_t clip = random_.below(static_cast<std::uint32_t>(clips_.size()));
    const double begin = 0 - random_.uniform(latest(clips_[clip]));
    if (!left_.empty()) {
      const GivenPath& path = *left_.back();
      left_.pop_back();
      return PlacedPerson{path.id, clip, begin, path.keys};
    }
    ++drawn_;
    return PlacedPerson{drawn_, clip, begin, arc_inside(clip)};
  }

 private:
  std::vector<PathKey> arc_inside(std::uint32_t clip) {
    for (int i = 0; i < max_arcs; ++i) {
      std::vector<PathKey> path = arc(clips_[clip].speed);
      if (is_inside(path)) return path;
    }
    throw std::invalid_argument(clips_[clip].character + ", clip " + clips_[clip].name +
                                ": its way does not fit into the area");
  }

  /// Returns the latest time of a clip with which it may begin here: one that ends has to last until everybody stops.
  double latest(const PlacedClip& clip) const {
    return clip.body.loops() ? clip.seconds : std::max(0.0, clip.seconds - options_.seconds);
  }

  std::vector<PathKey> arc(double speed) {
    const double x = random_.uniform(options_.width), y = random_.uniform(options_.depth);
    const double heading = random_.uniform(2 * std::numbers::pi);
    const double turn = speed > 0 ? random_.uniform(2 * fastest_turn) - fastest_turn : 0;
    return bench::arc({0, x, y, heading}, speed, turn, options_.seconds);
  }

  bool is_inside(std::span<const PathKey> path) const {
    return std::ranges::all_of(path, [&](const PathKey& key) {
      return key.x >= 0 && key.x <= options_.width && key.y >= 0 && key.y <= options_.depth;
    });
  }

  std::span<const PlacedClip> clips_;
  const PlacingOptions& options_;
  detail::Random random_;
  std::vector<const GivenPath*> left_;  ///< those that were not tried, the next one last
  std::int64_t drawn_ = 0;
};

/// The people who have room by now.
class Crowd {
 public:
  Crowd(std::span<const PlacedClip> clips, const PlacingOptions& options)
      : clips_(clips), interval_{0, options.seconds}, obstacles_(options.obstacles) {}

  bool has_room(const PlacedPerson& person) const {
    if (obstacles_ != nullptr && !is_clear(person)) return false;
    return free_until(motion_of(person), motions_, interval_) == std::numeric_limits<double>::infinity();
  }

  void add(PlacedPerson person) {
    // A moved vector keeps its elements where they are, and with them what motions examine.
    people_.push_back(std::move(person));
    motions_.push_back(motion_of(people_.back()));
  }

  std::vector<PlacedPerson> people() && { return std::move(people_); }

 private:
  Motion motion_of(const PlacedPerson& person) const {
    return {&clips_[person.clip].body, person.path, person.clip_begin};
  }

  bool is_clear(const PlacedPerson& person) const {
    const Motion motion = motion_of(person);
    double time = 0;
    first_contact({&motion, 1}, *obstacles_, interval_, {&time, 1});
    return time == std::numeric_limits<double>::infinity();
  }

  std::span<const PlacedClip> clips_;
  TimeInterval interval_;
  const ObstacleSet* obstacles_;
  std::vector<PlacedPerson> people_;
  std::vector<Motion> motions_;
};

}  // namespace

std::vector<PathKey> arc(const PathKey& begin, double speed, double turn, double seconds) {
  const auto steps = static_cast<int>(std::ceil(seconds / key_step));
  std::vector<PathKey> path{begin};
  for (int k = 1; k <= steps; ++k) {
    const PathKey& last = path.back();
    const double time = seconds * k / steps, middle = begin.heading + turn * (last.time + time) / 2;
    const double distance = speed * (time - last.time);
    path.push_back({time, last.x + distance * std::cos(middle), last.y + distance * std::sin(middle),
                    begin.heading + turn * time});
  }
  return path;
}

Placement place(std::span<const PlacedClip> clips, const PlacingOptions& options) {
  Candidates candidates(clips, options);
  Crowd crowd(clips, options);
  Placement placement;
  for (std::uint32_t refused = 0; refused < options.tries; ++placement.candidates) {
    std::optional<PlacedPerson> person = candidates.next();
    if (!person) break;
    const bool has_room = crowd.has_room(*person);
    refused = has_room ? 0 : refused + 1;
    if (has_room) crowd.add(std::move(*person));
  }
  placement.people = std::move(crowd).people();
  return placement;
}

PathKey at(std::span<const PathKey> path, double seconds) {
  const auto next = std::ranges::find_if(path, [&](const PathKey& key) { return key.time >= seconds; });
  if (next == path.begin()) return path.front();
  if (next == path.end()) return path.back();
  return detail::between_keys(*(next - 1), *next, seconds);
}

}  // namespace bch::bench
