// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/covered_triangles.hpp"

#include <gtest/gtest.h>

#include "layout/body/sphere_rounding.hpp"

namespace bch::test {
namespace {

constexpr double in_none = 1e9;  ///< protrusion of a piece that is in no sphere

double extent_of(std::span<const Sphere> spheres) {
  double max_extent = 0;
  for (const Sphere& s : spheres)
    max_extent = std::max(max_extent, std::hypot(double{s.x}, double{s.y}, double{s.z}) + double{s.radius});
  return max_extent;
}

}  // namespace

CoveredTriangles::CoveredTriangles(const BodyModel& model) : model_(model) {
  const auto vertices = static_cast<std::uint32_t>(model.character->vertices.size());
  for (std::uint32_t i = 0; i < model.midpoints.size(); ++i)
    cut_.try_emplace(std::minmax(model.midpoints[i][0], model.midpoints[i][1]), vertices + i);
  owners_.resize(vertices + model.midpoints.size());
  for (std::uint32_t s = 0; s < model.sphere_count(); ++s)
    for (std::uint32_t i = model.corner_begin[s]; i < model.corner_begin[s + 1]; ++i)
      owners_[model.corners[i]].push_back(s);
}

double CoveredTriangles::protrusion(std::span<const Vec3> posed, std::span<const Sphere> spheres) const {
  double most = -in_none;
  for (const auto& triangle : model_.character->triangles) {
    std::array<Point, 3> at;
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = {double{posed[triangle[k]].x}, double{posed[triangle[k]].y}, double{posed[triangle[k]].z}};
    const double one = protrusion(triangle, at, spheres);
    EXPECT_LT(one, in_none) << "a piece in no sphere";
    most = std::max(most, one);
  }
  return most;
}

double CoveredTriangles::protrusion(const std::array<std::uint32_t, 3>& corners,
                                    const std::array<Point, 3>& at, std::span<const Sphere> spheres) const {
  double least = in_none;
  for (const std::uint32_t s : owners_[corners[0]]) {
    const auto begin = model_.corners.begin() + model_.corner_begin[s],
               end = model_.corners.begin() + model_.corner_begin[s + 1];
    if (!std::binary_search(begin, end, corners[1]) || !std::binary_search(begin, end, corners[2])) continue;
    double most = 0;
    for (const auto& [x, y, z] : at) {
      const double dx = x - double{spheres[s].x}, dy = y - double{spheres[s].y},
                   dz = z - double{spheres[s].z};
      most = std::max(most, std::sqrt(dx * dx + dy * dy + dz * dz) * (1 + 0x1p-48));
    }
    least = std::min(least, most - double{spheres[s].radius});
  }
  if (least < in_none) return least;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    const auto found = cut_.find(std::minmax(corners[k], corners[l]));
    if (found == cut_.end()) continue;
    Point half;
    for (std::size_t i = 0; i < 3; ++i) half[i] = (at[k][i] + at[l][i]) / 2;
    const double both =
        std::max(protrusion({corners[k], found->second, corners[m]}, {at[k], half, at[m]}, spheres),
                 protrusion({found->second, corners[l], corners[m]}, {half, at[l], at[m]}, spheres));
    least = std::min(least, both);
  }
  return least;
}

void expect_covered(const CoveredTriangles& triangles, BodyPoser& poser, const Character& character,
                    const Pose& pose) {
  const std::span<const Sphere> spheres = poser.spheres(pose);
  const double room = detail::rounding::sphere_margin * extent_of(spheres);
  EXPECT_LE(triangles.protrusion(pose_vertices(character, pose), spheres), -room * (1 - 1e-4));
}

}  // namespace bch::test
