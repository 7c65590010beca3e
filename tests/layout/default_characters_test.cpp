// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <random>

#include "baselines/welzl.hpp"
#include "layout/character/eigen.hpp"
#include "layout/character/skinning.hpp"
#include "layout/default_character/pedestrian_speeds.hpp"
#include "layout/import/character_bytes.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using Eigen::Vector3d;

/// What the header promises about a character.
struct Expectation {
  Character (*make)();
  double stature;
  double mean_radius;
  double least_volume, max_volume;  // at rest, cubic metres
};

class DefaultCharacter : public testing::TestWithParam<Expectation> {
 protected:
  Character character = GetParam().make();
};

std::string name_of(const testing::TestParamInfo<Expectation>& test) {
  return std::vector<std::string>{"male", "female", "bulky_male"}.at(test.index);
}

// A person of 60 to 95 kg is about as dense as water. The bulky man has the volume that the paper's table 1 implies.
INSTANTIATE_TEST_SUITE_P(All, DefaultCharacter,
                         testing::Values(Expectation{default_male, 1.88, 0.42, 0.050, 0.100},
                                         Expectation{default_female, 1.74, 0.34, 0.050, 0.100},
                                         Expectation{default_bulky_male, 1.88, 0.42, 0.135, 0.139}),
                         name_of);

/// The radius of the smallest disc that holds the points seen from above.
double enclosing_radius(std::span<const Vec3> points) {
  std::vector<Vec2> ground;
  for (const Vec3& p : points) ground.push_back({p.x, p.y});
  return std::sqrt(bench::Welzl()(ground).square_radius);
}

Vector3d exact(const Vec3& p) {
  return detail::to_eigen(p).cast<double>();
}

double signed_volume(const Character& c) {
  double volume = 0;
  for (const auto& t : c.triangles)
    volume += exact(c.vertices[t[0]]).dot(exact(c.vertices[t[1]]).cross(exact(c.vertices[t[2]]))) / 6;
  return volume;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> edges(const Character& c) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> found;
  for (const auto& t : c.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto ends = std::minmax(t[i], t[(i + 1) % 3]);
      found.insert({ends.first, ends.second});
    }
  return found;
}

TEST_P(DefaultCharacter, IsValidAndTheSameEachTime) {
  EXPECT_NO_THROW(validate(character));
  EXPECT_EQ(detail::to_bytes({character, {}}), detail::to_bytes({GetParam().make(), {}}));
  EXPECT_EQ(character.joints[static_cast<std::size_t>(character.root_joint)].name, "pelvis");
}

TEST_P(DefaultCharacter, HasTheSizeOfThePaper) {
  EXPECT_GE(character.triangles.size(), 2800u);
  EXPECT_LE(character.triangles.size(), 2900u);
  detail::Skinner skinner(character);
  Eigen::AlignedBox3f box;
  for (const Vec3& p : skinner.pose({})) box.extend(detail::to_eigen(p));
  EXPECT_NEAR(box.max().z(), GetParam().stature, 0.01);
  EXPECT_NEAR(box.min().z(), 0, 0.002);
}

TEST_P(DefaultCharacter, SkinIsOneClosedSphere) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> directed;
  for (const auto& t : character.triangles)
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(directed.insert({t[i], t[(i + 1) % 3]}).second);
  for (const auto& [a, b] : directed) EXPECT_TRUE(directed.contains({b, a}));

  const auto undirected = edges(character);
  std::vector<std::uint32_t> component(character.vertices.size());
  std::iota(component.begin(), component.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (component[v] != v) v = component[v];
    return v;
  };
  for (const auto& [a, b] : undirected) component[root(a)] = root(b);
  std::set<std::uint32_t> roots;
  for (std::uint32_t v = 0; v < component.size(); ++v) roots.insert(root(v));
  EXPECT_EQ(roots.size(), 1u);
  EXPECT_EQ(character.vertices.size() + character.triangles.size(), undirected.size() + 2);
}

TEST_P(DefaultCharacter, SkinHasTheVolumeOfAPersonAndNoFlatTriangle) {
  EXPECT_GT(signed_volume(character), GetParam().least_volume);
  EXPECT_LT(signed_volume(character), GetParam().max_volume);
  for (const auto& t : character.triangles) {
    const Vector3d a = exact(character.vertices[t[0]]);
    const Vector3d b = exact(character.vertices[t[1]]);
    const Vector3d c = exact(character.vertices[t[2]]);
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    EXPECT_GT((b - a).cross(c - a).norm() / longest, 3e-4) << a.transpose();
  }
}

float distance(const Vec3& p, const Vec3& q) {
  return (detail::to_eigen(p) - detail::to_eigen(q)).norm();
}

TEST_P(DefaultCharacter, RestIsSymmetric) {
  for (const Vec3& p : character.vertices) {
    const Vec3 mirrored{p.x, -p.y, p.z};
    const bool found = std::any_of(character.vertices.begin(), character.vertices.end(),
                                   [&](const Vec3& q) { return distance(q, mirrored) < 1e-5f; });
    EXPECT_TRUE(found) << detail::to_eigen(p).transpose();
  }
}

TEST_P(DefaultCharacter, VerticesFollowFewBones) {
  std::size_t blended = 0;
  for (std::size_t v = 0; v < character.vertices.size(); ++v) {
    const auto count = character.influence_begin[v + 1] - character.influence_begin[v];
    EXPECT_LE(count, 5u);
    blended += count > 1 ? 1 : 0;
  }
  EXPECT_GT(blended, character.vertices.size() / 3);
}

TEST_P(DefaultCharacter, ClipsLastAsLongAsThePapersAndAreOfItsKinds) {
  float seconds = 0;
  std::map<std::string, int> kinds;
  for (const Clip& clip : character.clips) {
    seconds += clip.seconds;
    ++kinds[clip.name.substr(0, clip.name.find(' '))];
  }
  EXPECT_EQ(seconds, 212.0f);
  for (const char* kind : {"walk", "turn", "side-step", "idle"}) EXPECT_GE(kinds[kind], 2) << kind;
}

TEST_P(DefaultCharacter, IsAsWideAsThePapers) {
  detail::Skinner skinner(character);
  const auto check = [&](const std::vector<PoseTime>& poses) {
    double sum = 0, squares = 0;
    for (const PoseTime& at : poses) {
      const double radius = enclosing_radius(skinner.pose(at));
      sum += radius;
      squares += radius * radius;
    }
    const auto count = static_cast<double>(poses.size());
    EXPECT_NEAR(sum / count, GetParam().mean_radius, 0.02);
    const double deviation = std::sqrt(squares / count - sum * sum / (count * count));
    EXPECT_GT(deviation, 0.03);
    EXPECT_LT(deviation, 0.07);
  };
  check(sample_poses(character, 100));

  // A random time is a random one of very many even samples: no distribution of the library's is involved.
  const std::vector<PoseTime> dense = sample_poses(character, 21200);
  std::mt19937 random(20140501);
  std::vector<PoseTime> poses;
  for (int i = 0; i < 100; ++i) poses.push_back(dense[random() % dense.size()]);
  check(poses);
}

TEST_P(DefaultCharacter, FeetStayOnTheGround) {
  detail::Skinner skinner(character);
  for (const PoseTime& at : sample_poses(character, 1000)) {
    float lowest = 1;
    for (const Vec3& p : skinner.pose(at)) lowest = std::min(lowest, p.z);
    EXPECT_NEAR(lowest, 0, 0.015) << character.clips[at.clip].name << " at " << at.seconds;
  }
}

TEST_P(DefaultCharacter, SkinDoesNotTear) {
  detail::Skinner skinner(character);
  const auto all = edges(character);
  for (const PoseTime& at : sample_poses(character, 200)) {
    const auto pose = skinner.pose(at);
    for (const auto& [a, b] : all) {
      const float rest = distance(character.vertices[a], character.vertices[b]);
      ASSERT_LT(distance(pose[a], pose[b]), 2.5f * rest + 0.03f)
          << character.clips[at.clip].name << " at " << at.seconds << ", near "
          << detail::to_eigen(character.vertices[a]).transpose();
    }
  }
}

TEST_P(DefaultCharacter, MovesWithoutJumps) {
  detail::Skinner skinner(character);
  for (std::uint32_t clip = 0; clip < character.clips.size(); ++clip) {
    const float step = 1.0f / 16;
    std::vector<Vec3> before;
    for (float time = 0.5f * step; time <= character.clips[clip].seconds; time += step) {
      const auto pose = skinner.pose({clip, time});
      float farthest = 0;
      for (std::size_t v = 0; v < before.size(); ++v)
        farthest = std::max(farthest, distance(pose[v], before[v]));
      // 6.5 m/s is a foot in fast walking, or a hand in a broad gesture.
      ASSERT_LT(farthest / step, 6.5f) << character.clips[clip].name << " at " << time;
      before.assign(pose.begin(), pose.end());
    }
  }
}

/// A pedestrian of each sex, and the distance between a foot on the ground and where it was before.
TEST(Pedestrians, FeetOnTheGroundStayWhereTheyAre) {
  for (const Sex sex : {Sex::female, Sex::male}) {
    const double stature = sex == Sex::male ? 1.8 : 1.6;
    const Character character = default_pedestrian(sex, stature);
    ASSERT_EQ(character.clips.size(), detail::pedestrian_speeds);
    for (std::uint32_t clip = 0; clip < detail::pedestrian_speeds; clip += 6) {
      const Channel& pelvis = character.clips[clip].channels[0];
      const float scale = character.to_ground.rows[0][0];
      const float way = scale * (pelvis.positions.back().value.x - pelvis.positions.front().value.x);
      EXPECT_NEAR(way / pelvis.positions.back().time, detail::pedestrian_speed_step * clip, 1e-4)
          << character.clips[clip].name;
    }
  }
}

/// A clip is one stride: its last pose is its first one, that much further on.
TEST(Pedestrians, StridesCanBeRepeated) {
  for (const Sex sex : {Sex::female, Sex::male}) {
    const Character character = default_pedestrian(sex, 1.7, sex == Sex::male ? 0.7 : 0);
    for (std::uint32_t clip = 0; clip < detail::pedestrian_speeds; ++clip) {
      const float seconds = character.clips[clip].seconds;
      const double speed = detail::pedestrian_speed_step * clip;
      EXPECT_NEAR(static_cast<double>(seconds) * pedestrian_strides_per_second(speed), 1, 1e-6);
      const std::vector<Vec3> first = pose_vertices(character, {clip, 0}),
                              last = pose_vertices(character, {clip, seconds});
      for (std::size_t v = 0; v < first.size(); ++v) ASSERT_LT(distance(first[v], last[v]), 2e-6f) << clip;
      const auto head = [&](float at) {
        return joint_transforms(character, {clip, at}, JointFrame::world)[4].rows[0][3];
      };
      EXPECT_NEAR(head(seconds) - head(0), speed * static_cast<double>(seconds), 1e-6);
    }
  }
}

TEST(Pedestrians, StandUnderTheirHeadsWithTheirStature) {
  for (const double stature : {1.2, 1.75, 2.0}) {
    const Character character = default_pedestrian(Sex::male, stature);
    EXPECT_EQ(character.joints.at(static_cast<std::size_t>(character.root_joint)).name, "head");
    detail::Skinner skinner(character);
    for (const std::uint32_t clip : {0u, 45u}) {
      float highest = 0, lowest = 9, crown_x = 9;
      for (const Vec3& p : skinner.pose({clip, 0.3f})) {
        lowest = std::min(lowest, p.z);
        if (p.z > highest) highest = p.z, crown_x = p.x;
      }
      EXPECT_NEAR(lowest, 0, 0.01);
      EXPECT_NEAR(highest, stature, 0.05 * stature) << clip;
      EXPECT_NEAR(crown_x, 0, 0.06);
    }
  }
}

TEST(Pedestrians, StridesAreThoseThatPeopleTake) {
  EXPECT_NEAR(2 * pedestrian_strides_per_second(1.4), 2.0, 0.05);           // steps a second
  EXPECT_NEAR(1.4 / (2 * pedestrian_strides_per_second(1.4)), 0.71, 0.02);  // metres a step
}

TEST(Pedestrians, TurnTheirShoulders) {
  const auto width = [](double shoulders) {
    const Character character = default_pedestrian(Sex::male, 1.75, shoulders);
    detail::Skinner skinner(character);
    float left = 0;
    for (const Vec3& p : skinner.pose({0, 0.0f})) left = std::max(left, p.y);
    return left;
  };
  EXPECT_LT(width(0.7), width(0) - 0.02f);
  EXPECT_THROW(default_pedestrian(Sex::male, 1.75, 1.5), std::invalid_argument);
  EXPECT_THROW(default_pedestrian(Sex::female, 3), std::invalid_argument);
  EXPECT_THROW(default_pedestrian(Sex::female, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace bch
