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

using ImportText = test::ImportTest;

/// Of OBJ, PLY and BVH.
TEST_F(ImportText, ThatIsNoneIsRefused) {
  test::expect_table(__FILE__, "text_refusals.txt",
                     [&](const auto& fields) { return complaint(fields[0], fields[1]); });
}

TEST_F(ImportText, MayBeWrittenInManyWays) {
  test::expect_table(__FILE__, "text_readings.txt", [&](const auto& fields) {
    const auto [character, report] = import(fields[0], fields[1], test::as_it_is());
    std::ostringstream all;
    all.precision(9);
    for (const auto& [x, y, z] : character.vertices) all << x << ' ' << y << ' ' << z << ", ";
    for (const auto& [a, b, c] : character.triangles) all << a << ' ' << b << ' ' << c << ", ";
    all << report.dropped_faces;
    return all.str();
  });
}

// ---- PLY

template <class Number>
void append(std::string& bytes, Number number, bool big_endian) {
  auto part = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if (big_endian) std::ranges::reverse(part);
  bytes.append(part.data(), part.size());
}

/// The first coordinate begins with a line feed.
std::string binary_ply(bool big_endian, const std::string& line_end) {
  std::string text =
      "ply\nformat binary_" + std::string(big_endian ? "big" : "little") +
      "_endian 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n";
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
      const Character character =
          import("a.ply", binary_ply(big_endian, line_end), test::as_it_is()).character;
      ASSERT_EQ(character.triangles.size(), 3u) << big_endian;
      ASSERT_EQ(character.vertices.size(), 5u);
      EXPECT_EQ(character.vertices[0].x, std::bit_cast<float>(big_endian ? 0x0a23d73cu : 0x3c23d70au));
      EXPECT_EQ(character.vertices[2], (Vec3{1, 1, 0}));
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

// ---- What Collada says of keys and joints, and assimp does not on_meeting.

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
