// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/bodies.hpp>

#include <numeric>

#include "layout/base/floating_point_state.hpp"
#include "layout/body/posing/model_layout.hpp"
#include "layout/body/posing/sphere_poser.hpp"

namespace bch {

using namespace detail;

BodyLayout detail::layout_of(const BodyModel& model) {
  BodyLayout layout;
  layout.sphere_count = static_cast<std::uint32_t>(model.sphere_count());
  layout.leaf_size = model.leaf_size;
  layout.sphere_in_slot.resize(layout.sphere_count);
  std::iota(layout.sphere_in_slot.begin(), layout.sphere_in_slot.end(), 0);
  layout.core = model.core;
  return layout;
}

struct BodyPoser::State {
  explicit State(const BodyModel& of) : model(of), layout(layout_of(of)), poser(model, layout) {}
  State(const State&) = delete;  // because the poser refers to the others
  State& operator=(const State&) = delete;

  const BodyModel model;
  const BodyLayout layout;
  SpherePoser poser;
  std::vector<Sphere> spheres;
};

BodyPoser::BodyPoser(const BodyModel& model) {
  validate(model);
  state_ = std::make_unique<State>(model);
}
BodyPoser::BodyPoser(BodyPoser&&) noexcept = default;
BodyPoser& BodyPoser::operator=(BodyPoser&&) noexcept = default;
BodyPoser::~BodyPoser() = default;

std::span<const Sphere> BodyPoser::spheres(const Pose& pose) {
  const FloatingPointStateGuard floats;
  const SphereSlots slots = state_->poser.pose(pose);
  state_->spheres.resize(state_->layout.sphere_count);
  for (std::size_t i = 0; i < state_->spheres.size(); ++i)
    state_->spheres[i] = {slots.x[i], slots.y[i], slots.z[i], slots.radius[i]};
  return state_->spheres;
}

}  // namespace bch
