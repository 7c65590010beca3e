// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/standard.hpp"

namespace bch::test {

/// Finds the sphere of each piece of each triangle: the first one that has all of its corners.
class CoveredTriangles {
 public:
  explicit CoveredTriangles(const BodyModel& model);

  /// Returns by how much a piece of some triangle stands out of its sphere, metres; less than 0: how deep all are inside. Corners are
  /// computed from posed vertices in double, whose error is added.
  double protrusion(std::span<const Vec3> posed, std::span<const Sphere> spheres) const;

 private:
  using Point = std::array<double, 3>;
  double protrusion(const std::array<std::uint32_t, 3>& corners, const std::array<Point, 3>& at,
                    std::span<const Sphere> spheres) const;

  const BodyModel& model_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> cut_;
  std::vector<std::vector<std::uint32_t>> owners_;  ///< spheres by corner
};

/// Expects that spheres hold all triangles of a pose, and have room for what a query rounds.
void expect_covered(const CoveredTriangles& triangles, BodyPoser& poser, const Character& character,
                    const Pose& pose);

}  // namespace bch::test
