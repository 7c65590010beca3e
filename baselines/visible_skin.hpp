// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace bch::baselines {

/// Returns which vertices are seen from far away: three of nine rays out of the skin meet no triangle. Inner layers of clothes are not,
/// although one may look up a skirt.
std::vector<bool> visible_vertices(std::span<const std::array<std::uint32_t, 3>> triangles,
                                   std::span<const Eigen::Vector3d> positions,
                                   std::span<const Eigen::Vector3d> normals);

}  // namespace bch::baselines
