// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <utility>

#include "baselines/fcl_models.hpp"
#include "baselines/pair_distances.hpp"

namespace bch::baselines {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

class FclDistances final : public PairDistances {
 public:
  FclDistances(std::vector<std::shared_ptr<Model>> models, bool in_space)
      : models_(std::move(models)), in_space_(in_space) {}

  double query(const Agents& agents, Pair pair) const override {
    const auto [a, b] = std::minmax(pair.first, pair.second);
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    return fcl::distance(models_[agents.shape[a]].get(), fcl::Transform3d::Identity(),
                         models_[agents.shape[b]].get(), fcl_transform(agents, pair, in_space_), request,
                         result);
  }

 private:
  std::vector<std::shared_ptr<Model>> models_;
  bool in_space_;
};

std::unique_ptr<PairDistances> outline_distances(std::span<const Body> bodies, Upright upright) {
  std::vector<std::shared_ptr<Model>> outlines;
  for (const Body& body : bodies) outlines.push_back(fcl_outline<fcl::OBBRSSd>(body.shape.outline, upright));
  return std::make_unique<FclDistances>(std::move(outlines), false);
}

}  // namespace

std::unique_ptr<PairDistances> fcl_outline_distances(std::span<const Body> bodies) {
  return outline_distances(bodies, Upright::wall);
}

std::unique_ptr<PairDistances> fcl_segment_distances(std::span<const Body> bodies) {
  return outline_distances(bodies, Upright::triangle);
}

std::unique_ptr<PairDistances> fcl_mesh_distances(std::span<const Body> bodies) {
  std::vector<std::shared_ptr<Model>> meshes;
  for (const Body& body : bodies) meshes.push_back(fcl_triangles<fcl::OBBRSSd>(body));
  return std::make_unique<FclDistances>(std::move(meshes), true);
}

}  // namespace bch::baselines
