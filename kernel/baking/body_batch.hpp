// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/bodies.hpp>

#include "kernel/runtime/spares.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/body/body_layout.hpp"
#include "layout/body/posing/sphere_poser.hpp"

namespace bch::detail {

/// Poses many bodies of some models.
class BodyBatch {
 public:
  /// Copies models, which are valid. Body i is one of model model_of_body[i]; its record is still to be written.
  /// Errors:  throws std::invalid_argument on an index of no model.
  BodyBatch(std::span<const BodyModel> models, std::span<const std::uint32_t> model_of_body);
  BodyBatch(const BodyBatch&) = delete;  // because posers refer to models
  BodyBatch& operator=(const BodyBatch&) = delete;

  /// Poses all bodies, body i as pose_of(i) says, on all threads; any of them calls posed() after each one.
  /// Errors:  throws, naming the body, what SpherePoser::pose() throws.
  template <class PoseOf, class Posed>
  void pose(const PoseOf& pose_of, const Posed& posed) {
    without_tasks_from_outside([&] {
      reserve_posers();
      for_ranges(model_of_body_.size(), bodies_per_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          pose_one(static_cast<std::uint32_t>(i), pose_of(i)), posed();
      });
    });
  }

  BodySet set;

 private:
  static constexpr std::size_t bodies_per_task = 16;

  void reserve_posers();
  void pose_one(std::uint32_t body, const Pose& pose);

  const std::vector<BodyModel> models_;
  const std::vector<std::uint32_t> model_of_body_;
  std::vector<Spares<SpherePoser>> posers_;  ///< by model
  std::uint32_t threads_ = 0;                ///< that there are posers for
};

}  // namespace bch::detail
