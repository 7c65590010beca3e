// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/affine_rows.hpp"
#include "layout/character/eigen.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

namespace bch {
namespace {

/// What its manual says of a program: the directions of its axes as a person who looks forwards sees them.
struct Manual {
  const char* name;
  AxisSystem axes;
  Eigen::Vector3d forwards, left, up;  ///< along its axes
  double metres;
  double quarter_to_left;  ///< in its units of turns
};

const Manual manuals[] = {
    {"Unity", AxisSystem::unity, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}, 1, -90},
    {"Unreal", AxisSystem::unreal, {1, 0, 0}, {0, -1, 0}, {0, 0, 1}, 0.01, -90},
    {"glTF", AxisSystem::gltf, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 1, std::numbers::pi / 2},
    {"Godot", AxisSystem::godot, {0, 0, -1}, {-1, 0, 0}, {0, 1, 0}, 1, std::numbers::pi / 2},
    {"ROS", AxisSystem::ros, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, std::numbers::pi / 2},
};

/// The way from our axes to a program's.
Eigen::Affine3d to_theirs(const Manual& of) {
  Eigen::Matrix3d axes;
  axes << of.forwards, of.left, of.up;
  return Eigen::Affine3d(axes / of.metres);
}

Eigen::Affine3d eigen(const Affine3d& map) {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  result.affine() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(map.rows[0]);
  return result;
}
Eigen::Affine3d eigen(const Affine3& map) {
  return detail::to_eigen(map).cast<double>();
}
Affine3d plain(const Eigen::Affine3d& map) {
  Affine3d result;
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(result.rows[0]) = map.affine();
  return result;
}
Affine3 narrow(const Eigen::Affine3d& map) {
  return detail::affine3(Eigen::Affine3f(map.cast<float>()));
}

TEST(Axes, AreThoseOfTheManuals) {
  for (const Manual& of : manuals) {
    SCOPED_TRACE(of.name);
    const Eigen::Vector3d theirs = to_theirs(of) * Eigen::Vector3d(3, 5, 7);
    const auto ours = of.axes.position(theirs.x(), theirs.y(), theirs.z());
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(ours[i], 3 + 2.0 * static_cast<double>(i), 1e-12);
    EXPECT_NEAR(of.axes.heading(of.quarter_to_left), std::numbers::pi / 2, 1e-15);
    const Vec3 point = of.axes.point(detail::vec3(theirs.cast<float>()));
    EXPECT_LT((detail::to_eigen(point) - Eigen::Vector3f(3, 5, 7)).norm(), 1e-6f);
  }
}

/// The man with all that is his in a program's axes.
Character in_axes_of(const Manual& of, const Character& man) {
  const Eigen::Affine3d way = to_theirs(of), back = way.inverse();
  Character theirs = man;
  for (Vec3& vertex : theirs.vertices)
    vertex = detail::vec3((way * detail::to_eigen(vertex).cast<double>()).cast<float>());
  for (Joint& joint : theirs.joints) joint.rest = narrow(way * eigen(joint.rest) * back);
  for (Bone& bone : theirs.bones) bone.inverse_bind = narrow(way * eigen(bone.inverse_bind) * back);
  theirs.clips.clear();
  theirs.to_ground = of.axes.to_ground();
  validate(theirs);
  return theirs;
}

void expect_near(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t v = 0; v < a.size(); ++v)
    ASSERT_LT((detail::to_eigen(a[v]) - detail::to_eigen(b[v])).norm(), 3e-6f) << v;
}

/// One pose as each program has it, of a character as that program has it and of our own.
TEST(Axes, CarryAPose) {
  const Character man = default_male();
  const PoseTime at{1, 4.3f};
  const std::vector<Vec3> expected = pose_vertices(man, at);
  for (const Manual& of : manuals) {
    SCOPED_TRACE(of.name);
    const Eigen::Affine3d way = to_theirs(of), back = way.inverse();
    const Character theirs = in_axes_of(of, man);
    std::vector<Affine3d> local, world, bones;
    for (const Affine3d& joint : joint_transforms(man, at)) local.push_back(plain(way * eigen(joint) * back));
    for (const Affine3d& joint : joint_transforms(man, at, JointFrame::world))
      world.push_back(plain(way * eigen(joint) * back));
    for (const Bone& bone : theirs.bones)
      bones.push_back(plain(eigen(world[bone.joint]) * eigen(bone.inverse_bind)));
    const Eigen::Vector3d root = eigen(of.axes.transform(world[0])).translation();
    expect_near(pose_vertices(theirs, LocalPose{local}), expected);
    expect_near(pose_vertices(theirs, WorldPose{grounded(theirs, world)}), expected);
    expect_near(pose_vertices(theirs, SkinningPalette{grounded(theirs, bones), root.x(), root.y()}),
                expected);
    expect_near(pose_vertices(man, LocalPose{of.axes.transforms(local)}), expected);
    expect_near(pose_vertices(man, WorldPose{of.axes.transforms(world)}), expected);
    std::vector<Vec3> vertices;
    for (const Vec3& vertex : expected)
      vertices.push_back(
          of.axes.point(detail::vec3((way * detail::to_eigen(vertex).cast<double>()).cast<float>())));
    expect_near(pose_vertices(man, PosedVertices{vertices}), expected);
  }
}

}  // namespace
}  // namespace bch
