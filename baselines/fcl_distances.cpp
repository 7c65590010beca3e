// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>

#include "baselines/fcl_models.hpp"
#include "baselines/outline_distances.hpp"

namespace bch::baselines {
namespace {

class FclDistances final : public OutlineDistances {
 public:
  explicit FclDistances(std::span<const Body> bodies) {
    for (const Body& body : bodies) walls_.push_back(fcl_walls<fcl::OBBRSSd>(body.shape.outline));
  }

  double query(const Agents& agents, Pair pair) const override {
    const auto [a, b] = std::minmax(pair.first, pair.second);
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    return fcl::distance(walls_[agents.shape[a]].get(), fcl::Transform3d::Identity(),
                         walls_[agents.shape[b]].get(), fcl_transform(agents, pair), request, result);
  }

 private:
  std::vector<std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>>> walls_;
};

}  // namespace

std::unique_ptr<OutlineDistances> fcl_outline_distances(std::span<const Body> bodies) {
  return std::make_unique<FclDistances>(bodies);
}

}  // namespace bch::baselines
