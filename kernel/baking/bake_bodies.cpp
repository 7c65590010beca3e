// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/bodies.hpp>

#include "kernel/baking/body_batch.hpp"
#include "kernel/runtime/progress_report.hpp"
#include "layout/base/floating_point_state.hpp"

namespace bch {

using namespace detail;

BodySet bake(std::span<const BodyModel> models, const BakeBodiesOptions& options) {
  const FloatingPointStateGuard floats;
  std::vector<PoseOfBody> sampled;
  for (std::uint32_t m = 0; m < models.size(); ++m) {
    validate(models[m]);
    if (options.bodies.empty())
      for (const PoseTime at : sample_poses(*models[m].character, options.poses)) sampled.push_back({m, at});
  }
  const std::vector<PoseOfBody>& bodies = options.bodies.empty() ? sampled : options.bodies;
  std::vector<std::uint32_t> model_of_body;
  model_of_body.reserve(bodies.size());
  for (const PoseOfBody& body : bodies) model_of_body.push_back(body.model);

  BodyBatch batch(models, model_of_body);
  ProgressReport progress(options.progress, bodies.size());
  batch.pose([&](std::size_t i) -> const Pose& { return bodies[i].pose; }, [&] { progress.part_done(); });
  progress.all_done();
  return std::move(batch.set);
}

BodySet bake(const BodyModel& model, const BakeBodiesOptions& options) {
  return bake(std::span(&model, 1), options);
}

}  // namespace bch
