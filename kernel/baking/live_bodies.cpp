// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/bodies.hpp>

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <stdexcept>
#include <string>

#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/body/posing/model_layout.hpp"
#include "layout/body/posing/sphere_poser.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::size_t bodies_per_task = 16;

std::vector<BodyLayout> layouts_of(std::span<const BodyModel> models) {
  std::vector<BodyLayout> layouts;
  for (const BodyModel& model : models) {
    validate(model);
    layouts.push_back(layout_of(model));
  }
  return layouts;
}

std::vector<const BodyLayout*> layouts_of_bodies(std::span<const BodyLayout> layouts,
                                                 std::span<const std::uint32_t> model_of_body) {
  std::vector<const BodyLayout*> of_bodies;
  for (std::size_t i = 0; i < model_of_body.size(); ++i) {
    if (model_of_body[i] >= layouts.size())
      throw std::invalid_argument("live bodies: expected one of " + std::to_string(layouts.size()) +
                                  " models, found " + std::to_string(model_of_body[i]) + " of body " +
                                  std::to_string(i));
    of_bodies.push_back(&layouts[model_of_body[i]]);
  }
  return of_bodies;
}

/// Throws the present exception again, with the name of a body.
[[noreturn]] void rethrow_for(std::size_t body) {
  const std::string place = "body " + std::to_string(body) + ": ";
  try {
    throw;
  } catch (const std::domain_error& error) {
    throw std::domain_error(place + error.what());
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(place + error.what());
  }
}

}  // namespace

struct LiveBodies::State {
  State(std::span<const BodyModel> of, std::span<const std::uint32_t> model_of)
      : models(of.begin(), of.end()),
        layouts(layouts_of(models)),
        model_of_body(model_of.begin(), model_of.end()),
        set(layouts_of_bodies(layouts, model_of_body)) {}

  void pose(std::size_t body, const Pose& pose) {
    const std::uint32_t model = model_of_body[body];
    auto& own = posers.local();
    if (own.empty()) own.resize(models.size());
    if (own[model] == nullptr) own[model] = std::make_unique<SpherePoser>(models[model], layouts[model]);
    const auto number = static_cast<std::uint32_t>(body);
    write_record(layouts[model], own[model]->pose(pose), set.record(number));
    set.publish(number);
  }

  template <class PoseOf>
  void pose_all(const PoseOf& pose_of) {
    for_ranges(model_of_body.size(), bodies_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) try {
          pose(i, pose_of(i));
        } catch (...) {
          rethrow_for(i);
        }
    });
  }

  const std::vector<BodyModel> models;
  const std::vector<BodyLayout> layouts;
  const std::vector<std::uint32_t> model_of_body;
  BodySet set;
  tbb::enumerable_thread_specific<std::vector<std::unique_ptr<SpherePoser>>> posers;  ///< by model
};

LiveBodies::LiveBodies(std::span<const BodyModel> models, std::span<const std::uint32_t> model_of_body) {
  const FloatingPointStateGuard floats;
  state_ = std::make_unique<State>(models, model_of_body);
  state_->pose_all([](std::size_t) { return Pose(); });
}
LiveBodies::LiveBodies(LiveBodies&&) noexcept = default;
LiveBodies& LiveBodies::operator=(LiveBodies&&) noexcept = default;
LiveBodies::~LiveBodies() = default;

void LiveBodies::pose(std::span<const Pose> poses) {
  const FloatingPointStateGuard floats;
  if (poses.size() != state_->model_of_body.size())
    throw std::invalid_argument("live bodies: expected " + std::to_string(state_->model_of_body.size()) +
                                " poses, found " + std::to_string(poses.size()));
  without_tasks_from_outside(
      [&] { state_->pose_all([&](std::size_t i) -> const Pose& { return poses[i]; }); });
}

const BodySet& LiveBodies::set() const noexcept {
  return state_->set;
}

}  // namespace bch
