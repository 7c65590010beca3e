// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/bodies.hpp>

#include <stdexcept>
#include <string>

#include "kernel/baking/body_batch.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch {

using namespace detail;

struct LiveBodies::State {
  State(std::span<const BodyModel> models, std::span<const std::uint32_t> model_of_body)
      : bodies(models, model_of_body) {}

  BodyBatch bodies;
};

LiveBodies::LiveBodies(std::span<const BodyModel> models, std::span<const std::uint32_t> model_of_body) {
  const FloatingPointStateGuard floats;
  for (const BodyModel& model : models) validate(model);
  state_ = std::make_unique<State>(models, model_of_body);
  state_->bodies.pose([](std::size_t) { return Pose(); }, [] {});
}
LiveBodies::LiveBodies(LiveBodies&&) noexcept = default;
LiveBodies& LiveBodies::operator=(LiveBodies&&) noexcept = default;
LiveBodies::~LiveBodies() = default;

void LiveBodies::pose(std::span<const Pose> poses) {
  const FloatingPointStateGuard floats;
  if (const std::uint32_t bodies = set().body_count(); poses.size() != bodies)
    throw std::invalid_argument("live bodies: expected " + std::to_string(bodies) + " poses, found " +
                                std::to_string(poses.size()));
  state_->bodies.pose([&](std::size_t i) -> const Pose& { return poses[i]; }, [] {});
}

const BodySet& LiveBodies::set() const noexcept {
  return state_->bodies.set;
}

}  // namespace bch
