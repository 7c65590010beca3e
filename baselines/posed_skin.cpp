// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/posed_skin.hpp"

#include <algorithm>

#include "baselines/visible_skin.hpp"
#include "layout/character/eigen.hpp"

namespace bch::baselines {
namespace {

using Eigen::Vector3d;

Eigen::Affine3d to_eigen(const Affine3d& map) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) result.matrix()(row, column) = map.rows[row][column];
  return result;
}

Vector3d to_eigen(const Vec3& p) {
  return detail::to_eigen(p).cast<double>();
}

/// A third of the area of all triangles at a vertex, where bind positions are.
std::vector<double> areas_of(const Character& character) {
  std::vector<double> areas(character.vertices.size());
  for (const auto& corners : character.triangles) {
    const auto at = [&](std::size_t i) { return to_eigen(character.vertices[corners[i]]); };
    const double area = (at(1) - at(0)).cross(at(2) - at(0)).norm() / 6;
    for (const std::uint32_t corner : corners) areas[corner] += area;
  }
  return areas;
}

std::span<const Influence> influences(const Character& character, std::size_t vertex) {
  return std::span(character.influences)
      .subspan(character.influence_begin[vertex],
               character.influence_begin[vertex + 1] - character.influence_begin[vertex]);
}

std::vector<std::uint32_t> strongest_joints(const Character& character) {
  std::vector<std::uint32_t> joints;
  for (std::size_t v = 0; v < character.vertices.size(); ++v) {
    const auto of = influences(character, v);
    joints.push_back(character
                         .bones[std::max_element(of.begin(), of.end(),
                                                 [](const Influence& a, const Influence& b) {
                                                   return a.weight < b.weight;
                                                 })
                                    ->bone]
                         .joint);
  }
  return joints;
}

std::vector<Vector3d> posed(const Character& character, std::span<const Eigen::Affine3d> joints) {
  std::vector<Eigen::Affine3d> bones;
  for (const Bone& bone : character.bones)
    bones.push_back(joints[bone.joint] * detail::to_eigen(bone.inverse_bind).cast<double>());
  std::vector<Vector3d> positions;
  for (std::size_t v = 0; v < character.vertices.size(); ++v) {
    Vector3d& at = positions.emplace_back(Vector3d::Zero());
    for (const Influence& of : influences(character, v))
      at += static_cast<double>(of.weight) * (bones[of.bone] * to_eigen(character.vertices[v]));
  }
  return positions;
}

/// Directions out of the skin, means over the triangles at a vertex weighted by area.
std::vector<Vector3d> normals_of(const Character& character, const std::vector<Vector3d>& positions) {
  std::vector<Vector3d> normals(positions.size(), Vector3d::Zero());
  for (const auto& [i, j, k] : character.triangles) {
    const Vector3d across = (positions[j] - positions[i]).cross(positions[k] - positions[i]);
    for (const std::uint32_t corner : {i, j, k}) normals[corner] += across;
  }
  for (Vector3d& normal : normals) normal.normalize();
  return normals;
}

/// Returns the transforms of joints with the root's point on the ground as the origin, as poses of a character have it.
std::vector<Eigen::Affine3d> rooted(const Character& character, std::span<const Affine3d> joints) {
  std::vector<Eigen::Affine3d> maps;
  for (const Affine3d& joint : joints) maps.push_back(to_eigen(joint));
  if (character.root_joint < 0) return maps;
  const Vector3d root = maps[static_cast<std::size_t>(character.root_joint)].translation();
  for (Eigen::Affine3d& map : maps) map.pretranslate(Vector3d(-root.x(), -root.y(), 0));
  return maps;
}

}  // namespace

PosedSkin::PosedSkin(const Character& character, std::span<const std::vector<Affine3d>> poses)
    : character_(character), areas_(areas_of(character)), joint_of_vertex_(strongest_joints(character)) {
  for (const std::vector<Affine3d>& joints : poses) {
    maps_.push_back(rooted(character, joints));
    positions_.push_back(posed(character, maps_.back()));
    normals_.push_back(normals_of(character, positions_.back()));
  }
  visible_ = visible_vertices(character.triangles, positions_[0], normals_[0]);
}

std::vector<SkinPoint> PosedSkin::in_frame_of(std::uint32_t joint,
                                              std::span<const std::uint32_t> vertices) const {
  std::vector<SkinPoint> points;
  for (std::size_t pose = 0; pose < poses(); ++pose) {
    const Eigen::Affine3d back = map(0, joint) * map(pose, joint).inverse();
    for (const std::uint32_t v : vertices)
      points.push_back({back * positions_[pose][v], back.linear() * normals_[pose][v], areas_[v]});
  }
  return points;
}

}  // namespace bch::baselines
