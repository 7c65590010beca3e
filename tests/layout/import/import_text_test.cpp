// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/bvh_file.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/import_test.hpp"
#include "tests/support/table.hpp"
#include "tests/support/test.hpp"

// What OBJ, PLY and BVH allow and assimp 5.2 loses or refuses.

namespace bch {
namespace {

class ImportText : public test::ImportTest {
 protected:
  ImportedCharacter read(const std::string& name, const std::string& text) const {
    return import_character(folder.write(name, text), test::as_it_is());
  }
};

/// Of OBJ, PLY and BVH.
TEST_F(ImportText, ThatIsNoneIsRefused) {
  test::expect_table(__FILE__, "text_refusals.txt",
                     [&](const auto& fields) { return complaint(fields[0], fields[1]); });
}

// ---- OBJ

TEST_F(ImportText, ObjMayBeWrittenInManyWays) {
  const Character expected =
      read("plain.obj", "v 0 0 0\nv 0.5 0 0\nv 0.5 -0.05 0\nv 0 0.5 1\nf 1 2 3 4\nf 1 2 4\n").character;
  const std::string vertices = "v 0 0 0\nv .5 0 0\nv .5 -.05 0\nv 0 0.5 1\n";
  for (const std::string& text :
       {vertices + "f 1 2 3 4\nf 1 2 4\n", vertices + "f 1 2 3 4 # a quad\nf 1 2 4#1 2 3\n",
        vertices + "f -4 -3 -2 -1\nf 01 +2 4\n", vertices + "f 1 2 \\\n 3 4\nf 1 \\\r\n2 4\n",
        vertices + "vt .5 .5\nvt 1\nvn 0 0 1\nf 1/1 2/2 3/1 4/1\nf 1//1 2//1 4//1\n",
        std::string("# C:\\models\\\nmtllib C:\\models\\a.mtl\nv 0 0 0 # 1 2 3\nv 5.e-1 0 0\nv +.5e0 -.5E-1 "
                    "0 .1 .2 .3\n"
                    "  v 0 .5 1. .1 .2 .3 1\n\tf 1 2 3 4\nfo 1 2 4\n"),
        std::string("v 0 0 0\rv .5 0 0 1\rv 1 -.1 0 2\rv 0 .5 1\rf 1 2 3 4\rf 1 2 4")}) {
    const auto [character, report] = read("other.obj", text);
    EXPECT_EQ(character.vertices, expected.vertices) << text;
    EXPECT_EQ(character.triangles, expected.triangles) << text;
    EXPECT_EQ(report.dropped_faces, 0u) << text;
  }
}

// ---- PLY

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string faces = "property list uchar int vertex_indices\n";
const std::string five = "element vertex 5\n" + xyz;
const std::string five_lines = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n";

template <class Number>
void append(std::string& bytes, Number number, bool big_endian) {
  auto part = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if (big_endian) std::ranges::reverse(part);
  bytes.append(part.data(), part.size());
}

/// The first coordinate begins with a line feed.
std::string binary_ply(bool big_endian, const std::string& line_end) {
  std::string text = "ply\nformat binary_" + std::string(big_endian ? "big" : "little") + "_endian 1.0\n" +
                     five + "element face 2\n" + faces + "end_header\n";
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += line_end.size())
    text.replace(at, 1, line_end);
  const float first = std::bit_cast<float>(big_endian ? 0x0a23d73cu : 0x3c23d70au);
  for (const float coordinate : {first, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f})
    append(text, coordinate, big_endian);
  for (const std::vector<std::int32_t>& face : {std::vector{0, 1, 2, 3}, std::vector{0, 1, 4}}) {
    append(text, static_cast<std::uint8_t>(face.size()), big_endian);
    for (const std::int32_t corner : face) append(text, corner, big_endian);
  }
  return text;
}

TEST_F(ImportText, BinaryPlyMayBeginWithALineFeed) {
  for (const bool big_endian : {false, true})
    for (const std::string line_end : {"\n", "\r\n", "\r"}) {
      const Character character = read("a.ply", binary_ply(big_endian, line_end)).character;
      ASSERT_EQ(character.triangles.size(), 3u) << big_endian;
      ASSERT_EQ(character.vertices.size(), 5u);
      EXPECT_EQ(character.vertices[0].x, std::bit_cast<float>(big_endian ? 0x0a23d73cu : 0x3c23d70au));
      EXPECT_EQ(character.vertices[2], (Vec3{1, 1, 0}));
    }
}

TEST_F(ImportText, PlyMayBeWrittenInManyWays) {
  const Character expected = read("plain.ply", "ply\nformat ascii 1.0\n" + five + "element face 2\n" + faces +
                                                   "end_header\n" + five_lines + "4 0 1 2 3\n3 0 1 4\n")
                                 .character;
  ASSERT_EQ(expected.triangles.size(), 3u);
  for (const std::string& text :
       {"ply\ncomment a\nobj_info b\nformat ascii 1.0\nelement vertex 5\ncomment Points\n" + xyz +
            "comment\nelement face 2\ncomment Faces\n" + faces + "comment end\nend_header\n" + five_lines +
            "4 0 1 2 3\n3 0 1 4\n",
        // Faces first, other elements and properties between, and colours that the header does not name.
        "ply\nformat ascii 1.0\nelement face 2\nproperty uchar red\n" + faces +
            "property list uchar float texcoord\nelement edge 1\nproperty int vertex1\nelement vertex 5\n"
            "property double z\nproperty list int int other\nproperty float64 y\nproperty float32 "
            "x\nend_header\n"
            "7 4 0 1 2 3 2 .5 .5\n7 3 0 1 4 0\n3\n0 0 0 0\n0 1 9 0 1\n0 2 9 9 1 1 255 255\n0 0 1e0 .0\n\n1. "
            "0 0 0\n"}) {
    const Character character = read("other.ply", text).character;
    EXPECT_EQ(character.vertices, expected.vertices) << text;
    EXPECT_EQ(character.triangles, expected.triangles) << text;
  }
}

TEST_F(ImportText, PlyStripsAreRead) {
  const std::string header =
      "ply\nformat ascii 1.0\n" + five + "element tristrips 1\nproperty list int int vertex_";
  for (const std::string name : {"indices", "index"}) {
    const auto [character, report] =
        read("strip.ply", header + name + "\nend_header\n" + five_lines + "9 0 1 3 2 4 -1 0 1 4\n");
    EXPECT_EQ(character.triangles,
              (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {0, 1, 4}}));
    EXPECT_EQ(character.vertices[2], (Vec3{0, 1, 0}));
    EXPECT_EQ(report.dropped_faces, 0u);
  }
}

// ---- BVH

const std::string frame = "100 100 0 0 0 0 0 0 45\n";

class ImportBvh : public test::ImportTest {
 protected:
  ImportOptions options;
  const std::filesystem::path strip = folder.write("strip.gltf", SkinnedStrip().text());

  void write(const std::string& frames, const std::string& motion, const std::string& channels = "") {
    test::BvhFile file{.frames = frames, .motion = motion + "\n"};
    if (!channels.empty()) file.channels = channels;
    options.clip_files = {folder.write("walk.bvh", file.text())};
  }
  std::string notes(const std::string& frames, const std::string& motion) {
    write(frames, motion);
    std::string all;
    for (const std::string& note : import_character(strip, options).report.notes)
      if (note.find("Frames") != std::string::npos) all += note;
    return all;
  }
};

TEST_F(ImportBvh, FramesThatAreLeftOverAreNoted) {
  EXPECT_EQ(notes("2", frame + frame), "");
  EXPECT_EQ(import_character(strip, options).report.clips.at(1).seconds, 1);
  EXPECT_EQ(notes("1", frame + frame),
            "walk.bvh: behind 'Frames: 1' stands motion of 2 frames: what is beyond is not read");
  EXPECT_EQ(
      notes("2", frame + frame + "1 2 3"),
      "walk.bvh: behind 'Frames: 2' stands motion of 2 frames and 3 numbers: what is beyond is not read");
}

TEST_F(ImportBvh, FramesThatAreMissingAndPositionsThatWouldBeLostAreErrorsOfTheClipFile) {
  test::expect_table(__FILE__, "bvh_refusals.txt", [&](const auto& fields) {
    write(fields[0], fields[1], fields[2]);
    return complaint(strip, options);
  });
}

}  // namespace
}  // namespace bch
