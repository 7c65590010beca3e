// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "kernel/recordings/check.hpp"
#include "tests/support/scenes.hpp"

// Recordings that are made up, of which it is known who runs into whom.

namespace bch::test {

/// What a row does not say.
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// A recording in memory.
class MadeUp : public detail::TrajectoryReader {
 public:
  explicit MadeUp(double fps) { info_.fps = fps; }

  void add(std::int64_t frame, detail::TrackedPerson person) { frames_[frame].push_back(person); }
  /// Somebody who walks straight on from frame 0 for so many frames.
  void walk(std::int64_t id, double x, double y, double speed_x, double speed_y, int frames) {
    for (int k = 0; k < frames; ++k)
      add(k, {id, x + speed_x * k / info_.fps, y + speed_y * k / info_.fps, unknown, 1.75f});
  }
  void rewind() { next_ = frames_.begin(); }

  const detail::TrajectoryInfo& info() const override { return info_; }
  bool next(std::int64_t& frame, std::vector<detail::TrackedPerson>& people) override {
    if (next_ == frames_.end()) return false;
    frame = next_->first, people = next_->second;
    std::ranges::sort(people, {}, &detail::TrackedPerson::id);
    ++next_;
    return true;
  }
  std::string place_of(std::uint64_t row) const override { return "made up: row " + std::to_string(row); }

 private:
  detail::TrajectoryInfo info_;
  std::map<std::int64_t, std::vector<detail::TrackedPerson>> frames_;
  std::map<std::int64_t, std::vector<detail::TrackedPerson>>::iterator next_;
};

/// What check() finds, without frames.
inline detail::CheckSummary check_of(MadeUp& recording, const detail::CheckOptions& options = {}) {
  recording.rewind();
  return detail::check(recording, options);
}

/// People who walk straight on in a square.
inline void add_crowd(MadeUp& recording, std::uint32_t people, int frames) {
  Random random(291);
  for (std::uint32_t i = 0; i < people; ++i) {
    const double angle = random.uniform(-3, 3), speed = random.uniform(0, 1.6);
    recording.walk(1 + 3 * i, random.uniform(0, 8), random.uniform(0, 8), speed * std::cos(angle),
                   speed * std::sin(angle), frames);
  }
}

}  // namespace bch::test
