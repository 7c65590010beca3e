// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/character/skinning.hpp"

#include <random>

#include "layout/character/eigen.hpp"
#include "layout/character/rotation_blend.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

namespace bch {
namespace {

using test::complaint;

/// Two joints in a row along z with one triangle at each; the clip walks 4 m along x while the upper joint
/// turns.
Character two_joints() {
  Character c;
  c.name = "two joints";
  c.joints.resize(2);
  c.joints[1].parent = 0;
  c.joints[1].rest = detail::translation({0, 0, 1});
  c.bones.resize(2);
  c.bones[1].joint = 1;
  c.bones[1].inverse_bind = detail::translation({0, 0, -1});
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
    return detail::quaternion(Eigen::Quaternionf(Eigen::AngleAxisf(angle, Eigen::Vector3f::UnitZ())));
  };
  const float pi = std::numbers::pi_v<float>;
  clip.channels[1].rotations = {{0.0f, turn(0)}, {1.0f, turn(pi / 2)}, {2.0f, turn(pi)}};
  c.clips.push_back(clip);
  return c;
}

/// Linear blend skinning as it is written, in double and with the library's slerp.
class SlowSkinner {
 public:
  SlowSkinner(const Character& character, PoseTime at) : character_(character), at_(at) {
    for (std::size_t j = 0; j < character.joints.size(); ++j) {
      const std::int32_t parent = character.joints[j].parent;
      const Eigen::Affine3d above = parent < 0 ? detail::to_eigen(character.to_ground).cast<double>()
                                               : world_[static_cast<std::size_t>(parent)];
      world_.push_back(above * local(j));
    }
    if (character.root_joint >= 0)
      origin_ = world_[static_cast<std::size_t>(character.root_joint)].translation();
    origin_.z() = 0;
  }

  Eigen::Vector3d position(std::size_t vertex) const {
    Eigen::Vector3d sum = -origin_;
    for (std::uint32_t i = character_.influence_begin[vertex]; i < character_.influence_begin[vertex + 1];
         ++i) {
      const auto [bone, weight] = character_.influences[i];
      const auto& [joint, inverse_bind] = character_.bones[bone];
      sum += static_cast<double>(weight) *
             (world_[joint] * (detail::to_eigen(inverse_bind).cast<double>() *
                               detail::to_eigen(character_.vertices[vertex]).cast<double>()));
    }
    return sum;
  }

 private:
  template <class Value, class Blend>
  auto value(const std::vector<Key<Value>>& keys, Blend blend) const {
    std::size_t after = 0;
    while (after < keys.size() && keys[after].time <= at_.seconds) ++after;
    if (after == 0) return blend(keys[0].value, keys[0].value, 0.0);
    if (after == keys.size()) return blend(keys[after - 1].value, keys[after - 1].value, 0.0);
    const auto& [begin, a] = keys[after - 1];
    const auto& [end, b] = keys[after];
    return blend(a, b, static_cast<double>(at_.seconds - begin) / static_cast<double>(end - begin));
  }
  Eigen::Vector3d value(const std::vector<Key<Vec3>>& keys) const {
    return value(keys, [](const Vec3& a, const Vec3& b, double t) {
      return Eigen::Vector3d((1 - t) * detail::to_eigen(a).cast<double>() +
                             t * detail::to_eigen(b).cast<double>());
    });
  }

  Eigen::Affine3d local(std::size_t joint) const {
    const Eigen::Affine3d rest = detail::to_eigen(character_.joints[joint].rest).cast<double>();
    Eigen::Vector3d position = rest.translation();
    Eigen::Matrix3d rotation, scaling;
    rest.computeRotationScaling(&rotation, &scaling);
    if (at_.clip != PoseTime::rest)
      for (const Channel& channel : character_.clips[at_.clip].channels) {
        if (channel.joint != joint) continue;
        if (!channel.positions.empty()) position = value(channel.positions);
        if (!channel.scales.empty()) scaling = value(channel.scales).asDiagonal();
        if (!channel.rotations.empty())
          rotation = value(channel.rotations, [](const Quaternion& a, const Quaternion& b, double t) {
            const Eigen::Quaterniond from = detail::to_eigen(a).cast<double>();
            return Eigen::Matrix3d(
                from.slerp(t, detail::to_eigen(b).cast<double>()).normalized().toRotationMatrix());
          });
      }
    return Eigen::Affine3d(Eigen::Translation3d(position) * Eigen::Affine3d(rotation * scaling));
  }

  const Character& character_;
  PoseTime at_;
  std::vector<Eigen::Affine3d> world_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
};

void expect_as_slowly(const Character& character) {
  detail::Skinner skinner(character);
  std::vector<PoseTime> times = sample_poses(character, 10);
  times.push_back({});
  for (const PoseTime& time : times) {
    const auto pose = skinner.pose(time);
    const SlowSkinner slow(character, time);
    const auto ground = skinner.ground_pose(time);
    ASSERT_EQ(ground.size(), pose.size());
    for (std::size_t v = 0; v < pose.size(); ++v) {
      ASSERT_LT((detail::to_eigen(pose[v]).cast<double>() - slow.position(v)).norm(), 5e-6)
          << character.name << " vertex " << v;
      ASSERT_EQ(ground[v], (Vec2{pose[v].x, pose[v].y})) << character.name << " vertex " << v;
    }
  }
}

TEST(Skinning, IsWhatItIsWrittenAs) {
  for (const Character& character : test::people()) expect_as_slowly(character);
}

/// In the rest pose and at times of clips: more bones than have a loop of their own, scales, and keys whose times differ from joint to joint.
TEST(Skinning, BlendsManyBonesWithKeysAtAnyTimes) {
  std::mt19937 random(5);
  const auto uniform = [&] { return std::uniform_real_distribution<float>(-1, 1)(random); };
  const auto rotation = [&] {
    return Eigen::Quaternionf(uniform(), uniform(), uniform(), uniform()).normalized();
  };
  Character c;
  c.name = "many bones";
  c.root_joint = 0;
  c.clips.push_back({"any", 2.0f, std::vector<Channel>(7)});
  for (std::uint32_t j = 0; j < 7; ++j) {
    Joint& joint = c.joints.emplace_back();
    joint.parent = static_cast<std::int32_t>(j / 2) - (j == 0);
    const Eigen::Affine3f rest(Eigen::Translation3f(uniform(), uniform(), uniform()) * rotation());
    joint.rest = detail::affine3(rest);
    c.bones.emplace_back().joint = j;
    c.bones.back().inverse_bind = detail::affine3(rest.inverse());
    Channel& channel = c.clips[0].channels[j];
    channel.joint = j;
    for (std::uint32_t k = 0; k <= j; ++k) {
      const float time = 2 * static_cast<float>(k) / static_cast<float>(j + 1);
      if (j != 3) channel.rotations.push_back({time, detail::quaternion(rotation())});
      if (j % 2 == 0) channel.positions.push_back({0.5f * time, {uniform(), uniform(), uniform()}});
      if (j % 3 == 0) channel.scales.push_back({time, {1, 1 + 0.1f * uniform(), 0.9f}});
    }
  }
  c.influence_begin = {0};
  for (std::uint32_t v = 0; v < 77; ++v) {
    const std::uint32_t count = v % 7 + 1;
    c.vertices.push_back({uniform(), uniform(), uniform()});
    for (std::uint32_t i = 0; i < count; ++i)
      c.influences.push_back({(v + i) % 7, 1 / static_cast<float>(count)});
    c.influence_begin.push_back(static_cast<std::uint32_t>(c.influences.size()));
  }
  c.triangles = {{0, 1, 2}};
  validate(c);
  expect_as_slowly(c);
}

/// What no joint carries stands in the middle of its box.
TEST(Skinning, WithoutARootTheMiddleIsTheOrigin) {
  Character c = two_joints();
  c.root_joint = -1;
  detail::Skinner skinner(c);
  const auto pose = skinner.pose({0, 0.5f});
  Eigen::AlignedBox3f box;
  for (const Vec3& position : pose) box.extend(detail::to_eigen(position));
  EXPECT_LT(box.center().head<2>().norm(), 1e-6f);
  EXPECT_EQ(box.min().z(), 0);
  const auto ground = skinner.ground_pose({0, 0.5f});
  for (std::size_t v = 0; v < pose.size(); ++v) EXPECT_EQ(ground[v], (Vec2{pose[v].x, pose[v].y}));
}

void double_linear_part(Bone& bone) {
  for (auto& row : bone.inverse_bind.rows)
    for (int i = 0; i < 3; ++i) row[i] *= 2;
}

TEST(Skinning, NamesTheFirstVertexThatIsNotFinite) {
  Character c = two_joints();
  c.vertices[2].x = c.vertices[4].y = 3e38f;
  c.influence_begin = {0, 1, 3, 4, 5, 6, 7};
  c.influences = {{0, 1}, {0, 0.5f}, {1, 0.5f}, {0, 1}, {1, 1}, {1, 1}, {1, 1}};
  double_linear_part(c.bones[0]);
  detail::Skinner skinner(c);
  const std::string expected = "character 'two joints': posed vertex 2 is not finite";
  EXPECT_EQ(complaint<std::domain_error>([&] { skinner.pose({}); }), expected);
  EXPECT_EQ(complaint<std::domain_error>([&] { skinner.ground_pose({}); }), expected);
}

TEST(Skinning, AsksNothingOfHeightsThatNobodySees) {
  Character c = two_joints();
  c.vertices[3].z = 3e38f;
  for (Bone& bone : c.bones) double_linear_part(bone);
  detail::Skinner skinner(c);
  EXPECT_EQ(complaint<std::domain_error>([&] { skinner.pose({}); }),
            "character 'two joints': posed vertex 3 is not finite");
  EXPECT_EQ(complaint<std::domain_error>([&] { skinner.ground_pose({}); }), "accepted");
}

TEST(Slerp, TurnsAtConstantSpeedTheShorterWay) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Quaternionf a =
        Eigen::Quaternionf(normal(random), normal(random), normal(random), normal(random)).normalized();
    Eigen::Quaternionf b(normal(random), normal(random), normal(random), normal(random));
    if (i % 2 == 0) b.coeffs() = a.coeffs() + 0.05f * b.coeffs();
    b.normalize();
    const float t = std::uniform_real_distribution<float>(0, 1)(random);
    const Eigen::Quaterniond exact =
        a.cast<double>().normalized().slerp(static_cast<double>(t), b.cast<double>().normalized());
    const Eigen::Quaterniond ours = detail::slerp(detail::quaternion(a), detail::quaternion(b), t);
    ASSERT_NEAR(std::abs(ours.dot(exact)), 1, 1e-13);
    ASSERT_LT(std::min((ours.coeffs() - exact.coeffs()).norm(), (ours.coeffs() + exact.coeffs()).norm()),
              3e-7);
    ASSERT_NEAR(ours.norm(), 1, 1e-15);
  }
}

TEST(Slerp, BeginsAndEndsWhereItShould) {
  const Quaternion a, b{0, 0, 1, 0};
  EXPECT_TRUE(detail::slerp(a, b, 0).isApprox(detail::to_eigen(a).cast<double>(), 1e-15));
  EXPECT_TRUE(detail::slerp(a, b, 1).isApprox(detail::to_eigen(b).cast<double>(), 1e-15));
  EXPECT_TRUE(detail::slerp(a, a, 0.5f).isApprox(detail::to_eigen(a).cast<double>(), 1e-15));
}

TEST(Skinning, RejectsTimesAndClipsThatAreNotThere) {
  const Character c = two_joints();
  detail::Skinner skinner(c);
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
  broken([nan](Character& c) { c.vertices[0].x = nan; });
  broken([nan](Character& c) { c.clips[0].seconds = nan; });
  broken([](Character& c) {
    std::swap(c.clips[0].channels[0].positions[0], c.clips[0].channels[0].positions[1]);
  });
  broken([](Character& c) { c.clips[0].channels[1].rotations[0].value.w = 2; });
  broken([](Character& c) { c.clips[0].channels[0].position_curve.interpolation = Interpolation::cubic; });
  broken([](Character& c) { c.clips[0].channels[0].position_curve.tangents.resize(2); });
  broken([](Character& c) {
    c.clips[0].channels[1].rotation_curve.interpolation = static_cast<Interpolation>(3);
  });
  broken([nan](Character& c) {
    const Vec3 zero;
    c.clips[0].channels[0].position_curve = {Interpolation::cubic, {{zero, zero}, {zero, {nan, 0, 0}}}};
  });
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
