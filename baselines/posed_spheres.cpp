// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/posed_spheres.hpp"

#include <algorithm>
#include <cmath>

#include "baselines/posed_skin.hpp"
#include "layout/base/rounding.hpp"
#include "layout/character/eigen.hpp"

namespace bch::baselines {
namespace {

using Eigen::Vector3d;

/// Distances in double err by less than this share.
constexpr double rounding_share = 0x1p-48;

/// The vertices, then the middles that cuts make.
std::vector<Vector3d> points(const BodyModel& model, std::span<const Vec3> positions) {
  std::vector<Vector3d> points;
  for (const Vec3& p : positions) points.push_back(detail::to_eigen(p).cast<double>());
  for (const auto& [i, j] : model.cuts) points.push_back((points[i] + points[j]) / 2);
  return points;
}

Vector3d centre(const BodyModel& model, std::size_t sphere, std::span<const Eigen::Affine3d> joints) {
  Vector3d centre = Vector3d::Zero();
  for (std::size_t i = model.influence_begin[sphere]; i < model.influence_begin[sphere + 1]; ++i) {
    const SphereInfluence& of = model.influences[i];
    const Bone& bone = model.character->bones[of.bone];
    centre += static_cast<double>(of.weight) *
              (joints[bone.joint] * (detail::to_eigen(bone.inverse_bind).cast<double>() *
                                     detail::to_eigen(of.centre).cast<double>()));
  }
  return centre;
}

}  // namespace

std::vector<Sphere> posed_spheres(const BodyModel& model, std::span<const Affine3d> joints,
                                  std::span<const Vec3> positions) {
  const std::vector<Eigen::Affine3d> maps = rooted(*model.character, joints);
  const std::vector<Vector3d> at = points(model, positions);
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < model.sphere_count(); ++i) {
    const Vec3 c = detail::vec3(centre(model, i, maps).cast<float>());
    double radius = model.least_radius.empty() ? 0 : double{model.least_radius[i]};
    for (std::size_t k = model.corner_begin[i]; k < model.corner_begin[i + 1]; ++k)
      radius = std::max(radius, (at[model.corners[k]] - detail::to_eigen(c).cast<double>()).norm());
    spheres.push_back({c.x, c.y, c.z, detail::rounding::round_up(radius * (1 + rounding_share))});
  }
  return spheres;
}

}  // namespace bch::baselines
