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
#include "layout/base/plane_point.hpp"
#include "layout/base/random.hpp"

namespace bch::bench {
namespace {

using detail::PlanePoint;

constexpr double key_step = 0.25;   // seconds between two keys of a path
constexpr double fastest_turn = 1;  // radians a second
constexpr int most_arcs = 10'000;   // drawn for a candidate until one stays inside

double side_of(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

bool cross(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d) {
  return side_of(c, a, b) * side_of(d, a, b) < 0 && side_of(a, c, d) * side_of(b, c, d) < 0;
}

/// Returns whether discs along two paths are apart.
bool paths_are_apart(std::span<const PathKey> first, std::span<const PathKey> second) {
  const auto point = [](const PathKey& key) { return PlanePoint{key.x, key.y}; };
  constexpr double least = 4 * path_radius * path_radius;
  for (std::size_t i = 1; i < first.size(); ++i) {
    const PlanePoint a = point(first[i - 1]), b = point(first[i]);
    for (std::size_t k = 1; k < second.size(); ++k) {
      const PlanePoint c = point(second[k - 1]), d = point(second[k]);
      if (cross(a, b, c, d) || squared_distance(a, c, d) < least || squared_distance(b, c, d) < least ||
          squared_distance(c, a, b) < least || squared_distance(d, a, b) < least)
        return false;
    }
  }
  return true;
}

/// Draws candidates, the same ones for every spacing.
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
    for (int i = 0; i < most_arcs; ++i) {
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
  Crowd(std::span<const PlacedClip> clips, Spacing spacing, const PlacingOptions& options)
      : clips_(clips),
        spacing_(spacing),
        interval_{0, options.seconds},
        obstacles_(options.obstacles),
        path_disc_({{{{0, 1}, 1, {path_disc, path_disc}}}}) {}

  bool has_room(const PlacedPerson& person) const {
    if (obstacles_ != nullptr && !is_clear(person)) return false;
    if (spacing_ != Spacing::paths)
      return free_until(motion_of(person), motions_, interval_) == std::numeric_limits<double>::infinity();
    return std::ranges::all_of(
        people_, [&](const PlacedPerson& other) { return paths_are_apart(person.path, other.path); });
  }

  void add(PlacedPerson person) {
    // A moved vector keeps its elements where they are, and with them what motions look at.
    people_.push_back(std::move(person));
    motions_.push_back(motion_of(people_.back()));
  }

  std::vector<PlacedPerson> people() && { return std::move(people_); }

 private:
  static constexpr Disc path_disc{0, 0, static_cast<float>(path_radius)};

  Motion motion_of(const PlacedPerson& person) const {
    const PlacedClip& clip = clips_[person.clip];
    const AnimatedShape& shape = spacing_ == Spacing::paths       ? path_disc_
                                 : spacing_ == Spacing::cylinders ? clip.cylinder
                                                                  : clip.body;
    return {&shape, person.path, person.clip_begin};
  }

  bool is_clear(const PlacedPerson& person) const {
    const Motion motion = motion_of(person);
    double time = 0;
    first_contact({&motion, 1}, *obstacles_, interval_, {&time, 1});
    return time == std::numeric_limits<double>::infinity();
  }

  std::span<const PlacedClip> clips_;
  Spacing spacing_;
  TimeInterval interval_;
  const ObstacleSet* obstacles_;
  AnimatedShape path_disc_;
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
    const double way = speed * (time - last.time);
    path.push_back({time, last.x + way * std::cos(middle), last.y + way * std::sin(middle),
                    begin.heading + turn * time});
  }
  return path;
}

AnimatedDiscs cylinder_of(const AnimatedDiscs& discs) {
  AnimatedDiscs cylinder{{}, discs.loops, discs.heights};
  for (const AnimatedChunk& chunk : discs.chunks) {
    AnimatedChunk& one = cylinder.chunks.emplace_back();
    one.times = chunk.times;
    if (chunk.disc_count == 0) continue;
    one.disc_count = 1;
    for (std::size_t key = 0; key < chunk.times.size(); ++key) {
      double radius = 0;
      for (std::size_t i = 0; i < chunk.disc_count; ++i) {
        const Disc& disc = chunk.keys[key * chunk.disc_count + i];
        const double x = double{disc.x}, y = double{disc.y};
        radius = std::max(radius, std::sqrt(x * x + y * y) + double{disc.radius});
      }
      one.keys.push_back(
          {0, 0, std::nextafter(static_cast<float>(radius), std::numeric_limits<float>::infinity())});
    }
  }
  return cylinder;
}

Placement place(std::span<const PlacedClip> clips, Spacing spacing, const PlacingOptions& options) {
  Candidates candidates(clips, options);
  Crowd crowd(clips, spacing, options);
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
