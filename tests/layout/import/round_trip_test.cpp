// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <filesystem>

#include <bch/default_characters.hpp>

#include "tests/support/character_shapes.hpp"
#include "tests/support/import_test.hpp"
#include "tests/support/scene_export.hpp"

namespace bch {
namespace {

/// Returns how far the corners of two characters' triangles are from each other at most.
float largest_difference(const Character& a, const Character& b, PoseTime at) {
  detail::Skinner skin_a(a), skin_b(b);
  const auto pose_a = skin_a.pose(at), pose_b = skin_b.pose(at);
  float largest = 0;
  for (std::size_t t = 0; t < a.triangles.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner)
      largest = std::max(largest, (detail::to_eigen(pose_a[a.triangles[t][corner]]) -
                                   detail::to_eigen(pose_b[b.triangles[t][corner]]))
                                      .norm());
  return largest;
}

/// Writes a character, reads it back, and compares every corner of every triangle at several times.
void expect_round_trip(const Character& original, const std::string& extension) {
  validate(original);
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.file("character" + extension);
  write_with_assimp(original, file);
  const Character back = import_character(file).character;

  EXPECT_EQ(back.vertices.size(), original.vertices.size());
  ASSERT_EQ(back.triangles.size(), original.triangles.size());
  EXPECT_EQ(back.bones.size(), original.bones.size());
  ASSERT_EQ(back.clips.size(), original.clips.size());
  ASSERT_GE(back.root_joint, 0);
  EXPECT_EQ(back.joints[static_cast<std::size_t>(back.root_joint)].name,
            original.joints[static_cast<std::size_t>(original.root_joint)].name);
  EXPECT_LT(largest_difference(original, back, PoseTime{}), 1e-4f);
  for (std::uint32_t c = 0; c < original.clips.size(); ++c) {
    // Collada has one library of animations, whose name assimp puts before each.
    EXPECT_TRUE(back.clips[c].name.ends_with(original.clips[c].name)) << back.clips[c].name;
    ASSERT_NEAR(back.clips[c].seconds, original.clips[c].seconds, 1e-4f);
    const float end = std::min(back.clips[c].seconds, original.clips[c].seconds);
    for (const float share : {0.0f, 0.2f, 0.41f, 0.5f, 0.83f, 1.0f})
      EXPECT_LT(largest_difference(original, back, {c, share * end}), 1e-4f) << "clip " << c << ", " << share;
  }
}

TEST(RoundTrip, OfEveryFormat) {
  expect_round_trip(default_male(), ".glb");
  expect_round_trip(default_female(), ".gltf");
  // assimp's exporter names the keys after the joint alone, so a second clip would take the place of the first.
  Character c = default_male();
  c.clips.resize(1);
  expect_round_trip(c, ".dae");
}

TEST(RoundTrip, KeepsTheFramesOfACharacterInCentimetresAndYUp) {
  Character c = default_male();
  // The same body, described in another frame.
  Eigen::Affine3f to_file = Eigen::Affine3f::Identity();
  to_file.linear() << 100, 0, 0, 0, 0, 100, 0, -100, 0;
  c.to_ground = detail::affine3(detail::to_eigen(c.to_ground) * to_file.inverse());
  Joint root{"file", -1, detail::affine3(to_file)};
  for (Joint& joint : c.joints) ++joint.parent;
  c.joints.insert(c.joints.begin(), root);
  for (Bone& bone : c.bones) ++bone.joint;
  for (Clip& clip : c.clips)
    for (Channel& channel : clip.channels) ++channel.joint;
  ++c.root_joint;
  ASSERT_LT(largest_difference(c, default_male(), {0, 1.3f}), 1e-5f);
  expect_round_trip(c, ".glb");
}

TEST(RoundTrip, KeepsSeveralBonesOfOneJoint) {
  Character c = default_male();
  // The upper half hangs on a second bone of a joint, whose mesh frame lies elsewhere.
  const auto second = static_cast<std::uint32_t>(c.bones.size());
  Bone shifted = c.bones[1];
  shifted.inverse_bind =
      detail::affine3(detail::to_eigen(shifted.inverse_bind) * Eigen::Translation3f(0, 0, -5));
  c.bones.push_back(shifted);
  std::vector<Influence> influences;
  std::vector<std::uint32_t> begin = {0};
  for (std::size_t v = 0; v < c.vertices.size(); ++v) {
    if (c.vertices[v].z > 1)
      influences.push_back({second, 1.0f}), c.vertices[v].z += 5;
    else
      influences.insert(influences.end(), c.influences.begin() + c.influence_begin[v],
                        c.influences.begin() + c.influence_begin[v + 1]);
    begin.push_back(static_cast<std::uint32_t>(influences.size()));
  }
  c.influences = influences, c.influence_begin = begin;
  expect_round_trip(c, ".glb");
}

TEST(RoundTrip, RealCharacter) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real files to read";
  expect_round_trip(import_character(*data / "characters/generic_man_cmu.glb").character, ".glb");
}

}  // namespace
}  // namespace bch
