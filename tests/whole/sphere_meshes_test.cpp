// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cstdlib>
#include <iostream>

#include "layout/base/heading.hpp"
#include "layout/character/affine_rows.hpp"
#include "tests/support/baseline_scene.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

// Never a miss: wherever posed meshes have a point in common, their bodies of spheres collide. What meshes do is decided by exact tests
// of their triangles. The environment variable BCH_PLACEMENTS asks for so many placements of each kind.

namespace bch {
namespace {

using baselines::Body;
using test::PairScene;
using test::Random;

std::uint32_t placements_of(std::uint32_t usual) {
  const char* const wanted = std::getenv("BCH_PLACEMENTS");
  return wanted != nullptr ? static_cast<std::uint32_t>(std::strtoul(wanted, nullptr, 10)) : usual;
}

/// Returns a rotation about an axis at random by up to an angle.
Affine3d random_turn(Random& random, double most) {
  double x = 0, y = 0, z = 0, length = 0;
  while (length < 0.1 || length > 1) {
    x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
    length = std::sqrt(x * x + y * y + z * z);
  }
  x /= length, y /= length, z /= length;
  const auto [c, s] = detail::rotation(random.uniform(-most, most));
  const double d = 1 - c;
  return {{{c + d * x * x, d * x * y - s * z, d * x * z + s * y, 0},
           {d * y * x + s * z, c + d * y * y, d * y * z - s * x, 0},
           {d * z * x - s * y, d * z * y + s * x, c + d * z * z, 0}}};
}

/// Returns the transforms of all joints to the ground, each joint turned at random.
std::vector<Affine3d> bent(const Character& character, PoseTime at, Random& random, double most) {
  using detail::operator*;
  std::vector<Affine3d> joints = joint_transforms(character, at, JointFrame::parent);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const std::int32_t parent = character.joints[j].parent;
    const Affine3d from =
        parent < 0 ? detail::widened(character.to_ground) : joints[static_cast<std::size_t>(parent)];
    joints[j] = from * joints[j] * random_turn(random, most);
  }
  return joints;
}

/// Characters in poses, as meshes and as spheres.
class People {
 public:
  People(const std::vector<Character>& characters, std::uint32_t poses, std::uint32_t spheres) {
    Random random(81);
    std::vector<BodyModel> models;
    for (const Character& character : characters) {
      models.push_back(make_body(character, {.spheres = spheres, .draft = true}));
      for (const PoseTime& at : sample_poses(character, poses)) {
        const double right_angle = std::numbers::pi / 2;
        joints_.push_back(joint_transforms(character, at, JointFrame::world));
        for (const double most : {right_angle / 3, right_angle, 2 * right_angle})
          joints_.push_back(bent(character, at, random, most));
      }
      model_of_body_.resize(joints_.size(), static_cast<std::uint32_t>(models.size() - 1));
    }
    pose(models);
    meshes = baselines::kind("obb_full").build(bodies, {});
    std::vector<std::vector<Sphere>> less;
    for (std::uint32_t i = 0; i < bodies.size(); ++i)
      for (Sphere& sphere : less.emplace_back(set().spheres(i)))
        sphere.radius = std::max(0.0f, sphere.radius - 0.01f);
    thinner = BodySet(less);
  }

  const BodySet& set() const { return live_->set(); }

  std::vector<Body> bodies;
  std::unique_ptr<baselines::Structure> meshes;
  BodySet thinner{std::vector<std::vector<Sphere>>{}};  ///< by 1 cm

 private:
  void pose(const std::vector<BodyModel>& models) {
    std::vector<ShapeBuilder> shape_builders;
    for (const BodyModel& model : models) shape_builders.emplace_back(*model.character);
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const Pose& at = poses.emplace_back(WorldPose{joints_[i]});
      ShapeBuilder& shape_builder = shape_builders[model_of_body_[i]];
      const auto positions = shape_builder.pose_vertices(at);
      bodies.push_back(
          {{positions.begin(), positions.end()}, models[model_of_body_[i]].character->triangles, {}});
      bodies.back().shape = shape_builder.shape(at);
    }
    live_.emplace(models, model_of_body_).pose(poses);
  }

  std::vector<std::vector<Affine3d>> joints_;
  std::vector<std::uint32_t> model_of_body_;
  std::optional<LiveBodies> live_;
};

class SpheresNeverMiss : public testing::Test {
 protected:
  Random random{20265};
  std::size_t asked = 0, met = 0, of_thinner = 0;

  void expect_none_of(const People& people, std::uint32_t random_pairs, std::uint32_t tangent_pairs) {
    for (const bool on_one_ground : {true, false}) {
      expect_none(people, place(people, placements_of(random_pairs), on_one_ground), "random");
      PairScene scene = place(people, placements_of(tangent_pairs), on_one_ground);
      slide_to_contact(random.next(), scene, {people.meshes.get()});
      expect_none(people, scene, "near tangent");
      // On a grid, so that positions far away are as exact.
      for (auto* at : {&scene.crowd.x, &scene.crowd.y, &scene.crowd.z})
        for (double& each : *at) each = std::nearbyint(each * 0x1p26) * 0x1p-26;
      const std::vector<std::uint8_t> here = expect_none(people, scene, "near tangent on a grid");
      test::move_away(scene, 1e7, -1e7);
      EXPECT_EQ(expect_none(people, scene, "far away"), here);
    }
    EXPECT_GT(met, asked / 5);
    EXPECT_LT(met, asked * 4 / 5);
    EXPECT_GT(of_thinner, 0) << "what less radius does should be seen";
    std::cout << asked << " placements, " << met << " with meshes that meet; spheres 1 cm thinner miss "
              << of_thinner << " of them\n";
  }

 private:
  PairScene place(const People& people, std::uint32_t pairs, bool on_one_ground) {
    PairScene scene = test::placements(random.next(), people.bodies, pairs);
    for (std::size_t i = 0; i < scene.crowd.shape.size() && !on_one_ground; ++i)
      scene.crowd.z.push_back(random.uniform(-0.7, 0.7));
    return scene;
  }

  /// Returns: the hits of the spheres.
  std::vector<std::uint8_t> expect_none(const People& people, const PairScene& scene, const char* what) {
    const Agents agents = scene.crowd.agents();
    std::vector<std::uint8_t> meet(scene.pairs.size()), hits(meet.size()), thinner(meet.size());
    people.meshes->query(agents, scene.pairs, meet);
    collide(people.set(), agents, scene.pairs, hits);
    collide(people.thinner, agents, scene.pairs, thinner);
    for (std::size_t i = 0; i < meet.size(); ++i) {
      met += meet[i], of_thinner += meet[i] > thinner[i] ? 1 : 0;
      EXPECT_LE(meet[i], hits[i]) << what << ": a miss, pair " << i << "; " << test::replay_line(scene, i)
                                  << ", z "
                                  << (scene.crowd.z.empty()
                                          ? 0
                                          : scene.crowd.z[2 * i + 1] - scene.crowd.z[2 * i]);
    }
    asked += meet.size();
    return hits;
  }
};

TEST_F(SpheresNeverMiss, OfDefaultCharacters) {
  expect_none_of(People(test::default_characters(), 6, 128), 10'000, 2'000);
}

TEST_F(SpheresNeverMiss, OfRealCharacters) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to test with";
  expect_none_of(People(test::real_characters(*data), 3, 128), 5'000, 1'000);
}

}  // namespace
}  // namespace bch
