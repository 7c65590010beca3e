// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/walker_shapes.hpp"

#include <algorithm>
#include <cmath>

#include <bch/characters.hpp>
#include <bch/poses.hpp>

#include "kernel/runtime/ordered_build.hpp"
#include "kernel/runtime/spares.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/default_character/pedestrian_speeds.hpp"

namespace bch::detail {
namespace {

constexpr double shortest_stature = 0.9, stature_step = 1.04;
constexpr std::uint32_t stature_classes = 25;  // up to 2.3 m
constexpr float threshold = 0.02f;             ///< metres; segments decide who overlaps, discs how deep
constexpr std::size_t lookups = 4096;          ///< of poses, a task
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

WalkerPose::WalkerPose(const Walker& walker, Shoulders held, std::uint32_t coarse,
                       CharacterLibraryView library, std::span<const LibraryMotion> motions)
    : is_female(walker.is_female),
      stature(0),
      shoulders(held),
      clip(0),
      phase(0),
      seconds(0),
      exact_seconds(0) {
  if (walker.motion != TrackedPerson::no_motion && !motions[walker.motion].footprint.empty()) {
    footprint = walker.motion;
    return;
  }
  const double size =
      std::log(std::max(walker.stature, shortest_stature) / shortest_stature) / std::log(stature_step);
  stature = std::min(rounded(size, coarse), stature_classes - 1);
  if (!library.empty()) {
    const LibraryPose pose = library_pose(library, motions, walker, coarse);
    if (library[pose.member].height == 0) stature = 0;  // as it was baked
    member = pose.member, clip = pose.clip, phase = pose.phase;
    seconds = pose.seconds, exact_seconds = pose.exact_seconds;
    return;
  }
  clip = std::min(rounded(walker.speed / pedestrian_speed_step, coarse), pedestrian_speeds - 1);
  const std::uint32_t phases = phases_at(clip, coarse);
  phase = std::min(static_cast<std::uint32_t>(walker.phase * phases), phases - 1);
  const double share = (phase + 0.5) / phases;
  const double strides = strides_per_second(clip * pedestrian_speed_step);
  seconds = static_cast<float>(share / strides);
  exact_seconds = static_cast<float>(walker.phase / strides);
}

std::uint64_t WalkerPose::key() const noexcept {
  return body() << 32 | clip << 16 | phase;
}

std::uint64_t WalkerPose::body() const noexcept {
  if (footprint != on_foot) return (std::uint64_t{1} << 31) + footprint;
  if (member != built_in) return (std::uint64_t{1} << 16) + std::uint64_t{member} * stature_classes + stature;
  return (std::uint64_t{stature} * 2 + is_female) * 3 + static_cast<std::uint64_t>(shoulders);
}

double WalkerPose::metres() const noexcept {
  return shortest_stature * std::pow(stature_step, stature);
}

PoseTime WalkerPose::at() const noexcept {
  return {clip, seconds};
}

PoseTime WalkerPose::exact() const noexcept {
  return {clip, exact_seconds};
}

Character WalkerPose::character(CharacterLibraryView library) const {
  constexpr double turn[] = {0, 0.7, -0.7};  // radians; of Shoulders
  if (member != built_in) return scaled(library[member], metres());
  return default_pedestrian(is_female ? Sex::female : Sex::male, metres(),
                            turn[static_cast<std::size_t>(shoulders)]);
}

/// A character and its shape builders. They are few, because threads take poses as they come, of many bodies.
struct WalkerShapes::Body {
  std::unique_ptr<const Character> character;
  Spares<ShapeBuilder> shape_builders;
};

WalkerShapes::WalkerShapes(const ShapeSetPlan& plan, CharacterLibraryView library,
                           std::span<const LibraryMotion> motions, const ShapeSet* baked)
    : plan_(plan),
      library_(library),
      motions_(motions),
      builder_(plan, expected_shapes),
      baked_(baked),
      set_(baked != nullptr ? baked : &builder_.set()) {}
WalkerShapes::~WalkerShapes() = default;

/// Makes those that are new on all threads. Who does not walk has none.
std::vector<WalkerShapes::Body*> WalkerShapes::bodies_of(std::span<const WalkerPose> poses) {
  std::vector<Body*> bodies, made;
  std::vector<const WalkerPose*> wanted;
  for (const WalkerPose& pose : poses) {
    if (pose.footprint != WalkerPose::on_foot) {
      bodies.push_back(nullptr);
      continue;
    }
    auto& body = bodies_[pose.body()];
    if (!body) {
      body = std::make_unique<Body>();
      made.push_back(body.get()), wanted.push_back(&pose);
    }
    bodies.push_back(body.get());
  }
  for_ranges(made.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      made[i]->character = std::make_unique<const Character>(wanted[i]->character(library_));
  });
  return bodies;
}

void WalkerShapes::build(std::span<const WalkerPose> poses) {
  const std::vector<Body*> bodies = bodies_of(poses);
  add_in_order(
      builder_, plan_, poses.size(),
      [&](BuiltShape& place, std::size_t i) {
        if (bodies[i] == nullptr)
          return place.prepare(shape_from_polygons(motions_[poses[i].footprint].footprint), i);
        const auto shape_builder = bodies[i]->shape_builders.borrow(
            [&] { return ShapeBuilder(*bodies[i]->character, plan_, threshold); });
        place.prepare(shape_builder->shape(poses[i].at()), i);
      },
      [](std::size_t) {});
  set_ = &builder_.set();
}

void WalkerShapes::give_up() {
  given_up_ += set_->shape_count();
  builder_ = ShapeSetBuilder(plan_, expected_shapes);
  set_ = &builder_.set();
  number_of_.clear();
}

std::span<const WalkerPose> WalkerShapes::find(std::span<const WalkerPose> poses,
                                               std::span<std::uint32_t> shapes) {
  if (baked_ == nullptr && set_->bytes() > max_bytes) give_up();
  constexpr std::uint32_t none = 0xffff'ffff;
  for_ranges(poses.size(), lookups, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto found = number_of_.find(poses[i].key());
      shapes[i] = found == number_of_.end() ? none : found->second;
    }
  });
  new_.clear();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (shapes[i] != none) continue;
    const WalkerPose& pose = poses[i];
    const auto next = baked_ != nullptr ? library_[pose.member].clips[pose.clip].baked[pose.phase].shape
                                        : static_cast<std::uint32_t>(set_->shape_count() + new_.size());
    const auto [entry, is_new] = number_of_.emplace(pose.key(), next);
    if (is_new) new_.push_back(pose);
    shapes[i] = entry->second;
  }
  if (baked_ == nullptr && !new_.empty()) build(new_);
  return new_;
}

}  // namespace bch::detail
