// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bench/ratios/ratios.hpp"
#include "kernel/recordings/check.hpp"
#include "layout/base/random.hpp"

namespace bch::bench {
namespace {

using namespace detail;

constexpr std::uint32_t most_people = 5000;
constexpr double walkers_density = 3, fps = 25;
constexpr std::size_t few_frames = 400, many_frames = 800, checked_frames = 4;
constexpr int check_threads = 2;

struct Position {
  double x, y;  ///< metres
};

double drawn(std::uint32_t person, std::uint32_t what, double bound) {
  return Random(std::uint64_t{16} * person + what).uniform(bound);
}

/// A lattice of people who sway, and walk on in waves: slower where they are pushed together.
Position in_waves(std::uint32_t people, std::uint32_t person, double seconds) {
  const double spacing = 1 / std::sqrt(walkers_density * std::sqrt(0.75));
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(people)));
  const std::uint32_t row = person / columns, column = person % columns;
  const double x = spacing * (column + 0.5 * (row % 2)), y = spacing * std::sqrt(0.75) * row;
  const auto sway = [&](std::uint32_t axis) {
    return drawn(person, axis, 0.06) *
           std::sin((0.4 + drawn(person, 2 + axis, 0.8)) * seconds + drawn(person, 4 + axis, 6.28));
  };
  return {x + sway(0) + 0.6 * seconds - 1.7 * std::cos(0.3 * seconds + 0.1 * x), y + sway(1)};
}

/// People who walk through each other, and turn round at the sides of a square.
Position at_random(std::uint32_t people, std::uint32_t person, double seconds) {
  const double side = std::sqrt(people / walkers_density);
  const double way = (0.2 + drawn(person, 0, 1.4)) * seconds, angle = drawn(person, 1, 6.28);
  const auto fold = [side](double at) { return side - std::abs(std::fmod(std::abs(at), 2 * side) - side); };
  return {fold(drawn(person, 2, side) + way * std::cos(angle)),
          fold(drawn(person, 3, side) + way * std::sin(angle))};
}

using Place = Position (*)(std::uint32_t people, std::uint32_t person, double seconds);

/// A recording in memory, so that no file is read.
class Recording final : public TrajectoryReader {
 public:
  Recording(Place place, std::uint32_t people) : frames_(many_frames) {
    constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
    info_.fps = fps;
    for (std::size_t k = 0; k < frames_.size(); ++k)
      for (std::uint32_t i = 0; i < people; ++i) {
        const Position at = place(people, i, static_cast<double>(k) / fps);
        frames_[k].push_back({i, at.x, at.y, unknown, unknown});
      }
  }

  CheckSummary check(std::size_t frames) {
    next_ = 0, end_ = frames;
    CheckOptions options;
    options.coarse = 3;  // as for files of so many rows
    return detail::check(*this, options);
  }

  /// Compares the pairs within 1.2 m with those that a loop over all pairs finds.
  void require_right() {
    std::uint64_t near = 0;
    for (const auto& frame : std::span(frames_).first(checked_frames))
      for (std::size_t i = 0; i < frame.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          const double x = frame[i].x - frame[j].x, y = frame[i].y - frame[j].y;
          near += x * x + y * y <= 1.2 * 1.2;
        }
    const std::uint64_t found = check(checked_frames).all.near_pairs;
    if (found != near)
      throw std::runtime_error(
          fmt::format("check: {} pairs within 1.2 m where a loop finds {}", found, near));
  }

  const TrajectoryInfo& info() const override { return info_; }
  bool next(std::int64_t& frame, std::vector<TrackedPerson>& of_frame) override {
    if (next_ == end_) return false;
    frame = static_cast<std::int64_t>(next_);
    of_frame = frames_[next_++];
    return true;
  }
  std::string place_of(std::uint64_t row) const override { return fmt::format("row {}", row); }

 private:
  TrajectoryInfo info_;
  std::vector<std::vector<TrackedPerson>> frames_;
  std::size_t next_ = 0, end_ = 0;
};

void add_recording(const char* name, Place place, std::uint32_t people) {
  const auto shared = once([place, people] { return std::make_shared<Recording>(place, people); });
  for (const std::size_t frames : {few_frames, many_frames})
    add(
        fmt::format("check/{}/{}/threads:{}", name, frames, check_threads),
        [shared, frames]() -> Contender {
          Recording& recording = shared();
          recording.require_right();
          const CheckSummary summary = recording.check(frames);
          const auto rows = static_cast<double>(summary.all.people);
          return {[&recording, frames] { recording.check(frames); },
                  summary.all.people,
                  {{"percent", 100 * static_cast<double>(summary.all.overlapping) / rows},
                   {"poses", static_cast<double>(summary.poses.size())}}};
        },
        check_threads);
}

}  // namespace

void add_checks(Scene& scene) {
  const std::uint32_t people = std::min(most_people, scene.agents());
  add_recording("in_waves", in_waves, people);
  add_recording("at_random", at_random, people);
}

}  // namespace bch::bench
