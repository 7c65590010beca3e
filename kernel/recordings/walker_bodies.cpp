// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/recordings/walker_bodies.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "kernel/runtime/spares.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/body/posing/model_layout.hpp"
#include "layout/body/posing/sphere_poser.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t bodies_per_task = 64;

/// Returns the number of a person's model.
std::uint32_t model_of(const WalkerPose& pose) {
  if (pose.member != WalkerPose::built_in) return pose.member;
  return pose.is_female ? 0 : 1;
}

/// Returns the model that comes with the library, where there is one.
std::optional<BodyModel> model_of_library(const Character& character, std::uint32_t spheres) try {
  return default_body(character, spheres);
} catch (const std::invalid_argument&) {
  return std::nullopt;
}

BodyModel model_of_member(const CharacterEntry& member, std::uint32_t spheres) try {
  if (auto model = model_of_library(member.character, spheres)) return std::move(*model);
  return make_body(member.character, {.spheres = spheres, .draft = true});
} catch (const std::invalid_argument& error) {
  throw std::invalid_argument(member.name + ": " + error.what());
}

}  // namespace

std::vector<BodyModel> body_models(CharacterLibraryView library, std::uint32_t spheres) {
  constexpr double any_stature = 1.7;
  std::vector<BodyModel> models;
  if (library.empty())
    for (const Sex sex : {Sex::female, Sex::male})
      models.push_back(default_body(default_pedestrian(sex, any_stature), spheres));
  for (const CharacterEntry& member : library) models.push_back(model_of_member(member, spheres));
  return models;
}

/// A model of one stature and its posers. They are few, because threads take bodies in their order.
struct WalkerBodies::Body {
  BodyModel model;
  BodyLayout layout;
  Spares<SpherePoser> posers;
};

WalkerBodies::WalkerBodies(std::span<const BodyModel> models, CharacterLibraryView library)
    : models_(models), library_(library) {
  for (const BodyModel& model : models) layouts_.push_back(layout_of(model));
}
WalkerBodies::~WalkerBodies() = default;

void WalkerBodies::prepare(std::span<const WalkerPose> poses) {
  std::vector<Body*> made;
  std::vector<const WalkerPose*> wanted;
  for (const WalkerPose& pose : poses) {
    auto& body = bodies_[pose.body()];
    if (body) continue;
    body = std::make_unique<Body>();
    made.push_back(body.get()), wanted.push_back(&pose);
  }
  for_ranges(made.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t model = model_of(*wanted[i]);
      made[i]->model = models_[model];  // which says nothing of a stature
      made[i]->model.character = std::make_shared<const Character>(wanted[i]->character(library_));
      made[i]->layout = layouts_[model];
    }
  });
}

BodySet WalkerBodies::pose(std::span<const WalkerPose> poses) const {
  std::vector<std::uint32_t> model, order(poses.size());
  std::vector<Body*> body;
  for (const WalkerPose& pose : poses) {
    model.push_back(model_of(pose));
    body.push_back(bodies_.at(pose.body()).get());
  }
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return poses[a].body() < poses[b].body(); });
  BodySet set(layouts_, model);
  for_ranges(order.size(), bodies_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = order[k];
      Body& of = *body[i];
      const auto poser = of.posers.borrow([&] { return SpherePoser(of.model, of.layout); });
      write_record(set.layout(i), poser->pose(poses[i].exact()), set.record(i));
      set.publish(i);
    }
  });
  return set;
}

}  // namespace bch::detail
