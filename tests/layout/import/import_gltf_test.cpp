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

TEST_F(ImportGltf, RequiredExtensionsAreReadOrRefusedByName) {
  const auto text = [](const std::string& extension) {
    GltfFile gltf;
    gltf.add_json("'extensionsRequired':['" + extension + "']");
    const std::string positions = gltf.add(corners, "VEC3");
    return triangle(std::move(gltf), positions);
  };
  for (const char* name :
       {"EXT_meshopt_compression", "EXT_mesh_gpu_instancing", "KHR_node_visibility", "EXT_foo"})
    expect_error(text(name), std::string("requires the glTF extension '") + name + "'");
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
TEST_F(ImportGltf, AccessorsThatAreNotWhatTheySay) {
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

TEST_F(ImportGltf, NodesAreATree) {
  GltfFile gltf;
  const std::string positions = gltf.add(corners, "VEC3");
  const auto text = [&](const std::string& first, const std::string& second) {
    return triangle(gltf, positions, "", "", "'children':[" + first + "]},{'children':[" + second + "]},{");
  };
  expect_error(text("1", "0"), "nodes[1].children[0] is 0, a node that has a place in the scene already");
  expect_error(text("1,2", "2"), "is 2, a node that has a place in the scene already");
  expect_error(text("9", ""), "nodes[0].children[0] is 9 of 3 elements of nodes");
}

TEST_F(ImportGltf, NodesMayNestDeeperThanAStack) {
  constexpr int depth = 100'000;
  GltfFile gltf;
  const std::string positions = gltf.add(corners, "VEC3");
  std::string nodes;
  for (int n = 1; n <= depth; ++n) nodes += "'children':[" + std::to_string(n) + "]},{";
  EXPECT_EQ(import(triangle(gltf, positions, "", "", nodes)).report.triangles, 1u);
}

}  // namespace
}  // namespace bch
