// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/bvh_file.hpp"
#include "tests/support/collada_file.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/import_test.hpp"
#include "tests/support/table.hpp"
#include "tests/support/test.hpp"

// What OBJ, PLY and BVH allow and assimp 5.2 loses or refuses.

namespace bch {
namespace {

using test::collada_geometry;
using test::collada_param;
using test::collada_source;
using test::filled;

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

// ---- What Collada says of keys and joints, and assimp does not hear.

/// The curve of one property: times, values and kinds of keys, and tangents where there are any.
struct Curve {
  std::string target, times, values, kinds, in = "", out = "";
  int keys = 3, stride = 1;

  std::string text(const std::string& id) const {
    const std::string params = stride == 16  ? collada_param("TRANSFORM", "float4x4")
                               : stride == 3 ? test::xyz_params
                                             : collada_param("ANGLE"),
                      plane = collada_param("X") + collada_param("Y");
    std::string sources =
        collada_source("$i", "float", times, keys, 1, collada_param("TIME")) +
        collada_source("$o", "float", values, keys, stride, params) +
        collada_source("$k", "Name", kinds, keys, 1, collada_param("INTERPOLATION", "name"));
    std::string inputs =
        "<input semantic='INPUT' source='#$i'/><input semantic='OUTPUT' source='#$o'/>"
        "<input semantic='INTERPOLATION' source='#$k'/>";
    if (!in.empty()) {
      sources += collada_source("$x", "float", in, keys, 2 * stride, plane) +
                 collada_source("$y", "float", out, keys, 2 * stride, plane);
      inputs += "<input semantic='IN_TANGENT' source='#$x'/><input semantic='OUT_TANGENT' source='#$y'/>";
    }
    return filled("<animation id='$'>" + sources + "<sampler id='$s'>" + inputs +
                      "</sampler><channel source='#$s' target='" + target + "'/></animation>",
                  {{"$", id}});
  }
};

std::string collada(const std::string& libraries, const std::string& nodes,
                    const std::vector<Curve>& curves) {
  std::string animations;
  for (std::size_t c = 0; c < curves.size(); ++c) animations += curves[c].text("c" + std::to_string(c));
  if (!curves.empty()) animations = "<library_animations>" + animations + "</library_animations>";
  return test::collada_file(libraries + animations, nodes);
}

std::string turning(const std::vector<Curve>& curves) {
  return collada("<library_geometries>" + collada_geometry("g") + "</library_geometries>",
                 "<node id='n'><translate sid='t'>0 0 0</translate><rotate sid='z'>0 0 1 0</rotate>"
                 "<instance_geometry url='#g'/></node>",
                 curves);
}

class ImportCollada : public test::ImportTest {
 protected:
  ImportedCharacter read(const std::string& text) const { return import("a.dae", text); }

  /// Compares the node's turn about the vertical with a function of time.
  void expect_degrees(const std::vector<Curve>& curves, const std::function<double(double)>& degrees) {
    const ImportedCharacter imported = read(turning(curves));
    ASSERT_EQ(imported.character.clips.size(), 1u);
    detail::Skinner skinner(imported.character);
    for (const double time : {0.0, 0.2, 0.5, 0.9, 0.999, 1.0, 1.3, 1.9, 2.0}) {
      const double radians = degrees(time) * std::numbers::pi / 180;
      const Eigen::Vector2d x(std::cos(radians), std::sin(radians)), y(-std::sin(radians), std::cos(radians));
      double largest = -1e9, least = 1e9;  // the corner at (1, 0, 0) is the farthest along its own direction
      const auto pose = skinner.pose({0, static_cast<float>(time)});
      for (const Vec3& a : pose)
        for (const Vec3& b : pose) {
          const double along =
              Eigen::Vector2d(double{a.x} - double{b.x}, double{a.y} - double{b.y}).dot((x - y).normalized());
          largest = std::max(largest, along), least = std::min(least, along);
        }
      EXPECT_NEAR(largest, std::sqrt(2.0), 2e-3) << "at " << time;
      EXPECT_NEAR(least, -std::sqrt(2.0), 2e-3) << "at " << time;
    }
  }

  void expect_refused(const std::string& text, const std::string& reason) const {
    EXPECT_TRUE(test::has(complaint("a.dae", text), reason));
  }
};

TEST_F(ImportCollada, StepKeysHoldTheirValue) {
  const auto steps = [](double t) { return t < 1 ? 0.0 : t < 2 ? 60.0 : 90.0; };
  expect_degrees({{"n/z.ANGLE", "0 1 2", "0 60 90", "STEP STEP STEP"}}, steps);
  expect_degrees({{"n/z.ANGLE", "0 1 2", "0 60 90", "STEP LINEAR LINEAR"}},
                 [](double t) { return t < 1 ? 0.0 : 60 + 30 * (t - 1); });
  // Beside a line, on the same node.
  expect_degrees({{"n/z.ANGLE", "0 1 2", "0 60 90", "STEP STEP STEP"},
                  {"n/t.X", "0 1 2", "0 5 6", "LINEAR LINEAR LINEAR"}},
                 steps);
}

TEST_F(ImportCollada, BezierCurvesOfOneNumber) {
  // Tangents a third of the way along, so that time passes evenly: 60 (3 u^2 - 2 u^3), then a line.
  expect_degrees({{"n/z.ANGLE", "0 1 2", "0 60 90", "BEZIER LINEAR LINEAR", "0 0 0.666667 60 1.666667 90",
                   "0.333333 0 1.333333 60 2 90"}},
                 [](double t) { return t < 1 ? 60 * (3 * t * t - 2 * t * t * t) : 60 + 30 * (t - 1); });
  // Along which time passes unevenly: u^2 (3 - 2 u) of the time where the value is u^3.
  expect_degrees(
      {{"n/z.ANGLE", "0 1 2", "0 60 60", "BEZIER LINEAR LINEAR", "0 0 1 0 2 60", "0 0 1.3 60 2 60"}},
      [](double t) {
        double low = 0, high = 1;
        for (int i = 0; i < 60; ++i) {
          const double u = (low + high) / 2;
          (u * u * (3 - 2 * u) < t ? low : high) = u;
        }
        return t < 1 ? 60 * low * low * low : 60.0;
      });
}

TEST_F(ImportCollada, WhatIsNotRead) {
  expect_refused(turning({{"n/z.ANGLE", "0 1 2", "0 60 90", "LINEAR HERMITE LINEAR"}}),
                 "Collada animation 'c0s' has keys of kind HERMITE, which is not read");
  expect_refused(turning({{"n/z.ANGLE", "0 1 2", "0 60 90", "BEZIER BEZIER BEZIER"}}),
                 "with 0 numbers for the tangents of 3 keys");
  expect_refused(turning({{"n/t", "0 1 2", "0 0 0 1 2 3 4 5 6", "BEZIER BEZIER BEZIER", "", "", 3, 3}}),
                 "of kind BEZIER of 3 numbers");
  const Curve bulge{"n/z.ANGLE",         "0 1 2",         "30 30 30", "HERMITE HERMITE HERMITE",
                    "0 -90 1 -90 2 -90", "0 90 1 90 2 90"};
  expect_refused(turning({bulge}), "has keys of kind HERMITE, which is not read");
  expect_refused(turning({{"n/z.ANGLE", "0 1 2", "0 60", "STEP STEP STEP"}}), "has 2 numbers for 3 keys");
  expect_refused(turning({{"n/z.ANGLE", "0 1 2", "0 6o 90", "STEP STEP STEP"}}), "has '6o' for a number");
  std::string text = turning({{"n/z.ANGLE", "0 1 2", "0 60 90", "STEP STEP STEP"}});
  const std::string accessor = test::quoted("<accessor source='#c0o-a'");
  text.replace(text.find(accessor), accessor.size(), accessor + test::quoted(" offset='1'"));
  expect_refused(text, "has a source with an offset or with values that have no name");
  // However far into the file Collada begins.
  text = turning({bulge});
  text.insert(text.find("<!--"), "<!-- " + std::string(10'000, ' ') + " -->");
  expect_refused(text, "has keys of kind HERMITE, which is not read");
  // Baked, or without any motion.
  read(turning({{"n/t", "0 0.04 0.08", "0 0 0 1 2 3 4 5 6", "BEZIER BEZIER BEZIER", "", "", 3, 3}}));
  read(turning({{"n/t", "0 1 2", "1 2 3 1 2 3 1 2 3", "BEZIER BEZIER BEZIER", "", "", 3, 3}}));
  read(turning({{"n/z.ANGLE", "0 1 2", "5 5 5", "HERMITE HERMITE HERMITE"}}));
}

std::string skin(const std::string& id, const std::string& geometry_id, const std::string& joint_array,
                 const std::string& joints) {
  const std::string unit = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
  return filled(
      "<controller id='$'><skin source='#" + geometry_id + "'><bind_shape_matrix>" + unit +
          "</bind_shape_matrix>" +
          collada_source("$j", joint_array, joints, 2, 1, collada_param("JOINT", "name")) +
          collada_source("$b", "float", unit + " " + unit, 2, 16, collada_param("TRANSFORM", "float4x4")) +
          collada_source("$w", "float", "1", 1, 1, collada_param("WEIGHT")) +
          "<joints><input semantic='JOINT' source='#$j'/><input semantic='INV_BIND_MATRIX' "
          "source='#$b'/></joints>"
          "<vertex_weights count='4'><input semantic='JOINT' source='#$j' offset='0'/>"
          "<input semantic='WEIGHT' source='#$w' offset='1'/><vcount>1 1 1 1</vcount><v>0 0 1 0 1 0 1 0</v>"
          "</vertex_weights></skin></controller>",
      {{"$", id}});
}

std::string skeleton(const std::string& id, int x) {
  return filled("<node id='$-hips' sid='Hips' name='Hips' type='JOINT'><translate sid='t'>" +
                    std::to_string(x) +
                    " 0 0</translate><node id='$-spine' sid='Spine' name='Spine' type='JOINT'>"
                    "<translate sid='t'>0 0 0</translate></node></node>",
                {{"$", id}});
}

std::string user(const std::string& id, const std::string& name, const std::string& controller,
                 const std::string& root) {
  return "<node id='" + id + "' name='" + name + "'><instance_controller url='#" + controller +
         "'><skeleton>#" + root + "</skeleton></instance_controller></node>";
}

std::string libraries(const std::string& skins, const std::string& geometries) {
  return "<library_geometries>" + geometries + "</library_geometries><library_controllers>" + skins +
         "</library_controllers>";
}

std::set<std::string> moving_joints(const Character& character) {
  std::set<std::string> names;
  for (const Influence& influence : character.influences)
    names.insert(character.joints[character.bones[influence.bone].joint].name);
  return names;
}

TEST_F(ImportCollada, JointsAreKnownByTheirSids) {
  const std::string nodes = user("body", "Spine", "s", "a-hips") + skeleton("a", 0);
  const std::vector<Curve> curves = {{"a-spine/t.X", "0 1 2", "0 1 2", "LINEAR LINEAR LINEAR"}};
  for (const std::string kind : {"Name", "IDREF"}) {
    const std::string joints = kind == "Name" ? "Hips Spine" : "a-hips a-spine";
    const ImportedCharacter imported =
        read(collada(libraries(skin("s", "g", kind, joints), collada_geometry("g")), nodes, curves));
    EXPECT_EQ(moving_joints(imported.character), (std::set<std::string>{"a-hips", "a-spine"})) << kind;
    EXPECT_EQ(imported.character.clips.size(), 1u) << kind;
  }
}

TEST_F(ImportCollada, TwoPeopleWithTheSameJoints) {
  const std::string both =
      libraries(skin("s", "g", "Name", "Hips Spine") + skin("t", "h", "Name", "Hips Spine"),
                collada_geometry("g") + collada_geometry("h"));
  const std::string skeletons = skeleton("a", 0) + skeleton("b", 3);
  const ImportedCharacter pair = read(
      collada(both, user("one", "one", "s", "a-hips") + user("two", "two", "t", "b-hips") + skeletons, {}));
  EXPECT_EQ(moving_joints(pair.character), (std::set<std::string>{"a-hips", "a-spine", "b-hips", "b-spine"}));
  expect_refused(
      collada(libraries(skin("s", "g", "Name", "Hips Spine"), collada_geometry("g")),
              user("one", "one", "s", "a-hips") + user("two", "two", "s", "b-hips") + skeletons, {}),
      "Collada joint 'Hips' may be any of 2 nodes");
}

}  // namespace
}  // namespace bch
