// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/pose_shape.hpp>

namespace bch::baselines {

/// Returns the spheres of a model in a pose, in double: the definition of BodyModel. Each radius is the least float that holds the
/// sphere's corners about the centre in float. `joints`: the transforms of all joints, as of WorldPose; `positions`: of the vertices, as
/// pose_vertices() gives them for the same pose.
std::vector<Sphere> posed_spheres(const BodyModel& model, std::span<const Affine3d> joints,
                                  std::span<const Vec3> positions);

}  // namespace bch::baselines
