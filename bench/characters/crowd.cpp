// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/characters/crowd.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include "layout/base/heading.hpp"
#include "layout/base/random.hpp"

namespace bch::cli {

Crowd place_crowd(std::uint32_t agents, double density, std::uint32_t shapes, std::uint64_t seed) {
  detail::Random random(seed);
  Crowd crowd;
  crowd.side = std::sqrt(agents / density);
  for (std::uint32_t i = 0; i < agents; ++i) {
    crowd.x.push_back(random.uniform(crowd.side));
    crowd.y.push_back(random.uniform(crowd.side));
    crowd.heading.push_back(random.uniform(2 * std::numbers::pi));
    crowd.shape.push_back(random.below(shapes));
  }
  return crowd;
}

namespace {

constexpr double walking_speed = 1.3;  ///< metres a second
constexpr double frame_seconds = 1.0 / 60;

}  // namespace

WalkingCrowd::WalkingCrowd(std::span<const LoadedCharacter> characters, std::uint32_t agents, double density,
                           std::uint64_t seed)
    : characters_(characters), crowd_(place_crowd(agents, density, 1, seed)) {
  std::iota(crowd_.shape.begin(), crowd_.shape.end(), 0u);
  detail::Random random(seed + 1);
  for (std::uint32_t i = 0; i < agents; ++i) {
    PoseId pose{random.below(static_cast<std::uint32_t>(characters.size())), {}};
    if (const auto& clips = clips_of(pose); !clips.empty()) {
      pose.at.clip = random.below(static_cast<std::uint32_t>(clips.size()));
      pose.at.seconds = static_cast<float>(random.uniform(double{clips[pose.at.clip].seconds}));
    }
    poses_.push_back(pose);
  }
}

const std::vector<Clip>& WalkingCrowd::clips_of(const PoseId& pose) const {
  return characters_[pose.character].character.clips;
}

void WalkingCrowd::step() {
  const auto wrap = [side = crowd_.side](double x) { return x - side * std::floor(x / side); };
  for (std::size_t i = 0; i < crowd_.size(); ++i) {
    const detail::Rotation ahead = detail::rotation(crowd_.heading[i]);
    crowd_.x[i] = wrap(crowd_.x[i] + walking_speed * frame_seconds * ahead.cosine);
    crowd_.y[i] = wrap(crowd_.y[i] + walking_speed * frame_seconds * ahead.sine);
    PoseTime& at = poses_[i].at;
    if (at.clip == PoseTime::rest) continue;
    const double length{clips_of(poses_[i])[at.clip].seconds};
    at.seconds = static_cast<float>(std::fmod(double{at.seconds} + frame_seconds, length));
  }
}

}  // namespace bch::cli
