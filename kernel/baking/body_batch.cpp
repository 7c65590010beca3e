// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/baking/body_batch.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "layout/body/posing/model_layout.hpp"

namespace bch::detail {
namespace {

std::vector<BodyLayout> layouts_of(std::span<const BodyModel> models) {
  std::vector<BodyLayout> layouts;
  for (const BodyModel& model : models) layouts.push_back(layout_of(model));
  return layouts;
}

/// Checks which models bodies are of.
std::span<const std::uint32_t> models_of(std::span<const std::uint32_t> model_of_body, std::size_t models) {
  for (std::size_t i = 0; i < model_of_body.size(); ++i)
    if (model_of_body[i] >= models)
      throw std::invalid_argument("bodies: expected one of " + std::to_string(models) + " models, found " +
                                  std::to_string(model_of_body[i]) + " of body " + std::to_string(i));
  return model_of_body;
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

BodyBatch::BodyBatch(std::span<const BodyModel> models, std::span<const std::uint32_t> model_of_body)
    : set(layouts_of(models), models_of(model_of_body, models.size())),
      models_(models.begin(), models.end()),
      model_of_body_(model_of_body.begin(), model_of_body.end()),
      posers_(models.size()) {}

/// Makes posers for all threads before they work, because a frame allocates nothing, whichever thread gets the bodies of a model.
void BodyBatch::reserve_posers() {
  const std::uint32_t threads = task_threads();
  if (threads <= threads_) return;
  std::vector<std::uint32_t> first(models_.size()), bodies(models_.size());
  for (auto i = static_cast<std::uint32_t>(model_of_body_.size()); i-- > 0;)
    first[model_of_body_[i]] = i, ++bodies[model_of_body_[i]];
  for_ranges(models_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m)
      posers_[m].reserve(std::min(threads, bodies[m]),
                         [&] { return SpherePoser(models_[m], set.layout(first[m])); });
  });
  threads_ = threads;
}

void BodyBatch::pose_one(std::uint32_t body, const Pose& pose) {
  const std::uint32_t model = model_of_body_[body];
  try {
    const BodyLayout& layout = set.layout(body);
    const auto poser = posers_[model].borrow([&] { return SpherePoser(models_[model], layout); });
    write_record(layout, poser->pose(pose), set.record(body));
  } catch (...) {
    rethrow_for(body);
  }
  set.publish(body);
}

}  // namespace bch::detail
