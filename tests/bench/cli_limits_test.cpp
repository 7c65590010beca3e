// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <nlohmann/json.hpp>

#include "tests/support/bch_run.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/island_soups.hpp"
#include "tests/support/test.hpp"

// What a character file may cost once it is read. The large meshes would take minutes to hours if what is done with them
// were not linear or nearly so, beyond this test's time limit.

namespace bch::test {
namespace {

const Arguments seen_from_above{"--up", "z", "--scale", "1"};

template <class Value>
void append_bytes(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// The triangles as a binary STL file, where each has vertices of its own.
std::string stl_file(const Soup& soup) {
  std::string bytes(80, '\0');
  append_bytes(bytes, static_cast<std::uint32_t>(soup.triangles.size()));
  for (const auto& triangle : soup.triangles) {
    append_bytes(bytes, Vec3());  // no normal
    for (const std::uint32_t vertex : triangle) append_bytes(bytes, soup.positions[vertex]);
    append_bytes(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string soup_file(const TemporaryFolder& folder, std::uint32_t triangles) {
  return folder.write("soup.stl", stl_file(separate_triangles(triangles)));
}

std::size_t files_in(const TemporaryFolder& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++count;
  return count;
}

TEST(CliLimits, AMeshOfManyIslandsIsInspected) {
  const TemporaryFolder folder;
  const Ending run = bch({"inspect", soup_file(folder, 360'000)}, seen_from_above);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("rest pose"), std::string::npos) << run.out;
}

TEST(CliLimits, AShapeOfManyNodesIsWritten) {
  const TemporaryFolder folder;
  const std::string json = folder.file("soup.json"), svg = folder.file("soup.svg");
  const Ending run = bch({"inspect", soup_file(folder, 100'000), "--shape", "0", "--threshold", "1e-3",
                          "--json", json, "--svg", svg, "--max-drawn-nodes", "1000000"},
                         seen_from_above);
  ASSERT_EQ(run.code, 0) << run.err;
  const auto shape = read_json(json)["shape"];
  EXPECT_EQ(shape["outline"]["contours"].size(), 100'000u);
  EXPECT_GT(shape["nodes"], 300'000);
  EXPECT_GT(std::filesystem::file_size(svg), 1'000'000u);
}

TEST(CliLimits, WhatIsBeyondALimitIsRefusedByALineThatNamesTheOption) {
  const TemporaryFolder folder;
  const std::string soup = soup_file(folder, 200), svg = folder.file("soup.svg");
  const auto inspect = [&](const Arguments& more) {
    Arguments arguments{"inspect", soup, "--shape", "0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return bch(arguments, seen_from_above);
  };
  EXPECT_EQ(inspect({"--max-contours", "200", "--max-triangles", "200"}).code, 0);
  expect_failure(inspect({"--max-contours", "199"}), 3,
                 {"soup.stl: ", "200 contours", "more than 199", "--max-contours raises the limit"});
  expect_failure(inspect({"--max-triangles", "199"}), 3,
                 {"soup.stl: ", "more than 199 triangles", "--max-triangles raises the limit"});
  expect_failure(inspect({"--max-nodes", "10"}), 3,
                 {"soup.stl: ", "more than 10 nodes", "--max-nodes raises the limit"});
  expect_failure(inspect({"--svg", svg, "--max-drawn-nodes", "10"}), 3,
                 {"soup.stl: ", "--svg", "more than 10", "--max-drawn-nodes raises the limit"});
  EXPECT_FALSE(std::filesystem::exists(svg));
}

TEST(CliLimits, EveryCommandThatReadsCharactersKeepsThem) {
  const TemporaryFolder folder;
  const std::string soup = soup_file(folder, 200), agents = folder.write("agents.csv", four_agents),
                    pairs = folder.write("pairs.csv", "first,second\na,b\n");
  for (const Arguments& command :
       {Arguments{"inspect", soup}, Arguments{"bake", soup, "-o", folder.file("a.bch")},
        Arguments{"crowd", "--agents", "9", "--character", soup}, Arguments{"query", soup, agents, pairs}})
    for (const auto& [option, value] :
         {std::pair{"--max-contours", "100"}, {"--max-triangles", "100"}, {"--max-nodes", "10"}}) {
      SCOPED_TRACE(command.front() + " " + option);
      Arguments arguments = command;
      arguments.insert(arguments.end(), {option, value});
      expect_failure(bch(arguments, seen_from_above), 3, {"soup.stl: ", option});
    }
  EXPECT_EQ(files_in(folder), 3u);
}

TEST(CliLimits, TimeAndMemoryAreLimitedAndNoFileIsLeft) {
  const TemporaryFolder folder;
  const std::string soup = soup_file(folder, 200'000);
  const auto bake = [&](const Arguments& more) {
    Arguments arguments{"bake", soup, "--depths", "all", "--threshold", "1e-3", "-o", folder.file("a.bch")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return bch(arguments, seen_from_above);
  };
  expect_failure(bake({"--max-seconds", "0.01"}), 3,
                 {"soup.stl: ", "more than 0.01 s", "--max-seconds raises the limit"});
#ifndef BCH_SANITIZED  // whose memory is not counted
  expect_failure(bake({"--max-memory", "0.01"}), 3,
                 {"soup.stl: ", "more than 0.01 GiB", "--max-memory raises the limit"});
#endif
  EXPECT_EQ(files_in(folder), 1u);
}

/// A triangle, and as many nodes that show it as there are names of it.
std::string triangle_in_nodes(const std::string& nodes) {
  GltfFile file;
  const std::string positions = file.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1.8f, 1}, "VEC3");
  file.add_json(R"("meshes":[{"primitives":[{"attributes":{"POSITION":)" + positions + "}}]}]");
  file.add_json(R"("nodes":[)" + nodes + R"(],"scenes":[{"nodes":[0]}],"scene":0)");
  return file.text();
}

TEST(CliLimits, InstancesOfAMeshCount) {
  std::string children, nodes;
  for (int i = 1; i <= 12'000; ++i) {
    if (i > 1) children += ',';
    children += std::to_string(i);
    nodes += R"(,{"mesh":0})";
  }
  const TemporaryFolder folder;
  const std::string instances =
      folder.write("instances.gltf", triangle_in_nodes(R"({"children":[)" + children + "]}" + nodes));
  expect_failure(bch({"inspect", instances, "--max-triangles", "11999"}), 3,
                 {"instances.gltf: ", "more than 11999 triangles", "each instance", "--max-triangles"});
  const Ending run = bch({"inspect", instances, "--max-triangles", "12000"});
  EXPECT_EQ(run.code, 0) << run.err;
}

/// A file of 1 kB that stands for 12^4 nodes: glTF's nodes are trees, which have no child twice.
TEST(CliLimits, NodesThatShareTheirChildrenAreRefused) {
  std::string nodes;
  for (int level = 1; level <= 4; ++level) {
    nodes += R"({"children":[)";
    for (int i = 0; i < 12; ++i) nodes += std::to_string(level) + (i < 11 ? "," : "");
    nodes += "]},";
  }
  const TemporaryFolder folder;
  const std::string shared = folder.write("shared.gltf", triangle_in_nodes(nodes + R"({"mesh":0})"));
  EXPECT_LT(std::filesystem::file_size(shared), 2000u);
  expect_failure(bch({"inspect", shared}), 3,
                 {"shared.gltf: ", "a node that has a place in the scene already"});
}

}  // namespace
}  // namespace bch::test
