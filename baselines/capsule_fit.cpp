// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/capsule_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace bch::baselines {
namespace {

using Eigen::Vector3d;
using Ends = std::array<Vector3d, 2>;

constexpr double first_step = 0.02, last_step = 0.0005, least_radius = 0.005;  // metres
constexpr double growth_weight = 0.5;

/// Holds the range of points along a direction.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Extent extent(std::span<const SkinPoint> points, const Vector3d& along) {
  Extent range;
  for (const SkinPoint& p : points) {
    const double t = p.at.dot(along);
    range = {std::min(range.low, t), std::max(range.high, t)};
  }
  return range;
}

/// Returns the capsule about a segment, with the radius that fits best. The farthest point and ends that stick out count like all points at once.
FittedCapsule about(std::span<const SkinPoint> points, const Ends& ends) {
  FittedCapsule fit{ends, 0, 0};
  double weight = 0;
  for (const SkinPoint& p : points) {
    weight += p.weight;
    fit.radius += p.weight * p.normal.dot(offset_from(ends, p.at));
  }
  fit.radius = std::max(fit.radius / weight, least_radius);
  double outside = 0;
  for (const SkinPoint& p : points) {
    fit.error += p.weight * square_error(p, fit);
    outside = std::max(outside, offset_from(ends, p.at).norm() - fit.radius);
  }
  fit.error += growth_weight * weight * outside * outside;
  const Vector3d axis = ends[1] - ends[0];
  if (axis.norm() > 0) {
    const Vector3d along = axis.normalized();
    const Extent range = extent(points, along);
    const double below = std::max(0.0, range.low - (ends[0].dot(along) - fit.radius)),
                 above = std::max(0.0, ends[1].dot(along) + fit.radius - range.high);
    fit.error += weight * (below * below + above * above);
  }
  return fit;
}

}  // namespace

Vector3d offset_from(const Ends& segment, const Vector3d& p) {
  const Vector3d axis = segment[1] - segment[0], to = p - segment[0];
  const double square = axis.squaredNorm();
  return to - (square > 0 ? std::clamp(to.dot(axis) / square, 0.0, 1.0) : 0.0) * axis;
}

double square_error(const SkinPoint& point, const FittedCapsule& capsule) {
  return (offset_from(capsule.ends, point.at) - capsule.radius * point.normal).squaredNorm();
}

FittedCapsule rough_capsule(std::span<const SkinPoint> points) {
  double weight = 0;
  Vector3d mean = Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const SkinPoint& p : points) weight += p.weight, mean += p.weight * p.at;
  mean /= weight;
  for (const SkinPoint& p : points) spread += p.weight * (p.at - mean) * (p.at - mean).transpose();
  const Vector3d along = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
  double from_axis = 0;
  for (const SkinPoint& p : points) from_axis += p.weight * (p.at - mean).cross(along).norm();
  const double radius = from_axis / weight, middle = mean.dot(along);
  const Extent range = extent(points, along);
  double low = range.low + radius, high = range.high - radius;
  if (low > high) low = high = (low + high) / 2;
  return about(points, {mean + (low - middle) * along, mean + (high - middle) * along});
}

FittedCapsule best_capsule(std::span<const SkinPoint> points) {
  FittedCapsule best = rough_capsule(points);
  for (double step = first_step; step > last_step;) {
    const double before = best.error;
    for (std::size_t end = 0; end < 2; ++end)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        for (const double by : {-step, step}) {
          Ends moved = best.ends;
          moved[end][axis] += by;
          const FittedCapsule fit = about(points, moved);
          if (fit.error < best.error) best = fit;
        }
    if (best.error > 0.999 * before) step /= 2;
  }
  return best;
}

}  // namespace bch::baselines
