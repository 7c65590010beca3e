// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <Eigen/Core>

#include <array>
#include <span>

namespace bch::baselines {

/// Represents a vertex in some pose, as its capsule's joint sees it, and the area that it stands for.
struct SkinPoint {
  Eigen::Vector3d at, normal;
  double weight;
};

/// Holds a segment, the radius that fits best, and the error: the weighted sum of square_error(), the square of how far outside the
/// farthest point is, and of how far ends stick out.
struct FittedCapsule {
  std::array<Eigen::Vector3d, 2> ends;
  double radius, error;
};

/// Returns the squared distance between the nearest point of the segment and the point that is as deep below the skin as the capsule is
/// thick. (A distance from the capsule's surface alone would find thin capsules that run along the skin.)
double square_error(const SkinPoint& point, const FittedCapsule& capsule);

/// Returns the capsule along the principal axis.
FittedCapsule rough_capsule(std::span<const SkinPoint> points);

/// Returns the capsule of the least error near the rough one.
FittedCapsule best_capsule(std::span<const SkinPoint> points);

/// Returns the vector to a point from the nearest one of a segment.
Eigen::Vector3d offset_from(const std::array<Eigen::Vector3d, 2>& segment, const Eigen::Vector3d& p);

}  // namespace bch::baselines
