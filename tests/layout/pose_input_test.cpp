// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/affine_rows.hpp"
#include "layout/character/eigen.hpp"
#include "layout/character/skinning.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// Poses that are given as transforms, matrices or vertices have the shape of the clip that these are of.

namespace bch {
namespace {

using test::complaint;

static_assert(!std::is_constructible_v<ShapeBuilder, Character>);
static_assert(!std::is_constructible_v<ShapeBuilder, const Character>);
static_assert(!std::is_constructible_v<ShapeBuilder, Character, ShapeSetPlan, float>);
static_assert(std::is_constructible_v<ShapeBuilder, Character&> &&
              std::is_constructible_v<ShapeBuilder, const Character&>);

/// Returns the bone matrices of a pose, its root joint over the origin.
std::vector<Affine3d> palette(const Character& character, std::vector<Affine3d> joints) {
  double x = 0, y = 0;
  if (character.root_joint >= 0) {
    const Affine3d& root = joints[static_cast<std::size_t>(character.root_joint)];
    x = root.rows[0][3], y = root.rows[1][3];
  }
  for (Affine3d& joint : joints) joint.rows[0][3] -= x, joint.rows[1][3] -= y;
  std::vector<Affine3d> bones;
  for (const Bone& bone : character.bones) {
    using detail::operator*;
    bones.push_back(joints[bone.joint] * detail::widened(bone.inverse_bind));
  }
  return bones;
}

std::vector<Affine3> narrowed(const std::vector<Affine3d>& maps) {
  std::vector<Affine3> narrow(maps.size());
  for (std::size_t k = 0; k < maps.size(); ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) narrow[k].rows[i][j] = static_cast<float>(maps[k].rows[i][j]);
  return narrow;
}
/// The numbers of maps as a renderer keeps them: 4x4 matrices, column by column.
template <class Number>
std::vector<Number> columns(const std::vector<Affine3d>& maps) {
  std::vector<Number> numbers;
  for (const Affine3d& map : maps)
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 3; ++i) numbers.push_back(static_cast<Number>(map.rows[i][j]));
      numbers.push_back(j == 3);
    }
  return numbers;
}

void expect_same(const Shape& shape, const Shape& expected) {
  EXPECT_EQ(shape.outline.points, expected.outline.points);
  EXPECT_EQ(shape.outline.contour_begin, expected.outline.contour_begin);
  EXPECT_EQ(shape.outline.grid_step, expected.outline.grid_step);
  EXPECT_EQ(shape.heights, expected.heights);
  ASSERT_EQ(shape.hierarchy.nodes.size(), expected.hierarchy.nodes.size());
  for (std::size_t i = 0; i < expected.hierarchy.nodes.size(); ++i) {
    const Hierarchy::Node &node = shape.hierarchy.nodes[i], &other = expected.hierarchy.nodes[i];
    ASSERT_EQ(node.disc, other.disc) << i;
    ASSERT_EQ(node.second_child, other.second_child) << i;
  }
}

/// Expects that every way to give a pose has its vertices and its shape.
void expect_one_pose(const Character& character, PoseTime at, ShapeBuilder& by_clip, ShapeBuilder& by_pose) {
  const auto local = joint_transforms(character, at),
             world = joint_transforms(character, at, JointFrame::world), bones = palette(character, world);
  const auto narrow_bones = narrowed(bones);
  const auto matrices = columns<float>(bones);
  const auto numbers = columns<double>(local);
  const std::vector<Vec3> vertices = pose_vertices(character, at);
  const Pose poses[] = {
      LocalPose{local},
      LocalPose{Transforms::column_major(numbers.data(), local.size())},
      WorldPose{world},
      SkinningPalette{bones},
      SkinningPalette{narrow_bones},
      SkinningPalette{Transforms::column_major(matrices.data(), bones.size())},
      PosedVertices{vertices},
  };
  const Shape& expected = by_clip.shape(at);
  for (const Pose& pose : poses) {
    SCOPED_TRACE(character.name + ", way " + std::to_string(&pose - poses));
    EXPECT_EQ(pose_vertices(character, pose), vertices);
    expect_same(by_pose.shape(pose), expected);
  }
}

std::vector<PoseTime> times_of_all_clips(const Character& character) {
  std::vector<PoseTime> times{{}};
  for (std::uint32_t clip = 0; clip < character.clips.size(); ++clip)
    for (const float fraction : {0.0f, 0.37f, 1.0f})
      times.push_back({clip, fraction * character.clips[clip].seconds});
  return times;
}

/// Of a mesh that no joint carries, too, which stands about the middle of its rectangle.
TEST(PoseInput, HasTheBitsOfTheClipInEveryWay) {
  std::vector<Character> all = test::people();
  all.push_back(default_male());
  all.back().root_joint = -1;
  for (const Character& character : all) {
    ShapeBuilder by_clip(character), by_pose(character);
    for (const PoseTime& at : times_of_all_clips(character)) expect_one_pose(character, at, by_clip, by_pose);
  }
}

TEST(PoseInput, HasTheBitsOfTheClipWithHeightsAndAsARoot) {
  const Character woman = default_female();
  for (const ShapeSetPlan& plan : {ShapeSetPlan{.heights = true}, ShapeSetPlan{.depths = {0}}}) {
    ShapeBuilder by_clip(woman, plan), by_pose(woman, plan);
    for (const PoseTime& at : sample_poses(woman, 5)) expect_one_pose(woman, at, by_clip, by_pose);
  }
}

float farthest(std::span<const Vec3> a, std::span<const Vec3> b) {
  float most = 0;
  for (std::size_t v = 0; v < a.size(); ++v)
    most = std::max(most, (detail::to_eigen(a[v]) - detail::to_eigen(b[v])).norm());
  return most;
}

TEST(PoseInput, IsNearTheClipInFloat) {
  const Character man = default_male();
  for (const PoseTime& at : sample_poses(man, 10)) {
    const std::vector<Vec3> vertices = pose_vertices(man, at);
    const auto local = narrowed(joint_transforms(man, at)),
               world = narrowed(joint_transforms(man, at, JointFrame::world));
    EXPECT_LT(farthest(pose_vertices(man, LocalPose{local}), vertices), 2e-6f);
    EXPECT_LT(farthest(pose_vertices(man, WorldPose{world}), vertices), 5e-6f);
  }
}

TEST(PoseInput, PalettesMayBeAnywhereOnTheGround) {
  const Character man = default_male();
  const PoseTime at{2, 7.0f};
  auto bones = palette(man, joint_transforms(man, at, JointFrame::world));
  for (Affine3d& bone : bones) bone.rows[0][3] += 1024, bone.rows[1][3] -= 512;
  EXPECT_LT(farthest(pose_vertices(man, SkinningPalette{bones, 1024, -512}), pose_vertices(man, at)), 1e-6f);
}

TEST(PoseInput, JointsHaveNames) {
  Character man = default_male();
  EXPECT_EQ(man.joints[find_joint(man, "left ankle")].name, "left ankle");
  man.joints[3].name = "left ankle";
  EXPECT_EQ(complaint<std::invalid_argument>([&] { find_joint(man, "left ankle"); }),
            "character 'default male': expected one joint 'left ankle', found 2");
  EXPECT_EQ(complaint<std::invalid_argument>([&] { find_joint(man, "tail"); }),
            "character 'default male': expected one joint 'tail', found 0");
}

TEST(PoseInput, IsRejectedWhereItDoesNotFit) {
  const Character man = default_male();
  ShapeBuilder shape_builder(man);
  const auto complaint_of = [&](const Pose& pose) {
    return complaint<std::invalid_argument>([&] { shape_builder.shape(pose); });
  };
  auto local = joint_transforms(man, {});
  const auto fewer = std::span(local).first(26);
  EXPECT_EQ(complaint_of(LocalPose{fewer}), "shape: expected 27 joint transforms, found 26");
  EXPECT_EQ(complaint_of(WorldPose{fewer}), "shape: expected 27 joint transforms, found 26");
  EXPECT_EQ(complaint_of(SkinningPalette{fewer}), "shape: expected 27 bone matrices, found 26");
  EXPECT_EQ(complaint_of(SkinningPalette{local, 0, std::nan("")}),
            "shape: expected finite origins, found others at index 0");
  std::vector<Vec3> vertices = pose_vertices(man, {});
  EXPECT_EQ(complaint_of(PosedVertices{std::span(vertices).first(9)}),
            "shape: expected " + std::to_string(man.vertices.size()) + " posed vertices, found 9");
  vertices[7].z = std::numeric_limits<float>::infinity();
  EXPECT_EQ(complaint_of(PosedVertices{vertices}),
            "shape: expected finite posed vertices, found others at index 7");
  vertices[7] = {3e6f, 0, 0};
  EXPECT_EQ(complaint_of(PosedVertices{vertices}),
            "outline: expected an extent of 1e-6 to 1e6 m, found 3e+06");
  local[3].rows[2][1] = std::nan("");
  EXPECT_EQ(complaint_of(LocalPose{local}),
            "shape: expected finite joint transforms, found others at index 3");
  expect_same(shape_builder.shape(PosedVertices{pose_vertices(man, {})}), ShapeBuilder(man).shape({}));
}

TEST(PoseInput, AllocatesNothingTheSecondTime) {
  const Character woman = default_female();
  const std::vector<PoseTime> times = sample_poses(woman, 10);
  ShapeBuilder shape_builder(woman), source(woman);
  const auto run = [&] {
    for (const PoseTime& at : times) {
      shape_builder.shape(LocalPose{source.joint_transforms(at)});
      shape_builder.shape(WorldPose{source.joint_transforms(at, JointFrame::world)});
      shape_builder.shape(PosedVertices{source.pose_vertices(at)});
      const WeightedPose mean[] = {{at, 1}, {times[0], 2}};
      shape_builder.shape(LocalPose{source.blend(mean)});
    }
  };
  run();
  const std::size_t before = test::allocation_count();
  run();
  EXPECT_EQ(test::allocation_count(), before);
}

float apart(const std::vector<Affine3d>& a, const std::vector<Affine3d>& b) {
  double most = 0;
  for (std::size_t j = 0; j < a.size(); ++j)
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 4; ++k) most = std::max(most, std::abs(a[j].rows[i][k] - b[j].rows[i][k]));
  return static_cast<float>(most);
}

TEST(Blend, OfOnePoseIsThatPose) {
  for (const Character& character : test::people())
    for (const PoseTime& at : sample_poses(character, 4)) {
      const auto alone = joint_transforms(character, at);
      const WeightedPose one[] = {{{0, 0.5f}, 0}, {at, 0.25f}}, same[] = {{at, 3}, {at, 5}};
      EXPECT_EQ(blend(character, one), alone);
      EXPECT_LT(apart(blend(character, same), alone), 1e-6f);
    }
}

/// Two joints that a clip turns, moves and scales.
Character hinge(float angle) {
  Character c = default_male();
  const auto turn = [](float by) {
    return detail::quaternion(Eigen::Quaternionf(Eigen::AngleAxisf(by, Eigen::Vector3f::UnitY())));
  };
  Channel channel;
  channel.joint = 4;
  channel.positions = {{0, {1, 2, 3}}, {1, {3, 2, 7}}};
  channel.rotations = {{0, turn(0)}, {1, turn(angle)}};
  channel.scales = {{0, {1, 1, 1}}, {1, {3, 1, 2}}};
  c.clips = {{"hinge", 1, {channel}}};
  return c;
}

TEST(Blend, TakesMeansOfWhatClipsMove) {
  const float angle = 1.2f;
  Character c = hinge(angle);
  const WeightedPose poses[] = {{{0, 0}, 1}, {{0, 1}, 1}};
  const auto mean = blend(c, poses);
  // Half-way, a mean of two quaternions is on the arc between them.
  const float cosine = std::cos(angle / 2), sine = std::sin(angle / 2);
  const float expected[3][4] = {
      {2 * cosine, 0, 1.5f * sine, 2}, {0, 1, 0, 2}, {-2 * sine, 0, 1.5f * cosine, 5}};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(mean[4].rows[i][k], expected[i][k], 1e-6) << i << k;
  for (const std::size_t still : {3u, 5u}) EXPECT_EQ(mean[still], detail::widened(c.joints[still].rest));
  // A quaternion and its negative are one rotation.
  Quaternion& end = c.clips[0].channels[0].rotations[1].value;
  end = {-end.x, -end.y, -end.z, -end.w};
  EXPECT_EQ(blend(c, poses), mean);
}

TEST(Blend, RejectsWhatHasNoMean) {
  const Character man = default_male();
  const auto complaint_of = [&](std::vector<WeightedPose> poses) {
    return complaint<std::invalid_argument>([&] { blend(man, poses); });
  };
  EXPECT_EQ(complaint_of({}), "blend: expected a weight above 0, found none");
  EXPECT_EQ(complaint_of({{{}, 0}}), "blend: expected a weight above 0, found none");
  EXPECT_EQ(complaint_of({{{}, 1}, {{}, -2}}), "blend: expected weights from 0 on, found -2 of pose 1");
  EXPECT_EQ(complaint_of({{{99, 0}, 1}, {{}, 1}}), "character 'default male' has no clip 99");
}

/// A shape made by the functions that make one alone.
Shape one_shape(detail::Skinner& skinner, PoseTime at, float threshold = 0.01f) {
  Shape shape{bch::outline(skinner.pose(at), skinner.character().triangles), {}};
  shape.hierarchy = contour_hierarchy(shape.outline, threshold);
  return shape;
}

TEST(ShapeBuilder, MakesTheShapesThatAreMadeOneByOne) {
  for (const Character& character : test::people())
    for (const float threshold : {0.01f, 0.1f}) {
      detail::Skinner skinner(character);
      ShapeBuilder shape_builder(character, {}, threshold);
      for (const PoseTime& time : sample_poses(character, 20))
        expect_same(shape_builder.shape(time), one_shape(skinner, time, threshold));
    }
}

/// Depth 0 without an outline: the same disc, bit for bit.
TEST(ShapeBuilder, NeedsNoOutlineForTheRootAlone) {
  for (const Character& character : test::people()) {
    ShapeBuilder with(character, {.depths = {0}, .heights = true}), without(character, {.depths = {0}});
    for (const PoseTime& time : sample_poses(character, 200)) {
      const Hierarchy &expected = with.shape(time).hierarchy, &root = without.shape(time).hierarchy;
      ASSERT_EQ(root.nodes.size(), 1u);
      EXPECT_EQ(root.nodes[0].disc, expected.nodes[0].disc);
      EXPECT_TRUE(root.nodes[0].is_leaf());
      EXPECT_EQ(root.max_extent, expected.max_extent);
    }
  }
}

void expect_no_allocations_the_second_time(const ShapeSetPlan& plan) {
  const Character woman = default_female();
  ShapeBuilder shape_builder(woman, plan);
  BuiltShape prepared(plan);
  const std::vector<PoseTime> times = sample_poses(woman, 20);
  const std::size_t before = test::allocation_count();
  for (const PoseTime& time : times) prepared.prepare(shape_builder.shape(time), 0);
  const std::size_t first = test::allocation_count();
  EXPECT_GT(first, before);
  for (const PoseTime& time : times) prepared.prepare(shape_builder.shape(time), 0);
  EXPECT_EQ(test::allocation_count(), first);
}

TEST(ShapeBuilder, AllocatesNothingTheSecondTime) {
  expect_no_allocations_the_second_time({});
  expect_no_allocations_the_second_time({.depths = {0}});
  expect_no_allocations_the_second_time({.heights = true});
  expect_no_allocations_the_second_time({.depths = {0, 3, 6, all_depths}});
}

TEST(ShapeBuilder, RejectsWhatItsPartsReject) {
  const Character man = default_male();
  EXPECT_THROW(ShapeBuilder(man, {}, -1.0f).shape({PoseTime::rest, 0}), std::invalid_argument);
  EXPECT_THROW(ShapeBuilder(man, {.depths = {0}}, -1.0f).shape({PoseTime::rest, 0}), std::invalid_argument);
  ShapeBuilder shape_builder(man);
  EXPECT_THROW(shape_builder.shape({static_cast<std::uint32_t>(man.clips.size()), 0}), std::invalid_argument);
  detail::Skinner skinner(man);
  expect_same(shape_builder.shape({PoseTime::rest, 0}), one_shape(skinner, {PoseTime::rest, 0}));
}

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
  EXPECT_LT(farthest(a, b), 3e-6f);
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
