// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <Eigen/Core>

#include <array>
#include <span>

namespace bch::baselines {

/// Represents a vertex in some pose, as its capsule's bone sees it, and the area that it stands for.
struct WeightedPoint {
  Eigen::Vector3d at;
  double weight;
};

/// Holds a segment, the radius that fits best, and the error: the weighted sum of squares of distances from the capsule's surface, and of
/// how far ends stick out.
struct FittedCapsule {
  std::array<Eigen::Vector3d, 2> ends;
  double radius, error;
};

/// Returns the capsule along the principal axis.
FittedCapsule rough_capsule(std::span<const WeightedPoint> points);

/// Returns the capsule of the least error near the rough one.
FittedCapsule best_capsule(std::span<const WeightedPoint> points);

/// Returns the distance of a point from a segment.
double distance(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 2>& segment);

}  // namespace bch::baselines
