// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include <bch/default_characters.hpp>
#include <bch/import.hpp>

#include "layout/character/eigen.hpp"
#include "layout/character/skinning.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/scene_export.hpp"
#include "tests/support/temporary_folder.hpp"

namespace bch {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

Eigen::Quaternionf turn(float angle, const Eigen::Vector3f& axis) {
  return Eigen::Quaternionf(Eigen::AngleAxisf(angle, axis.normalized()));
}

std::vector<Key<Quaternion>> keys(const std::vector<Key<Eigen::Quaternionf>>& turns) {
  std::vector<Key<Quaternion>> result;
  for (const auto& [time, turn] : turns) result.push_back({time, detail::quaternion(turn)});
  return result;
}

void add_tube_mesh(Character& c) {
  constexpr std::uint32_t rings = 12;
  constexpr std::uint32_t sides = 8;
  c.influence_begin = {0};
  for (std::uint32_t ring = 0; ring <= rings; ++ring) {
    const float z = 1.8f * static_cast<float>(ring) / rings;
    for (std::uint32_t side = 0; side < sides; ++side) {
      const float angle = 2 * pi * static_cast<float>(side) / sides;
      c.vertices.push_back({0.2f * std::cos(angle), 0.15f * std::sin(angle), z});
      // One to three bones a vertex, the nearest the heaviest.
      float sum = 0;
      const std::size_t begin = c.influences.size();
      for (std::uint32_t bone = 0; bone < 3; ++bone) {
        const float distance = std::abs(z - 0.3f - 0.6f * static_cast<float>(bone));
        if (distance > 0.7f) continue;
        c.influences.push_back({bone, 0.8f - distance});
        sum += 0.8f - distance;
      }
      for (std::size_t i = begin; i < c.influences.size(); ++i) c.influences[i].weight /= sum;
      c.influence_begin.push_back(static_cast<std::uint32_t>(c.influences.size()));
    }
  }
  for (std::uint32_t ring = 0; ring < rings; ++ring)
    for (std::uint32_t side = 0; side < sides; ++side) {
      const std::uint32_t a = ring * sides + side;
      const std::uint32_t b = ring * sides + (side + 1) % sides;
      c.triangles.push_back({a, b, b + sides});
      c.triangles.push_back({a, b + sides, a + sides});
    }
}

/// A tube of 1.8 m on three joints that walks and bends; its rest transforms are turned, as real ones are.
Character tube() {
  Character c;
  c.name = "tube";
  c.joints.resize(3);
  c.joints[0] = {"hips", -1, detail::affine3(Eigen::Translation3f(0, 0, 0.6f) * turn(pi / 2, {0, 1, 0}))};
  c.joints[1] = {"spine", 0, detail::affine3(Eigen::Translation3f(-0.4f, 0, 0) * turn(0.3f, {1, 2, 3}))};
  c.joints[2] = {"head", 1, detail::translation({-0.5f, 0.1f, 0})};
  Eigen::Affine3f to_root = Eigen::Affine3f::Identity();
  for (std::uint32_t j = 0; j < 3; ++j) {
    to_root = to_root * detail::to_eigen(c.joints[j].rest);
    c.bones.push_back({j, detail::affine3(to_root.inverse())});
  }
  c.root_joint = 0;
  add_tube_mesh(c);

  Clip clip{"walk", 2.0f, {}};
  clip.channels.resize(3);
  for (std::uint32_t j = 0; j < 3; ++j) clip.channels[j].joint = j;
  clip.channels[0].positions = {{0.0f, {0, 0, 0.6f}}, {0.7f, {0.5f, 0.1f, 0.65f}}, {2.0f, {3, 1, 0.6f}}};
  const Eigen::Quaternionf hips(detail::to_eigen(c.joints[0].rest).linear());
  clip.channels[0].rotations = keys({{0.0f, hips}, {1.0f, turn(1.2f, {0, 0, 1}) * hips}, {2.0f, hips}});
  const Eigen::Quaternionf spine(detail::to_eigen(c.joints[1].rest).linear());
  clip.channels[1].rotations = keys({{0.0f, spine}, {0.5f, spine * turn(0.6f, {0, 1, 0})}, {2.0f, spine}});
  clip.channels[2].rotations = keys({{0.0f, turn(0, {0, 0, 1})}, {2.0f, turn(-0.8f, {0, 0, 1})}});
  c.clips.push_back(clip);

  Clip wave{"nod", 0.5f, {}};
  wave.channels.resize(1);
  wave.channels[0].joint = 2;
  wave.channels[0].rotations = keys({{0.0f, turn(0, {0, 1, 0})}, {0.5f, turn(0.7f, {0, 1, 0})}});
  c.clips.push_back(wave);
  return c;
}

float largest_difference(const Character& a, const Character& b, PoseTime at) {
  detail::Skinner skin_a(a);
  detail::Skinner skin_b(b);
  const auto pose_a = skin_a.pose(at);
  const auto pose_b = skin_b.pose(at);
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

TEST(RoundTrip, BinaryGltf) {
  expect_round_trip(tube(), ".glb");
}
TEST(RoundTrip, Gltf) {
  expect_round_trip(tube(), ".gltf");
}
/// assimp's exporter names the keys after the joint alone, so a second clip would take the place of the
/// first.
TEST(RoundTrip, ColladaWithOneClip) {
  Character c = tube();
  c.clips.resize(1);
  expect_round_trip(c, ".dae");
}

TEST(RoundTrip, KeepsTheFramesOfACharacterInCentimetresAndYUp) {
  Character c = tube();
  // The same body, described in another frame.
  Eigen::Affine3f to_file = Eigen::Affine3f::Identity();
  to_file.linear() << 100, 0, 0, 0, 0, 100, 0, -100, 0;
  c.to_ground = detail::affine3(to_file.inverse());
  Joint root{"file", -1, detail::affine3(to_file)};
  for (Joint& joint : c.joints) ++joint.parent;
  c.joints.insert(c.joints.begin(), root);
  for (Bone& bone : c.bones) ++bone.joint;
  for (Clip& clip : c.clips)
    for (Channel& channel : clip.channels) ++channel.joint;
  ++c.root_joint;
  ASSERT_LT(largest_difference(c, tube(), {0, 1.3f}), 1e-5f);
  expect_round_trip(c, ".glb");
}

TEST(RoundTrip, KeepsSeveralBonesOfOneJoint) {
  Character c = tube();
  // The upper half hangs on a second bone of the spine, whose mesh frame lies elsewhere.
  const auto second = static_cast<std::uint32_t>(c.bones.size());
  Bone shifted = c.bones[1];
  shifted.inverse_bind =
      detail::affine3(detail::to_eigen(shifted.inverse_bind) * Eigen::Translation3f(0, 0, -5));
  c.bones.push_back(shifted);
  for (std::size_t v = c.vertices.size() / 2; v < c.vertices.size(); ++v) {
    c.vertices[v].z += 5;
    for (std::uint32_t i = c.influence_begin[v]; i < c.influence_begin[v + 1]; ++i) {
      c.influences[i].bone = second;
      c.influences[i].weight = 1.0f / static_cast<float>(c.influence_begin[v + 1] - c.influence_begin[v]);
    }
  }
  // A bone stands once in a vertex's list.
  Character merged = c;
  merged.influences.clear();
  merged.influence_begin = {0};
  for (std::size_t v = 0; v < c.vertices.size(); ++v) {
    if (v >= c.vertices.size() / 2)
      merged.influences.push_back({second, 1.0f});
    else
      merged.influences.insert(merged.influences.end(), c.influences.begin() + c.influence_begin[v],
                               c.influences.begin() + c.influence_begin[v + 1]);
    merged.influence_begin.push_back(static_cast<std::uint32_t>(merged.influences.size()));
  }
  expect_round_trip(merged, ".glb");
}

TEST(RoundTrip, DefaultCharacters) {
  expect_round_trip(default_male(), ".glb");
  expect_round_trip(default_female(), ".glb");
}

TEST(RoundTrip, RealCharacter) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real files to read";
  const std::filesystem::path folder = *data / "characters";
  expect_round_trip(import_character(folder / "generic_man_cmu.glb").character, ".glb");
}

}  // namespace
}  // namespace bch
