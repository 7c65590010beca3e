// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/check/walker_shapes.hpp"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>

#include <bch/default_characters.hpp>
#include <bch/pose_shape.hpp>

#include "kernel/runtime/ordered_build.hpp"

namespace bch::detail {
namespace {

constexpr double shortest_stature = 0.9, stature_step = 1.04;
constexpr std::uint32_t stature_classes = 25;  // up to 2.3 m
constexpr float threshold = 0.02f;             ///< metres; segments decide who overlaps, discs how deep
constexpr std::size_t expected_shapes =
    30'000;  ///< about the most; room for them takes no memory before there are

/// The number of phases at a speed: feet go faster, relative to the body, the faster people walk.
std::uint32_t phases_at(std::uint32_t clip, std::uint32_t coarse) {
  return static_cast<std::uint32_t>(28 + 170 * pedestrian_speed_step * clip) / coarse;
}

/// The nearest multiple of a number.
std::uint32_t rounded(double value, std::uint32_t step) {
  return static_cast<std::uint32_t>(std::round(value / step)) * step;
}

}  // namespace

WalkerPose::WalkerPose(const Walker& walker, Shoulders held, std::uint32_t coarse)
    : is_female(walker.is_female), shoulders(held) {
  const double size =
      std::log(std::max(walker.stature, shortest_stature) / shortest_stature) / std::log(stature_step);
  stature = std::min(rounded(size, coarse), stature_classes - 1);
  clip = std::min(rounded(walker.speed / pedestrian_speed_step, coarse), pedestrian_speeds - 1);
  phases = phases_at(clip, coarse);
  phase = std::min(static_cast<std::uint32_t>(walker.phase * phases), phases - 1);
}

std::uint64_t WalkerPose::key() const noexcept {
  return body() << 32 | clip << 16 | phase;
}

std::uint64_t WalkerPose::body() const noexcept {
  return (std::uint64_t{stature} * 2 + is_female) * 3 + static_cast<std::uint64_t>(shoulders);
}

double WalkerPose::metres() const noexcept {
  return shortest_stature * std::pow(stature_step, stature);
}

PoseTime WalkerPose::at() const noexcept {
  const double share = (phase + 0.5) / phases;
  return {clip, static_cast<float>(share / pedestrian_strides_per_second(clip * pedestrian_speed_step))};
}

/// What a thread makes shapes with: it learns each body once.
struct WalkerShapes::Workshop {
  std::unordered_map<const Character*, PoseShaper> shapers;

  PoseShaper& shaper(const Character& character, const ShapeSetPlan& plan) {
    const auto found = shapers.find(&character);
    return found != shapers.end() ? found->second
                                  : shapers.try_emplace(&character, character, plan, threshold).first->second;
  }
};

WalkerShapes::WalkerShapes(const ShapeSetPlan& plan)
    : plan_(plan), builder_(plan, expected_shapes), set_(&builder_.set()) {}
WalkerShapes::~WalkerShapes() = default;

const Character& WalkerShapes::character(const WalkerPose& pose) {
  auto& found = characters_[pose.body()];
  constexpr double turn[] = {0, 0.7, -0.7};  // radians; of Shoulders
  if (!found)
    found = std::make_unique<const Character>(
        default_pedestrian(pose.is_female ? Sex::female : Sex::male, pose.metres(),
                           turn[static_cast<std::size_t>(pose.shoulders)]));
  return *found;
}

void WalkerShapes::build(std::span<const WalkerPose> poses) {
  std::vector<const Character*> characters;
  for (const WalkerPose& pose : poses) characters.push_back(&character(pose));
  tbb::enumerable_thread_specific<Workshop> workshops;
  add_in_order(
      builder_, plan_, poses.size(),
      [&](std::size_t i) -> const Shape& {
        return workshops.local().shaper(*characters[i], plan_).shape(poses[i].at());
      },
      [](std::size_t) {});
  set_ = &builder_.set();
}

void WalkerShapes::find(std::span<const WalkerPose> poses, std::span<std::uint32_t> shapes) {
  if (set_->bytes() > most_bytes) {
    given_up_ += set_->shape_count();
    builder_ = ShapeSetBuilder(plan_, expected_shapes);
    set_ = &builder_.set();
    number_of_.clear();
  }
  std::vector<WalkerPose> missing;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto next = static_cast<std::uint32_t>(set_->shape_count() + missing.size());
    const auto [entry, is_new] = number_of_.emplace(poses[i].key(), next);
    if (is_new) missing.push_back(poses[i]);
    shapes[i] = entry->second;
  }
  if (!missing.empty()) build(missing);
}

}  // namespace bch::detail
