// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/poses.hpp>

#include "layout/character/affine_rows.hpp"

namespace bch {

using namespace detail;

Affine3 AxisSystem::to_ground() const {
  Affine3 map;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) map.rows[i][j] = static_cast<float>(metres * rows[i][j]);
  return map;
}

std::array<double, 3> AxisSystem::position(double x, double y, double z) const {
  std::array<double, 3> ours;
  for (std::size_t i = 0; i < 3; ++i) ours[i] = metres * (rows[i][0] * x + rows[i][1] * y + rows[i][2] * z);
  return ours;
}

Vec3 AxisSystem::point(const Vec3& theirs) const {
  const auto [x, y, z] =
      position(static_cast<double>(theirs.x), static_cast<double>(theirs.y), static_cast<double>(theirs.z));
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

Affine3d AxisSystem::transform(const Affine3d& theirs) const {
  Affine3d turn, back;  // the rows are those of a rotation or a reflection: its inverse has them as columns
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) turn.rows[i][j] = back.rows[j][i] = rows[i][j];
  Affine3d ours = turn * theirs * back;
  for (auto& row : ours.rows) row[3] *= metres;
  return ours;
}

std::vector<Affine3d> AxisSystem::transforms(const Transforms& theirs) const {
  std::vector<Affine3d> ours;
  for (std::size_t i = 0; i < theirs.size(); ++i) ours.push_back(transform(theirs[i]));
  return ours;
}

std::vector<Affine3d> grounded(const Character& character, const Transforms& maps) {
  const Affine3d to_ground = widened(character.to_ground);
  std::vector<Affine3d> ours;
  for (std::size_t i = 0; i < maps.size(); ++i) ours.push_back(to_ground * maps[i]);
  return ours;
}

}  // namespace bch
