// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernel/recordings/run_bodies.hpp"
#include "layout/body/body_record.hpp"

namespace bch::detail {
namespace {

/// Returns the way out of something in a direction of space: against it, on the ground. What is straight above or below is left along x.
Vec2 way_out(Vec3 into) {
  const double x = -double{into.x}, y = -double{into.y}, length = std::sqrt(x * x + y * y);
  if (length == 0) return {1, 0};
  return {static_cast<float>(x / length), static_cast<float>(y / length)};
}

/// Holds the answers of clearance() to those who overlap.
struct Deepest {
  explicit Deepest(std::size_t count) : distance(count), direction(count), spheres(count) {}
  BodyClearanceAnswers answers() { return {distance, direction, spheres}; }
  float depth(std::size_t i) const { return std::max(0.0f, -distance[i]); }

  std::vector<float> distance;
  std::vector<Vec3> direction;
  std::vector<DiscPair> spheres;
};

}  // namespace

RunSpheres::RunSpheres(const WalkerBodies& bodies, std::span<const WalkerPose> poses, std::size_t people)
    : RunOf(bodies.pose(poses.first(people)), {}), walkers_(bodies), poses_(poses), numbers_(poses.size()) {
  std::iota(numbers_.begin(), numbers_.end(), 0);
}

const ShapeSetView& RunSpheres::roots() const noexcept {
  return set().view().ground;
}

void RunSpheres::touch(const Agents& agents, std::span<const Pair> pairs,
                       std::span<std::uint8_t> hits) const {
  constexpr std::uint32_t nobody = 0xffff'ffff;
  std::vector<std::uint32_t> numbers(poses_.size(), nobody);
  std::vector<WalkerPose> asked;
  for (const Pair pair : pairs)
    for (const std::uint32_t person : {pair.first, pair.second}) {
      if (numbers[person] != nobody) continue;
      numbers[person] = static_cast<std::uint32_t>(asked.size());
      asked.push_back(poses_[person]);
    }
  Agents of_asked = agents;
  of_asked.shape = numbers;
  bch::collide(walkers_.pose(asked), of_asked, pairs, hits);
}

std::vector<WallDepth> RunSpheres::wall_depths(const Agents& agents, const ObstacleSet& walls) const {
  Deepest deepest(agents.size());
  clearance(set(), agents, walls, deepest.answers(), {.overlap = Overlap::deepest});
  std::vector<WallDepth> in_walls;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const Vec2 out = way_out(deepest.direction[i]);
    in_walls.push_back({deepest.spheres[i].second, deepest.depth(i), out.x, out.y});
  }
  return in_walls;
}

}  // namespace bch::detail
