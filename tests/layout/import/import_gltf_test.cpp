// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/gltf_file.hpp"
#include "tests/support/import_test.hpp"
#include "tests/support/quoted.hpp"
#include "tests/support/table.hpp"
#include "tests/support/test.hpp"

// Extensions, morph targets, accessors, faces and scenes: what glTF 2.0 allows beside what exporters mostly write, and what it forbids.

namespace bch {
namespace {

using test::has_note;
using test::ImportGltf;
using test::with;

/// A node of a triangle (0, 0, 0), (1, 0, 0), (0, 2, 0) whose accessors are given.
std::string triangle(GltfFile gltf, const std::string& positions, const std::string& rest = "",
                     const std::string& mesh = "", const std::string& node = "") {
  gltf.add_json("'meshes':[{" + mesh + "'primitives':[{" + rest + "'attributes':{'POSITION':" + positions +
                "}}]}]");
  gltf.add_json("'nodes':[{" + node + "'mesh':0}],'scenes':[{'nodes':[0]}]");
  return gltf.text();
}

const std::vector<float> corners = {0, 0, 0, 1, 0, 0, 0, 2, 0};

// ---- Extensions and morph targets

TEST_F(ImportGltf, RequiredExtensionsAreRead) {
  const auto text = [](const std::string& extension) {
    GltfFile gltf;
    gltf.add_json("'extensionsRequired':['" + extension + "']");
    const std::string positions = gltf.add(corners, "VEC3");
    return triangle(std::move(gltf), positions);
  };
  for (const char* name : {"KHR_materials_unlit", "KHR_texture_transform", "KHR_mesh_quantization"})
    EXPECT_EQ(import(text(name)).report.triangles, 1u) << name;
}

TEST_F(ImportGltf, OptionalExtensionsAreReadOrNamedByANote) {
  GltfFile gltf;
  gltf.add_json("'extensionsUsed':['EXT_mesh_gpu_instancing','KHR_materials_unlit','KHR_node_visibility']");
  const std::string positions = gltf.add(corners, "VEC3");
  const ImportReport report = import(triangle(std::move(gltf), positions)).report;
  const auto named = [&](const std::string& extension) {
    return std::ranges::count(report.notes,
                              "uses the glTF extension '" + extension +
                                  "', which is not read: what it adds, moves or hides, if anything, is lost");
  };
  EXPECT_EQ(named("EXT_mesh_gpu_instancing"), 1);
  EXPECT_EQ(named("KHR_node_visibility"), 1);
  EXPECT_EQ(named("KHR_materials_unlit"), 0);
}

TEST_F(ImportGltf, PositionsMayBeQuantised) {
  GltfFile normalised;
  const std::string positions =
      normalised.add(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 0, -32767, 0}, "VEC3", true);
  EXPECT_NEAR(import(triangle(normalised, positions)).report.height, 1, 1e-6f);
  GltfFile plain;
  const std::string whole = plain.add(std::vector<std::uint8_t>{0, 0, 0, 1, 0, 0, 0, 200, 0}, "VEC3");
  EXPECT_NEAR(import(triangle(plain, whole, "", "", "'scale':[0.01,0.01,0.01],")).report.height, 2, 1e-5f);
}

TEST_F(ImportGltf, MorphTargetsThatMoveNothingAreNotedAndOthersRefused) {
  const auto text = [](const std::string& mesh, const std::string& node, const std::string& path,
                       const std::vector<float>& weights) {
    GltfFile gltf;
    const std::string positions = gltf.add(corners, "VEC3");
    const std::string times = gltf.add(std::vector<float>{0, 1}, "SCALAR");
    const std::string output = gltf.add(weights, "SCALAR");
    gltf.add_json("'animations':[{'channels':[{'sampler':0,'target':{'node':0,'path':'" + path +
                  "'}}],'samplers':[{'input':" + times + ",'output':" + output + "}]}]");
    return triangle(gltf, positions, "'targets':[{'POSITION':" + positions + "}],", mesh, node);
  };
  EXPECT_TRUE(
      has_note(import(text("", "", "weights", {0, 0})).report, "has morph targets, which are ignored"));
  EXPECT_EQ(import(text("'weights':[0.0],", "", "weights", {0, 0})).report.triangles, 1u);
  EXPECT_EQ(import(text("'weights':[0.5],", "'weights':[0],", "weights", {0, 0})).report.triangles, 1u);
  expect_error(text("'weights':[0.5],", "", "weights", {0, 0}),
               "meshes[0].weights[0] moves vertices by a morph");
  expect_error(text("", "'weights':[0.5],", "weights", {0, 0}),
               "nodes[0].weights[0] moves vertices by a morph");
  expect_error(text("", "", "weights", {0, 1}), "animations[0] animates morph targets of node 'nodes[0]'");
  EXPECT_TRUE(has_note(import(text("", "", "pointer", {0, 1})).report, "1 channel of no node"));
}

// ---- Accessors, faces and scenes

TEST_F(ImportGltf, AccessorsMayBeSparse) {
  GltfFile gltf;
  const std::uint8_t element = 2;
  const float place[] = {0, 2, 0};
  const std::string index = gltf.add_view(&element, 1), value = gltf.add_view(place, sizeof place);
  const auto accessor = [&](const std::string& base, const std::string& count) {
    return "{" + base + "'componentType':5126,'type':'VEC3','count':3,'sparse':{'count':" + count +
           ",'indices':{'bufferView':" + index + ",'componentType':5121},'values':{'bufferView':" + value +
           "}}}";
  };
  const std::string base = gltf.add_view(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 7, 0}.data(), 36);
  GltfFile zeros = gltf, beyond = gltf;
  const auto height = [&](GltfFile file, const std::string& json) {
    const std::string positions = file.add_accessor(json);
    return import(triangle(file, positions)).report.height;
  };
  EXPECT_NEAR(height(gltf, accessor("'bufferView':" + base + ",", "1")), 2, 1e-6f);
  EXPECT_NEAR(height(zeros, accessor("", "1")), 2, 1e-6f);
  const std::string bad = beyond.add_accessor(accessor("", "2"));
  expect_error(triangle(beyond, bad), "reaches beyond the 1 byte of bufferViews[" + index + "]");
}

/// What stands there, and what in its place.
TEST_F(ImportGltf, FilesThatAreNotWhatTheySay) {
  GltfFile gltf;
  const std::string positions = gltf.add(corners, "VEC3"), text = triangle(gltf, positions);
  test::expect_table(__FILE__, "gltf_refusals.txt", [&](const auto& fields) {
    return complaint("file.gltf", with(text, fields[0], fields[1]));
  });
}

TEST_F(ImportGltf, StripsAndFansAreTriangles) {
  for (const int mode : {5, 6}) {
    SkinnedStrip strip;
    strip.mode = mode;
    strip.indices =
        mode == 5 ? std::vector<std::uint16_t>{0, 1, 2, 3} : std::vector<std::uint16_t>{0, 1, 3, 2};
    const Character c = import(strip.text()).character;
    ASSERT_EQ(c.triangles.size(), 2u);
    detail::Skinner skinner(c);
    const auto pose = skinner.pose({});
    for (const auto& [x, y, z] : c.triangles) {  // both turn the same way
      const Eigen::Vector3f corner = detail::to_eigen(pose[x]);
      EXPECT_LT((detail::to_eigen(pose[y]) - corner).cross(detail::to_eigen(pose[z]) - corner).y(), -0.4f)
          << mode;
    }
  }
}

TEST_F(ImportGltf, FacesThatNameNoVertexAreCounted) {
  SkinnedStrip strip;
  strip.indices = {0, 1, 3, 0, 3, 77, 1};
  const auto [character, report] = import(strip.text());
  EXPECT_EQ(report.triangles, 1u);
  EXPECT_EQ(report.dropped_faces, 2u);
  EXPECT_TRUE(has_note(report, "2 faces were dropped: points, lines, or vertices that are not there"));
}

TEST_F(ImportGltf, TheDefaultSceneIsRead) {
  GltfFile gltf;
  const std::string positions = gltf.add(corners, "VEC3");
  gltf.add_json("'meshes':[{'primitives':[{'attributes':{'POSITION':" + positions + "}}]}]");
  gltf.add_json(
      "'nodes':[{'mesh':0},{'mesh':0,'scale':[1,2,1]}],'scene':1,'scenes':[{'nodes':[0]},{"
      "'nodes':[1]}]");
  const ImportReport report = import(gltf.text()).report;
  EXPECT_NEAR(report.height, 4, 1e-6f);
  EXPECT_TRUE(has_note(report, "of 2 scenes the default one is read"));
  expect_error(with(gltf.text(), "'scene':1", "'scene':2"), "scene is 2 of 2 elements of scenes");
}

TEST_F(ImportGltf, NodesMayNestDeeperThanAStack) {
  constexpr int depth = 100'000;
  GltfFile gltf;
  const std::string positions = gltf.add(corners, "VEC3");
  std::string nodes;
  for (int n = 1; n <= depth; ++n) nodes += "'children':[" + std::to_string(n) + "]},{";
  EXPECT_EQ(import(triangle(gltf, positions, "", "", nodes)).report.triangles, 1u);
}

// ---- What moves a mesh in a glTF file: weights and joints, and keys between which is interpolated

/// A strip whose skin is told by accessors of the test: JOINTS_0, WEIGHTS_0 and more.
template <class AddAttributes>
std::string strip_with(AddAttributes add_attributes, bool inverse_binds = true) {
  const SkinnedStrip strip;
  GltfFile gltf;
  const std::string attributes =
      "'POSITION':" + gltf.add(strip.positions, "VEC3") + "," + add_attributes(gltf);
  gltf.add_json("'meshes':[{'name':'strip','primitives':[{'attributes':{" + attributes +
                "},'indices':" + gltf.add(strip.indices, "SCALAR") + "}]}]");
  gltf.add_json(
      "'skins':[{" +
      (inverse_binds ? "'inverseBindMatrices':" + gltf.add(strip.inverse_binds, "MAT4") + "," : "") +
      "'joints':[1,2]}]");
  gltf.add_json(
      "'nodes':[{'mesh':0,'skin':0},{'name':'hips','children':[2],'translation':[0,1,0]},"
      "{'name':'head','translation':[0,0.5,0]}],'scenes':[{'nodes':[0,1]}]");
  return gltf.text();
}

const std::vector<std::uint8_t> both_joints = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};

template <class Number>
std::vector<Number> fifths(Number one) {
  std::vector<Number> weights;
  for (int vertex = 0; vertex < 4; ++vertex)
    for (const Number fraction : {Number{1}, Number{4}, Number{0}, Number{0}})
      weights.push_back(static_cast<Number>(one / Number{5} * fraction));
  return weights;
}

void expect_fifths(const Character& character) {
  ASSERT_EQ(character.vertices.size(), 4u);
  for (std::size_t v = 0; v < 4; ++v) {
    ASSERT_EQ(character.influence_begin[v + 1] - character.influence_begin[v], 2u);
    const Influence* const list = &character.influences[character.influence_begin[v]];
    EXPECT_NEAR(list[0].weight, 0.2f, 1e-6f);
    EXPECT_NEAR(list[1].weight, 0.8f, 1e-6f);
  }
}

template <class Weights>
std::string strip_of_weights(const Weights& weights, bool normalised) {
  return strip_with([&](GltfFile& gltf) {
    return "'JOINTS_0':" + gltf.add(both_joints, "VEC4") +
           ",'WEIGHTS_0':" + gltf.add(weights, "VEC4", normalised);
  });
}

TEST_F(ImportGltf, WeightsMayBeNormalisedIntegers) {
  const std::string texts[] = {strip_of_weights(fifths(1.0f), false),
                               strip_of_weights(fifths<std::uint8_t>(255), true),
                               strip_of_weights(fifths<std::uint16_t>(65535), true)};
  for (const std::string& text : texts) {
    const Character first = import(text).character;
    expect_fifths(first);
    for (int run = 0; run < 40; ++run) {
      const Character again = import(text).character;
      ASSERT_EQ(again.vertices, first.vertices);
      for (std::size_t i = 0; i < first.influences.size(); ++i)
        ASSERT_EQ(again.influences[i].weight, first.influences[i].weight);
    }
  }
  expect_error(strip_of_weights(fifths<std::uint8_t>(255), false), "gives vertex 0 the weight 51");
}

/// Seven entries a vertex: 0.1 + 0.05 + 0.05 for the hips, the rest for the head.
TEST_F(ImportGltf, SetsOfJointsMayBeOfDifferentTypes) {
  std::vector<float> some, more;
  std::vector<std::uint16_t> second;
  for (int vertex = 0; vertex < 4; ++vertex) {
    some.insert(some.end(), {0.1f, 0.3f, 0.05f, 0.05f});
    more.insert(more.end(), {0.2f, 0.2f, 0.1f, 0});
    second.insert(second.end(), {1, 1, 1, 0});
  }
  const auto [character, report] = import(strip_with([&](GltfFile& gltf) {
    return "'JOINTS_0':" + gltf.add(both_joints, "VEC4") + ",'WEIGHTS_0':" + gltf.add(some, "VEC4") +
           ",'JOINTS_1':" + gltf.add(second, "VEC4") + ",'WEIGHTS_1':" + gltf.add(more, "VEC4");
  }));
  EXPECT_FALSE(has_note(report, "normalised"));
  expect_fifths(character);
}

TEST_F(ImportGltf, WithoutInverseBindMatricesTheyAreIdentity) {
  const Character c =
      import(strip_with(
                 [](GltfFile& gltf) {
                   const std::vector<float> weights = {1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
                   return "'JOINTS_0':" + gltf.add(both_joints, "VEC4") +
                          ",'WEIGHTS_0':" + gltf.add(weights, "VEC4");
                 },
                 false))
          .character;
  for (const Bone& bone : c.bones) EXPECT_EQ(bone.inverse_bind, Affine3());
  detail::Skinner skinner(c);
  const auto pose = skinner.pose({});
  // The hips stand 1 m up and the head 1.5 m: feet at 0 come to 1, hands at 1.8 to 3.3.
  EXPECT_NEAR(pose[c.triangles[0][1]].z, 1.0f, 1e-6f);
  EXPECT_NEAR(pose[c.triangles[0][2]].z, 3.3f, 1e-6f);
}

TEST_F(ImportGltf, NodesOfOneNameAreTheirOwn) {
  SkinnedStrip strip;
  const auto [good, good_report] = import(strip.text());
  strip.head = strip.hips = "body";  // as the node of the mesh
  const auto [character, report] = import(strip.text());
  EXPECT_EQ(report.bones, good_report.bones);
  EXPECT_EQ(test::farthest_in_clips(character, 0, good, 0), 0);
}

TEST_F(ImportGltf, AJointOfTwoSkinsCountsOnce) {
  SkinnedStrip strip;
  GltfFile gltf = strip.file();
  strip.inverse_binds[13] = -1.1f;  // another skin's
  const std::string text =
      with(with(with(gltf.text(), "'skins':[", "'skins':[{'joints':[1,2]},"), "'skin':0", "'skin':1"),
           "{'name':'camera',", "{'mesh':0,'skin':0,'name':'camera',");
  const auto [character, report] = import(text);
  EXPECT_EQ(character.bones.size(), 4u);
  EXPECT_EQ(report.bones, 2u);
  EXPECT_EQ(report.meshes, 2u);
}

// ---- Interpolation

/// The height of the strip's feet (which the hips carry) over their rest, and the head's turn about the vertical.
struct Posed {
  float height, turn;
};

Posed posed(const Character& character, float seconds) {
  detail::Skinner skinner(character);
  const auto pose = skinner.pose({0, seconds});
  const Vec3 left = pose[character.triangles[0][2]], right = pose[character.triangles[1][2]];
  return {pose[character.triangles[0][0]].z, std::atan2(left.y - right.y, left.x - right.x)};
}

constexpr float right_angle = 1.57079633f;

/// Keys at 0 s and 2 s; the hips leave with 3 m/s upwards and arrive with -1 m/s.
SkinnedStrip cubic_strip() {
  SkinnedStrip strip;
  strip.interpolation = "'interpolation':'CUBICSPLINE',";
  strip.times = {0, 2};
  strip.way = {9, 9, 9, 0, 1, 0, 0, 3, 0, 0, -1, 0, 0, 5, 0, 9, 9, 9};
  const float half = 0.70710678f;  // a right angle about y
  strip.turns = {9, 9, 9, 9, 0, 0, 0, 1, 0, 0.5f, 0, 0, 0, 0, 0, 0, 0, half, 0, half, 9, 9, 9, 9};
  return strip;
}

TEST_F(ImportGltf, KeysAreBlendedAsTheirKindSays) {
  SkinnedStrip linear;
  linear.way = {0, 1, 0, 0, 2, 0, 0, 5, 0};
  SkinnedStrip steps = linear;
  steps.interpolation = "'interpolation':'STEP',";
  const Character of_lines = import(linear.text()).character, of_steps = import(steps.text()).character,
                  of_curves = import(cubic_strip().text()).character;
  const struct {
    const Character& character;
    float seconds, height, turn;
  } expected[] = {
      {of_lines, 0.25f, 0.25f, 0.125f * right_angle},
      {of_lines, 0.5f, 0.5f, 0.25f * right_angle},
      {of_lines, 1.5f, 2.5f, 0.75f * right_angle},
      {of_steps, 0, 0, 0},
      {of_steps, 0.999f, 0, 0},
      {of_steps, 1, 1, 0.5f * right_angle},
      {of_steps, 1.999f, 1, 0.5f * right_angle},
      {of_steps, 2, 4, right_angle},
      {of_curves, 0, 0, 0},
      // At t = 1/4: 27/32 1 + 9/64 2 3 + 5/32 5 - 3/64 2 (-1) = 2.5625, less the 1 of the rest pose.
      // y = 9/64 2 0.5 + 5/32 0.70710678 = 0.25111043, w = 27/32 1 + 5/32 0.70710678 = 0.95423543.
      {of_curves, 0.5f, 1.5625f, 2 * std::atan2(0.25111043f, 0.95423543f)},
      // At the middle, t = 1/2: 1/2 1 + 1/8 2 3 + 1/2 5 - 1/8 2 (-1) = 4.
      // y = 1/8 2 0.5 + 1/2 0.70710678 = 0.47855339, w = 1/2 1 + 1/2 0.70710678 = 0.85355339.
      {of_curves, 1, 3, 2 * std::atan2(0.47855339f, 0.85355339f)},
      {of_curves, 2, 4, right_angle}};
  for (const auto& [character, seconds, height, turn] : expected) {
    EXPECT_NEAR(posed(character, seconds).height, height, 1e-6f) << seconds << " s, turn " << turn;
    EXPECT_NEAR(posed(character, seconds).turn, turn, 1e-6f) << seconds << " s, height " << height;
  }
}

TEST_F(ImportGltf, CubicKeysThatLeadThroughNoRotationHold) {
  SkinnedStrip strip = cubic_strip();
  for (std::size_t i = 0; i < 4; ++i) strip.turns[8 + i] = strip.turns[12 + i] = 0;  // no tangents
  for (std::size_t i = 0; i < 4; ++i) strip.turns[16 + i] = -strip.turns[4 + i];
  EXPECT_NEAR(posed(import(strip.text()).character, 1).turn, 0, 1e-6f);
}

TEST_F(ImportGltf, UnorderedCubicKeysKeepTheirTangents) {
  SkinnedStrip strip = cubic_strip();
  strip.times = {2, 0};
  std::rotate(strip.way.begin(), strip.way.begin() + 9, strip.way.end());
  std::rotate(strip.turns.begin(), strip.turns.begin() + 12, strip.turns.end());
  const auto [character, report] = import(strip.text());
  EXPECT_TRUE(has_note(report, "2 lists of keys put in order"));
  EXPECT_NEAR(posed(character, 0.5f).height, 1.5625f, 1e-6f);
}

TEST_F(ImportGltf, CubicKeysOfAnotherFileTurnAndGrowWithItsSkeleton) {
  const SkinnedStrip own = cubic_strip();
  SkinnedStrip other = own;  // half as large, turned and scaled back by the node above
  other.armature = "'scale':[2,2,2],'rotation':[0,0.70710678,0,0.70710678],";
  other.head_place = "'translation':[0,0.25,0]";
  for (float& part : other.way) part /= 2;
  ImportOptions options;
  options.clip_files = {folder.write("other.gltf", other.text())};
  const Character c = import_character(folder.write("own.gltf", own.text()), options).character;
  ASSERT_EQ(c.clips.size(), 2u);
  detail::Skinner first(c), second(c);
  for (const float time : {0.3f, 0.5f, 1.0f, 1.7f}) {
    const auto wanted = first.pose({0, time});
    const auto pose = second.pose({1, time});
    for (std::size_t v = 0; v < pose.size(); ++v)
      EXPECT_NEAR(pose[v].z, wanted[v].z, 1e-5f) << time;  // the turn is the other skeleton's own
  }
}

TEST_F(ImportGltf, KeysThatAreNotWhatTheySay) {
  SkinnedStrip strip = cubic_strip();
  strip.way.resize(9);
  expect_error(strip.text(), "has 3 values for 2 keys, not three times as many");
  strip = cubic_strip();
  strip.way[7] = std::nanf("");
  expect_error(strip.text(), "tangent of position key 0 is not finite");
  strip = cubic_strip();
  strip.way[7] = 1e10f;
  expect_error(strip.text(), "'hips' absurdly far away");
  strip = {};
  strip.interpolation = "'interpolation':'BEZIER',";
  expect_error(strip.text(), "is 'BEZIER', none of LINEAR, STEP and CUBICSPLINE");
}

TEST_F(ImportGltf, RotationsMayBeNormalisedShorts) {
  SkinnedStrip strip;
  const Character floats = import(strip.text()).character;
  GltfFile gltf = strip.file();
  std::vector<std::int16_t> turns;
  for (const float part : strip.turns)
    turns.push_back(static_cast<std::int16_t>(std::lround(part * 32767.0f)));
  const std::string accessor = gltf.add(turns, "VEC4", true);
  std::string text = gltf.text();
  const std::size_t output =
      text.rfind(test::quoted("'output':")) + 9;  // of the second sampler, which turns the head
  text.replace(output, text.find('}', output) - output, accessor);
  const Character shorts = import(text).character;
  for (const float time : {0.0f, 0.5f, 1.3f, 2.0f})
    EXPECT_NEAR(posed(shorts, time).turn, posed(floats, time).turn, 1e-4f);
}

}  // namespace
}  // namespace bch
