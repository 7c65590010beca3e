// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/c_api.hpp"
#include "tests/support/moving_bodies.hpp"
#include "tests/support/test.hpp"

// Poses of one's own by the C interface: every way to give them has the bytes of the clip's.

namespace bch {
namespace {

using test::expect_ok;
using test::made;
using test::MotionCase;

constexpr std::uint32_t joints = 27;
constexpr std::size_t pose_count = 6;

class CApiPoses : public testing::Test {
 protected:
  const Character own = default_male();
  const test::OwnedCharacter man = test::c_person(BCH_MALE);
  std::vector<bch_pose> times = std::vector<bch_pose>(pose_count);

  void SetUp() override { expect_ok(bch_character_sample_poses(man.get(), pose_count, times.data())); }

  std::vector<double> rows(std::int32_t kind) const {
    std::vector<double> all(pose_count * joints * 12);
    for (std::size_t i = 0; i < pose_count; ++i)
      expect_ok(bch_character_get_transforms(man.get(), times[i], kind, &all[i * joints * 12]));
    return all;
  }
};

bch_pose_arrays arrays_of(std::int32_t kind, std::int32_t layout, const void* data, std::size_t of) {
  bch_pose_arrays arrays = BCH_POSE_ARRAYS_INIT;
  arrays.kind = kind, arrays.layout = layout, arrays.data = data, arrays.count = of;
  return arrays;
}

/// Maps of three rows as matrices, column by column.
template <class Number>
std::vector<Number> columns(const std::vector<double>& rows) {
  std::vector<Number> all;
  for (std::size_t map = 0; map < rows.size(); map += 12)
    for (std::size_t column = 0; column < 4; ++column) {
      for (std::size_t row = 0; row < 3; ++row)
        all.push_back(static_cast<Number>(rows[map + 4 * row + column]));
      all.push_back(column == 3);
    }
  return all;
}

/// Bytes of the discs of all shapes.
std::string discs_of(const bch_shape_set* set) {
  std::string all;
  for (std::uint32_t shape = 0; shape < pose_count; ++shape) all += test::bytes(test::discs_of(set, shape));
  return all;
}

TEST_F(CApiPoses, HaveTheBitsOfTheClipInEveryWay) {
  const auto builder = test::c_builder();
  expect_ok(bch_shape_set_builder_add_poses(builder.get(), man.get(), times.data(), pose_count, nullptr));
  const auto by_clip = test::finished(builder);
  const std::string expected = discs_of(by_clip.get());

  const std::vector<double> local = rows(BCH_JOINTS_IN_PARENTS), world = rows(BCH_JOINTS_IN_WORLD);
  const std::vector<double> local_columns = columns<double>(local);
  std::vector<double> padded;  // rows of 4x4 matrices
  for (std::size_t i = 0; i < world.size(); ++i) {
    padded.push_back(world[i]);
    if (i % 12 == 11) padded.insert(padded.end(), {0, 0, 0, 1});
  }
  std::vector<bch_vec3> vertices(pose_count * own.vertices.size());
  for (std::size_t i = 0; i < pose_count; ++i)
    expect_ok(bch_character_get_vertices(man.get(), times[i], &vertices[i * own.vertices.size()]));
  // A bone's matrix is its joint's transform moved by the joint's position at rest, which none turns.
  std::vector<double> bones = world, origins;
  for (std::size_t i = 0; i < pose_count; ++i) {
    double* const pose = &bones[i * joints * 12];
    const double x = pose[3], y = pose[7];
    for (std::size_t bone = 0; bone < joints; ++bone) {
      double* const map = pose + 12 * bone;
      map[3] -= x, map[7] -= y;
      const Affine3& bind = own.bones[bone].inverse_bind;
      for (std::size_t row = 0; row < 3; ++row) {
        const auto at = [&](int axis) { return static_cast<double>(bind.rows[axis][3]); };
        map[4 * row + 3] =
            map[4 * row] * at(0) + map[4 * row + 1] * at(1) + map[4 * row + 2] * at(2) + map[4 * row + 3];
      }
    }
    origins.insert(origins.end(), {0, 0});
  }
  const std::vector<float> matrices = columns<float>(bones);
  std::vector<bch_pose_arrays> ways = {
      arrays_of(BCH_JOINTS_IN_PARENTS, BCH_DOUBLE_ROWS, local.data(), joints),
      arrays_of(BCH_JOINTS_IN_PARENTS, BCH_DOUBLE_COLUMNS, local_columns.data(), joints),
      arrays_of(BCH_JOINTS_IN_WORLD, BCH_DOUBLE_ROWS, world.data(), joints),
      arrays_of(BCH_JOINTS_IN_WORLD, BCH_DOUBLE_ROWS, padded.data(), joints),
      arrays_of(BCH_BONE_MATRICES, BCH_FLOAT_COLUMNS, matrices.data(), joints),
      arrays_of(BCH_BONE_MATRICES, BCH_DOUBLE_ROWS, bones.data(), joints),
      arrays_of(BCH_POSED_VERTICES, BCH_FLOAT_ROWS, vertices.data(), own.vertices.size()),
  };
  ways[3].stride = 16;
  ways[5].origins = origins.data();
  for (const bch_pose_arrays& way : ways) {
    SCOPED_TRACE(&way - ways.data());
    expect_ok(bch_shape_set_builder_add_own_poses(builder.get(), man.get(), &way, pose_count, nullptr));
    const auto by_arrays = test::finished(builder);
    EXPECT_TRUE(discs_of(by_arrays.get()) == expected);
    bch_shape_origin origin;
    expect_ok(bch_shape_set_get_origin(by_arrays.get(), 2, &origin));
    EXPECT_STREQ(origin.character, "default:male");
    EXPECT_EQ(origin.clip, nullptr);

    const auto dynamic = made<bch_dynamic_shape_set_free>(bch_dynamic_shape_set_create, by_clip.get());
    const bch_shape_set* lent = nullptr;
    expect_ok(bch_dynamic_shape_set_get_shapes(dynamic.get(), &lent));
    const std::uint32_t turned[] = {5, 4, 3, 2, 1, 0}, straight[] = {0, 1, 2, 3, 4, 5};
    expect_ok(bch_dynamic_shape_set_replace_own_poses(dynamic.get(), man.get(), turned, &way, pose_count,
                                                      0.01f, nullptr));
    EXPECT_FALSE(discs_of(lent) == expected);
    expect_ok(bch_dynamic_shape_set_replace_own_poses(dynamic.get(), man.get(), straight, &way, pose_count,
                                                      0.01f, nullptr));
    EXPECT_TRUE(discs_of(lent) == expected);

    const auto shaper = made<bch_pose_shaper_free>(bch_pose_shaper_create, man.get(), nullptr);
    for (std::size_t i = 0; i < pose_count; ++i) {
      expect_ok(bch_pose_shaper_make_own(shaper.get(), &way, i));
      expect_ok(bch_shape_set_builder_add_shape(builder.get(), shaper.get()));
    }
    EXPECT_TRUE(discs_of(test::finished(builder).get()) == expected);
  }
}

TEST_F(CApiPoses, CanBeReadAndBlended) {
  std::uint32_t joint = 99;
  expect_ok(bch_character_find_joint(man.get(), "left ankle", &joint));
  const char* name = nullptr;
  std::int32_t parent = 0;
  expect_ok(bch_character_get_joint(man.get(), joint, &name, &parent));
  EXPECT_STREQ(name, "left ankle");
  EXPECT_EQ(parent, own.joints[joint].parent);
  EXPECT_EQ(bch_character_find_joint(man.get(), "tail", &joint), BCH_INVALID_ARGUMENT);
  EXPECT_EQ(bch_character_get_joint(man.get(), joints, &name, nullptr), BCH_OUT_OF_RANGE);

  const float weights[] = {1, 2};
  std::vector<double> mean(joints * 12);
  expect_ok(bch_character_blend(man.get(), times.data(), weights, 2, mean.data()));
  const WeightedPose poses[] = {{{times[0].clip, times[0].seconds}, 1},
                                {{times[1].clip, times[1].seconds}, 2}};
  const std::vector<Affine3d> expected = blend(own, poses);
  for (std::size_t i = 0; i < mean.size(); ++i) ASSERT_EQ(mean[i], expected[i / 12].rows[i % 12 / 4][i % 4]);
  EXPECT_EQ(bch_character_blend(man.get(), times.data(), weights, 0, mean.data()), BCH_INVALID_ARGUMENT);
  EXPECT_EQ(bch_character_get_transforms(man.get(), {99, 0}, BCH_JOINTS_IN_WORLD, mean.data()),
            BCH_OUT_OF_RANGE);
  EXPECT_EQ(bch_character_get_transforms(man.get(), times[0], BCH_BONE_MATRICES, mean.data()),
            BCH_INVALID_ARGUMENT);
}

TEST_F(CApiPoses, AreRejectedWhereTheyDoNotFit) {
  const auto shaper = made<bch_pose_shaper_free>(bch_pose_shaper_create, man.get(), nullptr);
  const std::vector<double> local = rows(BCH_JOINTS_IN_PARENTS);
  const auto expect_rejected = [&](auto change, const std::string& message) {
    bch_pose_arrays arrays = arrays_of(BCH_JOINTS_IN_PARENTS, BCH_DOUBLE_ROWS, local.data(), joints);
    change(arrays);
    EXPECT_EQ(bch_pose_shaper_make_own(shaper.get(), &arrays, 1), BCH_INVALID_ARGUMENT);
    EXPECT_EQ(bch_last_error(), message);
  };
  expect_rejected([](auto& a) { a.count = 26; }, "poses[1]: shape: expected 27 joint transforms, found 26");
  expect_rejected([](auto& a) { a.kind = 4; }, "poses->kind is 4");
  expect_rejected([](auto& a) { a.layout = -1; }, "poses->layout is -1");
  expect_rejected([](auto& a) { a.stride = 11; }, "poses->stride is 11");
  expect_rejected([](auto& a) { a.kind = BCH_POSED_VERTICES; }, "poses->layout is 2");
  expect_rejected([](auto& a) { a.data = nullptr; }, "poses->data is NULL");
  expect_rejected([](auto& a) { a.count = SIZE_MAX / 8; }, "poses->count is " + std::to_string(SIZE_MAX / 8));
  expect_rejected([](auto& a) { a.origins = static_cast<const double*>(a.data); },
                  "poses->origins is not NULL, and there are no bone matrices");
}

}  // namespace
}  // namespace bch
