// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#define XXH_INLINE_ALL  // nothing is linked
#include <xxhash.h>

#include "layout/base/build_implementation.hpp"
#include "layout/body/body_layout.hpp"
#include "layout/body/posing/posing_loops.hpp"
#include "layout/body/sphere_rounding.hpp"
#include "layout/character/blend_loops.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/body_models.hpp"
#include "tests/support/character_shapes.hpp"
#include "tests/support/covered_triangles.hpp"
#include "tests/support/on_threads.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

/// Turns all joints of a pose at random by up to half a turn.
std::vector<Affine3d> bent(std::vector<Affine3d> joints, detail::Random& random, double most) {
  for (Affine3d& joint : joints) {
    const double angle = random.between(-most, most), c = std::cos(angle), s = std::sin(angle);
    const std::uint32_t a = random.below(3), b = (a + 1) % 3;
    for (auto& row : joint.rows) {
      const double old_a = row[a], old_b = row[b];
      row[a] = c * old_a + s * old_b, row[b] = c * old_b - s * old_a;
    }
  }
  return joints;
}

/// Returns the bone matrices of a pose, as a renderer has them.
std::vector<Affine3d> palette(const Character& character, std::span<const Affine3d> world) {
  std::vector<Affine3d> bones;
  for (const Bone& bone : character.bones) {
    const Affine3d& joint = world[bone.joint];
    Affine3d map;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        map.rows[i][j] = j == 3 ? joint.rows[i][3] : 0;
        for (std::size_t k = 0; k < 3; ++k)
          map.rows[i][j] += joint.rows[i][k] * double{bone.inverse_bind.rows[k][j]};
      }
    bones.push_back(map);
  }
  return bones;
}

void expect_covered_in_poses(const BodyModel& model, std::uint32_t poses) {
  const Character& character = *model.character;
  const test::CoveredTriangles held(model);
  BodyPoser poser(model);
  detail::Random random(54);
  test::expect_covered(held, poser, character, Pose());
  for (const PoseTime& at : sample_poses(character, poses)) {
    test::expect_covered(held, poser, character, at);
    const auto world = joint_transforms(character, at, JointFrame::world);
    const auto bones = palette(character, world);
    test::expect_covered(held, poser, character, SkinningPalette{bones, 0.25, -0.5});
    const std::vector<Affine3d> joints = joint_transforms(character, at);
    for (const double degrees : {30.0, 180.0}) {
      const auto turned = bent(joints, random, degrees * std::numbers::pi / 180);
      test::expect_covered(held, poser, character, LocalPose{turned});
    }
  }
}

TEST(BodyPosing, HoldsEveryTriangleInEveryPose) {
  expect_covered_in_poses(test::plain_model(default_male(), 96), test::samples(40));
  expect_covered_in_poses(test::plain_model(default_female(), 500, 0.02f), test::samples(20));
  expect_covered_in_poses(default_body(default_male(), 64), test::samples(40));
}

/// A character far from its origin loses bits: margins have to grow with the extent.
TEST(BodyPosing, HoldsEveryTriangleFarFromTheOrigin) {
  const Character man = default_male();
  const BodyModel model = test::plain_model(man, 96);
  const test::CoveredTriangles held(model);
  BodyPoser poser(model);
  for (const double height : {1e3, 1e5}) {
    std::vector<Affine3d> joints = joint_transforms(man, {0, 0.5f}, JointFrame::world);
    for (Affine3d& joint : joints) joint.rows[2][3] += height;
    test::expect_covered(held, poser, man, WorldPose{joints});
  }
}

TEST(BodyPosing, HoldsMeshesWithoutRootJoints) {
  Character box = default_male();
  box.root_joint = -1;
  expect_covered_in_poses(test::plain_model(box, 40), test::samples(8));
}

TEST(BodyPosing, HoldsRealCharacters) {
  const auto data = test::test_data();
  if (!data) GTEST_SKIP() << "BCH_TEST_DATA is not set: no real characters to test with";
  for (const char* const name : {"rocketbox_male_cmu.glb", "rocketbox_female_cmu.glb", "generic_man_cmu.glb"})
    expect_covered_in_poses(test::plain_model(import_character(*data / "characters" / name).character, 256),
                            test::samples(8));
}

TEST(BodyPosing, GivesTheSameBitsForAllKindsOfTransforms) {
  const Character man = default_male();
  BodyPoser poser(test::plain_model(man, 128));
  const auto spheres_of = [&](const Pose& pose) {
    const auto spheres = poser.spheres(pose);
    return std::vector<Sphere>(spheres.begin(), spheres.end());
  };
  for (const PoseTime& at : sample_poses(man, 9)) {
    const std::vector<Sphere> expected = spheres_of(at);
    EXPECT_EQ(spheres_of(LocalPose{joint_transforms(man, at)}), expected);
    const auto world = joint_transforms(man, at, JointFrame::world);
    EXPECT_EQ(spheres_of(WorldPose{world}), expected);
  }
}

TEST(BodyPosing, MeasuresTheSameBitsByAllInstructionSets) {
  constexpr std::uint32_t spheres = 16, points = 200;
  detail::Random random(7);
  std::vector<float> at(std::size_t{4} * points), centres(std::size_t{4} * spheres);
  for (std::vector<float>* const some : {&at, &centres})
    for (float& number : *some) number = static_cast<float>(random.between(-1, 1));
  std::vector<std::uint32_t> corners, end;
  for (std::uint32_t s = 0; s < spheres; ++s) {
    for (std::uint32_t i = 0; i < s * detail::corner_block; ++i) corners.push_back(random.below(points));
    end.push_back(static_cast<std::uint32_t>(corners.size()));  // the first sphere has none
  }
  const auto measured = [&](const detail::BuildImplementation& by) {
    std::vector<float> all(std::size_t{4} * spheres), least(spheres, 0.5f);
    const detail::SphereFields to{&all[0], &all[spheres], &all[2 * spheres], &all[3 * spheres]};
    by.loops.posing.measure({spheres, at.data(), centres.data(), corners.data(), end.data()}, to);
    all.push_back(by.loops.posing.take_roots(to, spheres, least.data(), 0x1p-20f));
    return all;
  };
  const std::vector<float> expected = measured(detail::build_implementations().back());
  EXPECT_EQ(expected[3 * spheres], 0.5f + 0x1p-20f * 0.5f);
  for (const detail::BuildImplementation& by : detail::build_implementations()) {
    if (!by.supported()) continue;
    EXPECT_EQ(measured(by), expected) << by.name;
  }
}

TEST(BodyPosing, BlendsTheSameBitsByAllInstructionSets) {
  constexpr std::uint32_t max_bones = 6,
                          pairs_of_each = 5;  // of 5 bones and more by the loop for any number
  detail::Random random(8);
  std::vector<float> maps, weighted;
  for (std::uint32_t row = 0; row < 3 * max_bones; ++row) {
    for (int i = 0; i < 4; ++i) maps.push_back(static_cast<float>(random.between(-1, 1)));
    for (int i = 0; i < 4; ++i) maps.push_back(maps[maps.size() - 4]);
  }
  std::vector<detail::BlendPairs::Run> runs;
  std::vector<std::uint32_t> first;
  std::vector<detail::PointPair> pairs;
  for (std::uint32_t bones = 1; bones <= max_bones; ++bones) {
    for (std::uint32_t i = 0; i < pairs_of_each; ++i) {
      const auto number = static_cast<std::uint32_t>(2 * pairs.size());
      pairs.push_back({{number + 1, number}});
      for (std::uint32_t k = 0; k < bones; ++k) first.push_back(24 * random.below(max_bones));
    }
    runs.push_back({bones, static_cast<std::uint32_t>(pairs.size())});
  }
  for (std::size_t i = 0; i < 8 * first.size(); ++i)
    weighted.push_back(static_cast<float>(random.between(-1, 1)));
  const auto blended = [&](const detail::BuildImplementation& by) {
    const detail::BlendPairs all{runs.data(),  runs.size(),     maps.data(),
                                 first.data(), weighted.data(), pairs.data()};
    std::vector<detail::SpaceRow> space(2 * pairs.size());
    std::vector<Vec3> vertices(space.size());
    std::vector<Vec2> ground(space.size());
    EXPECT_TRUE(by.loops.blend.to_space(all, space.data()));
    EXPECT_TRUE(by.loops.blend.to_vertices(all, vertices.data()));
    EXPECT_TRUE(by.loops.blend.to_ground(all, ground.data()));
    for (std::size_t i = 0; i < space.size(); ++i) {
      EXPECT_EQ(vertices[i], (Vec3{space[i].x, space[i].y, space[i].z})) << i;
      EXPECT_EQ(ground[i], (Vec2{space[i].x, space[i].y})) << i;
    }
    return vertices;
  };
  const std::vector<Vec3> expected = blended(detail::build_implementations().back());
  for (const detail::BuildImplementation& by : detail::build_implementations()) {
    if (!by.supported()) continue;
    EXPECT_EQ(blended(by), expected) << by.name;
  }

  weighted[weighted.size() - 3] = std::numeric_limits<float>::infinity();
  for (const detail::BuildImplementation& by : detail::build_implementations()) {
    if (!by.supported()) continue;
    const detail::BlendPairs all{runs.data(),  runs.size(),     maps.data(),
                                 first.data(), weighted.data(), pairs.data()};
    std::vector<Vec2> ground(2 * pairs.size());
    EXPECT_FALSE(by.loops.blend.to_ground(all, ground.data())) << by.name;
  }
}

TEST(BodyModels, OfTheSearchHaveAsManySpheresAsAskedAndHoldAllTriangles) {
  const BodyModel model = make_body(default_male(), {.spheres = 24});
  EXPECT_EQ(model.sphere_count(), 24u);
  EXPECT_NO_THROW(validate(model));
  for (std::size_t s = 0; s < model.sphere_count(); ++s)
    EXPECT_GE(model.corner_begin[s + 1] - model.corner_begin[s], 3u) << s;
  // Of 1434 vertices; those between two spheres are corners of both.
  EXPECT_LT(model.corners.size(), 2 * model.character->vertices.size());
}

TEST(BodyPosing, RefusesWhatItCannotPose) {
  const Character man = default_male();
  BodyPoser poser(test::plain_model(man, 16));
  const std::vector<Affine3d> few(3);
  EXPECT_TRUE(
      test::has(test::complaint([&] { poser.spheres(WorldPose{few}); }), "joint transforms, found 3"));
  EXPECT_TRUE(test::has(test::complaint([&] { poser.spheres(Pose(99, 0.0f)); }), "clip"));
  auto far = joint_transforms(man, {0, 0}, JointFrame::world);
  for (Affine3d& joint : far) joint.rows[2][3] += 1e7;
  EXPECT_TRUE(
      test::has(test::complaint<std::domain_error>([&] { poser.spheres(WorldPose{far}); }), "extent"));
}

/// Two models, whose bodies take turns.
struct PosedCrowd {
  std::vector<BodyModel> models = {test::plain_model(default_male(), 100),
                                   test::plain_model(default_female(), 500)};
  std::vector<std::uint32_t> model_of_body;
  std::vector<Pose> poses;

  explicit PosedCrowd(std::uint32_t bodies) {
    for (std::uint32_t i = 0; i < bodies; ++i) {
      model_of_body.push_back(i % 2);
      poses.emplace_back(0u, 0.013f * static_cast<float>(i));
    }
  }
};

/// Returns a hash of all bodies' records.
std::uint64_t hash_of(const BodySet& set) {
  const detail::BodySetView& view = set.view();
  XXH64_hash_t hash = 0;
  for (std::uint32_t i = 0; i < set.body_count(); ++i) {
    const detail::BodyHeader& header = detail::header_of(view.record(i));
    const std::size_t floats =
        detail::record_nodes + 5 * header.node_stride + 4 * header.leaf_count * header.leaf_size;
    hash = XXH3_64bits_withSeed(view.record(i), floats * sizeof(float), hash);
  }
  return hash;
}

TEST(LiveBodies, HaveTheSpheresOfTheirPosesForAnyNumberOfThreads) {
  const PosedCrowd crowd(101);
  std::vector<std::uint64_t> hashes;
  for (const unsigned threads : {1u, 2u, 4u})
    test::on_threads(threads, [&] {
      LiveBodies live(crowd.models, crowd.model_of_body);
      live.pose(crowd.poses);
      hashes.push_back(hash_of(live.set()));
      if (threads > 1) return;
      BodyPoser posers[] = {BodyPoser(crowd.models[0]), BodyPoser(crowd.models[1])};
      for (std::uint32_t i = 0; i < crowd.poses.size(); ++i) {
        const auto expected = posers[crowd.model_of_body[i]].spheres(crowd.poses[i]);
        EXPECT_EQ(live.set().spheres(i), std::vector<Sphere>(expected.begin(), expected.end())) << i;
      }
    });
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
}

TEST(LiveBodies, AllocateNothingAfterTheFirstFrame) {
  test::on_threads(1, [] {
    const PosedCrowd crowd(40);
    LiveBodies live(crowd.models, crowd.model_of_body);
    live.pose(crowd.poses);
    const std::size_t before = test::allocation_count();
    for (int frame = 0; frame < 3; ++frame) live.pose(crowd.poses);
    EXPECT_EQ(test::allocation_count(), before);
  });
}

TEST(LiveBodies, NameTheBodyThatCannotBePosed) {
  PosedCrowd crowd(20);
  LiveBodies live(crowd.models, crowd.model_of_body);
  crowd.poses[7] = Pose(99, 0.0f);
  EXPECT_TRUE(test::has(test::complaint([&] { live.pose(crowd.poses); }), "body 7: "));
  crowd.poses.pop_back();
  EXPECT_TRUE(test::has(test::complaint([&] { live.pose(crowd.poses); }), "expected 20 poses, found 19"));
  EXPECT_TRUE(test::has(test::complaint([&] {
                          LiveBodies(crowd.models, std::vector<std::uint32_t>{0, 2});
                        }),
                        "found 2 of body 1"));
}

}  // namespace
}  // namespace bch
