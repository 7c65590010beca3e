// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/import_test.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/test.hpp"

namespace bch {
namespace {

using Import = test::ImportTest;
using test::farthest_in_clips;
using test::has_note;

/// A tetrahedron with its long edge along an axis and its right-handed base in the other two.
std::string tetrahedron_obj(float width, float depth, float height, int up) {
  float corners[4][3] = {};
  corners[1][(up + 1) % 3] = width;
  corners[2][(up + 2) % 3] = depth;
  corners[3][up] = height;
  std::string text;
  for (const auto& corner : corners) {
    text += "v";
    for (const float coordinate : corner) text.append(" ").append(std::to_string(coordinate));
    text += "\n";
  }
  return text + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
}

/// Positive for a character of right-handed corners 0, 1, 2, 3 as tetrahedron_obj() lists them.
float signed_volume(const Character& character) {
  detail::Skinner skinner(character);
  const auto pose = skinner.pose({});
  float volume = 0;
  for (const auto& [a, b, c] : character.triangles)
    volume += detail::to_eigen(pose[a]).dot(detail::to_eigen(pose[b]).cross(detail::to_eigen(pose[c]))) / 6;
  return volume;
}

TEST_F(Import, StaticMeshFollowsItsNodeAndPolygonsBecomeTriangles) {
  const auto [character, report] =
      import("post.obj", "v 0 0 0\nv 0.5 0 0\nv 0.5 1.8 0\nv 0 1.8 0\nv 9 9 9\nf 1 2 3 4\nl 1 5\n");
  EXPECT_EQ(character.name, "post");
  EXPECT_EQ(character.triangles.size(), 2u);
  EXPECT_EQ(character.vertices.size(), 4u);
  EXPECT_EQ(report.bones, 1u);
  ASSERT_EQ(character.bones.size(), 1u);
  EXPECT_TRUE(detail::to_eigen(character.bones[0].inverse_bind).isApprox(Eigen::Affine3f::Identity()));
  EXPECT_EQ(character.root_joint, -1);
  EXPECT_EQ(report.dropped_faces, 1u);
  EXPECT_GE(report.dropped_vertices, 1u);
  EXPECT_NEAR(report.height, 1.8f, 1e-6f);
  EXPECT_TRUE(has_note(report, "y up -> z up, guessed"));
}

TEST_F(Import, GuessesTheUnitFromTheHeight) {
  const struct {
    float height, metres;
    const char* note;
  } cases[] = {{1.7f, 1.7f, "metres, guessed"},
               {170.0f, 1.7f, "centimetres -> metres, guessed"},
               {1700.0f, 1.7f, "millimetres -> metres, guessed"},
               {72.0f, 1.8288f, "inches -> metres, guessed"},
               {8.0f, 8.0f, "no unit can be guessed"}};
  for (const auto& [height, metres, note] : cases) {
    const auto [character, report] =
        import("body.obj", tetrahedron_obj(0.2f * height, 0.1f * height, height, 1));
    EXPECT_NEAR(report.height, metres, 1e-4f);
    EXPECT_TRUE(has_note(report, note));
  }
}

TEST_F(Import, GuessesTheUpAxisAndNeverMirrors) {
  for (const int up : {1, 2}) {
    const auto [character, report] = import("body.obj", tetrahedron_obj(0.5f, 0.3f, 1.8f, up));
    EXPECT_NEAR(report.height, 1.8f, 1e-6f) << "axis " << up;
    EXPECT_GT(signed_volume(character), 0) << "axis " << up;
  }
}

TEST_F(Import, OptionsOverrideUpAndScale) {
  const std::string body = tetrahedron_obj(0.5f, 0.3f, 1.8f, 1);  // z is the width, x the depth
  ImportOptions options;
  options.scale = 0.5f;
  for (const auto& [up, height] :
       {std::pair(ImportOptions::UpAxis::x, 0.3f), std::pair(ImportOptions::UpAxis::y, 1.8f),
        std::pair(ImportOptions::UpAxis::z, 0.5f)}) {
    options.up = up;
    const auto [character, report] = import("body.obj", body, options);
    EXPECT_NEAR(report.height, 0.5f * height, 1e-6f);
    EXPECT_GT(signed_volume(character), 0);
    EXPECT_TRUE(has_note(report, "as the caller says"));
  }
}

TEST_F(Import, WeldsOnlyVerticesOfEqualInfluences) {
  SkinnedStrip strip;
  strip.positions = {0, 0, 0, 0.5f, 0, 0, 0, 1.8f, 0, 0.5f, 1.8f, 0, 0, 0, 0, 0.5f, 1.8f, 0};
  strip.indices = {0, 1, 3, 4, 5, 2};
  // Vertex 4 repeats 0 with its bone; 5 repeats 3 with the other bone.
  strip.joints.insert(strip.joints.end(), {0, 1, 0, 0, 0, 1, 0, 0});
  strip.weights.insert(strip.weights.end(), {1, 0, 0, 0, 1, 0, 0, 0});
  const auto [character, report] = import("strip.gltf", strip.text());
  EXPECT_EQ(character.vertices.size(), 5u);
  EXPECT_EQ(character.triangles[0][0], character.triangles[1][0]);
  EXPECT_NE(character.triangles[0][2], character.triangles[1][1]);
}

TEST_F(Import, SkinnedMeshPlaysItsClip) {
  for (const std::string name : {"strip.gltf", "strip.glb"}) {
    const GltfFile file = SkinnedStrip().file();
    const auto [character, report] = import(name, name == "strip.glb" ? file.binary() : file.text());
    ASSERT_EQ(character.clips.size(), 1u);
    EXPECT_EQ(character.clips[0].name, "walk");
    EXPECT_EQ(character.clips[0].seconds, 2.0f);
    EXPECT_EQ(report.clips.at(0).channels, 2u);
    EXPECT_TRUE(has_note(report, "y up -> z up"));
    // The camera goes, with its place 9 m away.
    for (const Joint& joint : character.joints) EXPECT_NE(joint.name, "camera");
    ASSERT_GE(character.root_joint, 0);
    EXPECT_EQ(character.joints[static_cast<std::size_t>(character.root_joint)].name, "hips");

    detail::Skinner skinner(character);
    const auto pose = skinner.pose({0, 2.0f});
    // x of the file stays x; a turn about its y by 90 degrees takes x to its -z, which is the ground's y.
    const std::uint32_t foot = character.triangles[0][1];
    const std::uint32_t hand = character.triangles[0][2];
    EXPECT_TRUE(detail::to_eigen(pose[foot]).isApprox(Eigen::Vector3f(0.5f, 0, 0), 1e-5f))
        << detail::to_eigen(pose[foot]).transpose();
    EXPECT_TRUE(detail::to_eigen(pose[hand]).isApprox(Eigen::Vector3f(0, 0.5f, 1.8f), 1e-5f))
        << detail::to_eigen(pose[hand]).transpose();
  }
}

TEST_F(Import, NormalisesWeightsAndSaysSo) {
  SkinnedStrip strip;
  strip.weights = {0.3f, 0, 0, 0, 1, 0.25f, 0, 0, 0, 1, 0, 0, 0.5f, 0.5f, 0, 0};
  const auto [character, report] = import("strip.gltf", strip.text());
  EXPECT_TRUE(has_note(report, "the weights of 2 vertices"));
  const std::uint32_t mixed = character.triangles[0][1];
  const std::uint32_t begin = character.influence_begin[mixed];
  ASSERT_EQ(character.influence_begin[mixed + 1] - begin, 2u);
  EXPECT_NEAR(character.influences[begin].weight, 0.8f, 1e-6f);
  EXPECT_NEAR(character.influences[begin + 1].weight, 0.2f, 1e-6f);
}

TEST_F(Import, VertexWithoutWeightsFollowsTheNearest) {
  SkinnedStrip strip;
  strip.weights[12] = strip.weights[13] = 0;  // at the top, nearest to vertex 2, which follows the head
  const auto [character, report] = import("strip.gltf", strip.text());
  EXPECT_TRUE(has_note(report, "1 vertex of mesh 0 'strip' without weights"));
  const Influence& given = character.influences[character.influence_begin[character.triangles[0][2]]];
  EXPECT_EQ(character.joints[character.bones[given.bone].joint].name, "head");
}

TEST_F(Import, RepairsTheOrderOfKeysAndTheNormOfRotations) {
  SkinnedStrip strip;
  const Character good = import("good.gltf", strip.text()).character;
  strip.times = {0, 2, 1};
  std::swap_ranges(strip.way.begin() + 3, strip.way.begin() + 6, strip.way.begin() + 6);
  std::swap_ranges(strip.turns.begin() + 4, strip.turns.begin() + 8, strip.turns.begin() + 8);
  for (float& part : strip.turns) part *= 3;
  const auto [character, report] = import("odd.gltf", strip.text());
  EXPECT_TRUE(has_note(report, "2 lists of keys put in order"));
  EXPECT_TRUE(has_note(report, "3 rotations normalised"));
  EXPECT_LT(farthest_in_clips(character, 0, good, 0), 1e-5f);
}

TEST_F(Import, MovesAClipThatStartsBeforeZero) {
  SkinnedStrip strip;
  const Character good = import("good.gltf", strip.text()).character;
  strip.times = {-1, 0, 1};
  const auto [character, report] = import("early.gltf", strip.text());
  EXPECT_TRUE(has_note(report, "starts before time 0"));
  EXPECT_EQ(character.clips.at(0).seconds, 2.0f);
  EXPECT_LT(farthest_in_clips(character, 0, good, 0), 1e-5f);
}

TEST_F(Import, RootIsTheJointThatWalks) {
  const auto root = [&](const SkinnedStrip& strip) {
    const Character c = import("strip.gltf", strip.text()).character;
    return c.joints.at(static_cast<std::size_t>(c.root_joint)).name;
  };
  SkinnedStrip strip;
  EXPECT_EQ(root(strip), "hips");
  // The armature sways while the hips walk away from it.
  strip.sway = {0, 0, 0, 0.1f, 0, 0, 0, 0, 0};
  EXPECT_EQ(root(strip), "hips");
  // The armature walks, and the hips sway in it.
  std::swap(strip.sway, strip.way);
  EXPECT_EQ(root(strip), "armature");
  // Nothing leaves its place: the lowest joint that carries all vertices.
  strip.sway.clear();
  strip.way.assign(9, 0);
  EXPECT_EQ(root(strip), "hips");
}

TEST_F(Import, EveryInstanceOfAMeshCounts) {
  GltfFile gltf;
  const std::string positions = gltf.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 0}, "VEC3");
  gltf.add_json("'meshes':[{'primitives':[{'attributes':{'POSITION':" + positions + "}}]}]");
  gltf.add_json(
      "'nodes':[{'children':[1,2],'scale':[0.5,0.5,0.5]},{'mesh':0,'translation':[2,0,0]},"
      "{'mesh':0,'translation':[0,4,0]}],'scenes':[{'nodes':[0]}],'scene':0");
  const auto [character, report] = import("two.gltf", gltf.text());
  EXPECT_EQ(report.meshes, 2u);
  ASSERT_EQ(character.triangles.size(), 2u);
  ASSERT_EQ(character.vertices.size(), 6u);
  EXPECT_EQ(character.root_joint, -1);
  EXPECT_NEAR(report.height, 3.0f, 1e-6f);
  detail::Skinner skinner(character);
  const auto pose = skinner.pose({});
  const Eigen::Vector3f between =
      detail::to_eigen(pose[character.triangles[1][0]]) - detail::to_eigen(pose[character.triangles[0][0]]);
  EXPECT_TRUE(between.isApprox(Eigen::Vector3f(-1, 0, 2), 1e-6f)) << between.transpose();
}

}  // namespace
}  // namespace bch
