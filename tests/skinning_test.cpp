// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/skinning.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace bch {
namespace {

/// Two joints in a row along z with one triangle at each; the clip walks 4 m along x while the upper joint
/// turns.
Character two_joints() {
  Character c;
  c.name = "two joints";
  c.joints.resize(2);
  c.joints[1].parent = 0;
  c.joints[1].rest.translation() = Eigen::Vector3f(0, 0, 1);
  c.bones.resize(2);
  c.bones[1].joint = 1;
  c.bones[1].inverse_bind.translation() = Eigen::Vector3f(0, 0, -1);
  c.root_joint = 0;
  c.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  for (std::uint32_t v = 0; v < 6; ++v) {
    c.influence_begin.push_back(v);
    c.influences.push_back({v / 3, 1.0f});
  }
  c.influence_begin.push_back(6);
  c.triangles = {{0, 1, 2}, {3, 4, 5}};

  Clip clip{"walk and turn", 2.0f, {}};
  clip.channels.resize(2);
  clip.channels[0].positions = {{0.0f, {0, 0, 0}}, {2.0f, {4, 0, 0}}};
  clip.channels[1].joint = 1;
  const auto turn = [](float angle) {
    return Eigen::Quaternionf(Eigen::AngleAxisf(angle, Eigen::Vector3f::UnitZ()));
  };
  const float pi = std::numbers::pi_v<float>;
  clip.channels[1].rotations = {{0.0f, turn(0)}, {1.0f, turn(pi / 2)}, {2.0f, turn(pi)}};
  c.clips.push_back(clip);
  return c;
}

TEST(Skinning, RestPoseIsTheBindPose) {
  const Character c = two_joints();
  validate(c);
  Skinner skinner(c);
  const auto pose = skinner.pose({});
  for (std::size_t v = 0; v < c.vertices.size(); ++v) EXPECT_EQ(pose[v], c.vertices[v]);
}

TEST(Skinning, TakesOutTheWayButKeepsTheTurn) {
  const Character c = two_joints();
  Skinner skinner(c);
  const auto pose = skinner.pose({0, 1.0f});
  EXPECT_TRUE(pose[1].isApprox(Eigen::Vector3f(1, 0, 0), 1e-6f));
  EXPECT_TRUE(pose[4].isApprox(Eigen::Vector3f(0, 1, 1), 1e-6f)) << pose[4].transpose();
}

TEST(Skinning, BlendsTheBonesOfAVertex) {
  Character c = two_joints();
  c.influence_begin = {0, 1, 2, 3, 4, 6, 7};
  c.influences = {{0, 1}, {0, 1}, {0, 1}, {1, 1}, {0, 0.5f}, {1, 0.5f}, {1, 1}};
  validate(c);
  Skinner skinner(c);
  const auto pose = skinner.pose({0, 2.0f});
  EXPECT_TRUE(pose[4].isApprox(Eigen::Vector3f(0, 0, 1), 1e-6f)) << pose[4].transpose();
}

TEST(Skinning, RejectsTimesAndClipsThatAreNotThere) {
  const Character c = two_joints();
  Skinner skinner(c);
  EXPECT_THROW(skinner.pose({1, 0.0f}), std::invalid_argument);
  EXPECT_THROW(skinner.pose({0, 2.5f}), std::invalid_argument);
  EXPECT_THROW(skinner.pose({0, std::numeric_limits<float>::quiet_NaN()}), std::invalid_argument);
}

TEST(Character, ValidationNamesWhatIsWrong) {
  const auto broken = [](auto&& breakage) {
    Character c = two_joints();
    breakage(c);
    EXPECT_THROW(validate(c), std::invalid_argument);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  broken([](Character& c) { c.triangles.clear(); });
  broken([](Character& c) { c.triangles[0][1] = 6; });
  broken([](Character& c) { c.joints[0].parent = 1; });
  broken([](Character& c) { c.bones[0].joint = 2; });
  broken([](Character& c) { c.influences[0].bone = 2; });
  broken([](Character& c) { c.influences[0].weight = 0.5f; });
  broken([](Character& c) { c.influence_begin[2] = 1; });
  broken([](Character& c) { c.influence_begin.pop_back(); });
  broken([](Character& c) { c.clips[0].channels[1].joint = 0; });
  broken([nan](Character& c) { c.vertices[0].x() = nan; });
  broken([nan](Character& c) { c.clips[0].seconds = nan; });
  broken([](Character& c) {
    std::swap(c.clips[0].channels[0].positions[0], c.clips[0].channels[0].positions[1]);
  });
  broken([](Character& c) { c.clips[0].channels[1].rotations[0].value.coeffs() *= 2; });
}

TEST(Character, PosesAreSpreadOverAllClips) {
  Character c = two_joints();
  c.clips.push_back({"second", 6.0f, {}});
  const auto poses = sample_poses(c, 8);
  ASSERT_EQ(poses.size(), 8u);
  EXPECT_EQ(poses[1].clip, 0u);
  EXPECT_FLOAT_EQ(poses[1].seconds, 1.5f);
  EXPECT_EQ(poses[2].clip, 1u);
  EXPECT_FLOAT_EQ(poses[2].seconds, 0.5f);
  EXPECT_FLOAT_EQ(poses[7].seconds, 5.5f);
}

}  // namespace
}  // namespace bch
