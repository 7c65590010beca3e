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

constexpr double first_step = 0.02, last_step = 0.0005;  // metres

/// Holds the range of points along a direction.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Extent extent(std::span<const WeightedPoint> points, const Vector3d& along) {
  Extent range;
  for (const WeightedPoint& p : points) {
    const double t = p.at.dot(along);
    range = {std::min(range.low, t), std::max(range.high, t)};
  }
  return range;
}

/// Returns the capsule about a segment. Ends that stick out count like all points at once.
FittedCapsule about(std::span<const WeightedPoint> points, const Ends& ends) {
  double weight = 0, sum = 0, squares = 0;
  for (const WeightedPoint& p : points) {
    const double d = distance(p.at, ends);
    weight += p.weight, sum += p.weight * d, squares += p.weight * d * d;
  }
  FittedCapsule fit{ends, sum / weight, squares - sum * sum / weight};
  const Vector3d way = ends[1] - ends[0];
  if (way.norm() > 0) {
    const Vector3d along = way.normalized();
    const Extent range = extent(points, along);
    const double below = std::max(0.0, range.low - (ends[0].dot(along) - fit.radius)),
                 above = std::max(0.0, ends[1].dot(along) + fit.radius - range.high);
    fit.error += weight * (below * below + above * above);
  }
  return fit;
}

}  // namespace

double distance(const Vector3d& p, const Ends& segment) {
  const Vector3d way = segment[1] - segment[0], to = p - segment[0];
  const double square = way.squaredNorm();
  const double t = square > 0 ? std::clamp(to.dot(way) / square, 0.0, 1.0) : 0.0;
  return (to - t * way).norm();
}

FittedCapsule rough_capsule(std::span<const WeightedPoint> points) {
  double weight = 0;
  Vector3d mean = Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const WeightedPoint& p : points) weight += p.weight, mean += p.weight * p.at;
  mean /= weight;
  for (const WeightedPoint& p : points) spread += p.weight * (p.at - mean) * (p.at - mean).transpose();
  const Vector3d along = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
  double from_axis = 0;
  for (const WeightedPoint& p : points) from_axis += p.weight * (p.at - mean).cross(along).norm();
  const double radius = from_axis / weight, middle = mean.dot(along);
  const Extent range = extent(points, along);
  double low = range.low + radius, high = range.high - radius;
  if (low > high) low = high = (low + high) / 2;
  return about(points, {mean + (low - middle) * along, mean + (high - middle) * along});
}

FittedCapsule best_capsule(std::span<const WeightedPoint> points) {
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
