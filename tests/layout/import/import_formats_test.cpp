// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include <bch/import.hpp>

#include "layout/character/eigen.hpp"
#include "layout/character/skinning.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/temporary_folder.hpp"

// What differs from format to format: units, axes, and clips that come in a file of their own.

namespace bch {
namespace {

bool has_note(const ImportReport& report, const std::string& part) {
  return std::any_of(report.notes.begin(), report.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

class ImportFormats : public testing::Test {
 protected:
  TemporaryFolder folder;

  /// The strip with the clips of another file behind its own.
  ImportedCharacter strip_with(const std::filesystem::path& clip_file) {
    ImportOptions options;
    options.clip_files = {clip_file};
    ImportedCharacter imported = import_character(folder.write("strip.gltf", SkinnedStrip().text()), options);
    validate(imported.character);
    return imported;
  }

  static void expect_equal_clips(const Character& character, std::uint32_t a, std::uint32_t b) {
    ASSERT_GT(character.clips.size(), std::max(a, b));
    ASSERT_EQ(character.clips[a].seconds, character.clips[b].seconds);
    detail::Skinner skinner_a(character);
    detail::Skinner skinner_b(character);
    for (const float share : {0.0f, 0.3f, 0.5f, 0.9f, 1.0f}) {
      const auto pose_a = skinner_a.pose({a, share * character.clips[a].seconds});
      const auto pose_b = skinner_b.pose({b, share * character.clips[b].seconds});
      for (std::size_t v = 0; v < pose_a.size(); ++v)
        EXPECT_LT((detail::to_eigen(pose_a[v]) - detail::to_eigen(pose_b[v])).norm(), 1e-5f)
            << "vertex " << v << " at " << share;
    }
  }

  /// Where a clip takes the root joint, in the frame of the file: the last key.
  static Eigen::Vector3f end_of_way(const Character& character, std::uint32_t clip) {
    for (const Channel& channel : character.clips.at(clip).channels)
      if (static_cast<std::int32_t>(channel.joint) == character.root_joint)
        return detail::to_eigen(channel.positions.back().value);
    throw std::logic_error("the root joint does not move");
  }
};

std::string fbx_tetrahedron(int up_axis, int up_sign, const std::string& unit) {
  return "; FBX 7.4.0 project file\n"
         "FBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7400\n}\n"
         "GlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n"
         "\t\tP: \"UpAxis\", \"int\", \"Integer\", \"\"," +
         std::to_string(up_axis) + "\n\t\tP: \"UpAxisSign\", \"int\", \"Integer\", \"\"," +
         std::to_string(up_sign) + "\n\t\tP: \"UnitScaleFactor\", \"double\", \"Number\", \"\"," + unit +
         "\n\t}\n}\nObjects:  {\n\tGeometry: 1000, \"Geometry::body\", \"Mesh\" {\n"
         "\t\tVertices: *12 {\n\t\t\ta: 0,0,0,10,0,0,0,30,0,0,0,70\n\t\t}\n"
         "\t\tPolygonVertexIndex: *12 {\n\t\t\ta: 0,2,-2,0,1,-4,1,2,-4,2,0,-4\n\t\t}\n"
         "\t\tGeometryVersion: 124\n\t}\n"
         "\tModel: 2000, \"Model::body\", \"Mesh\" {\n\t\tVersion: 232\n\t\tProperties70:  {\n\t\t}\n\t}\n}\n"
         "Connections:  {\n\tC: \"OO\",2000,0\n\tC: \"OO\",1000,2000\n}\n";
}

TEST_F(ImportFormats, FbxSaysItsAxisAndUnit) {
  const struct {
    int axis, sign;
    float height, lowest;
  } cases[] = {{0, 1, 10, 0}, {1, 1, 30, 0}, {2, 1, 70, 0}, {2, -1, 70, -70}, {1, -1, 30, -30}};
  for (const auto& [axis, sign, height, lowest] : cases) {
    const std::filesystem::path file = folder.write("body.fbx", fbx_tetrahedron(axis, sign, "2.54"));
    const auto [character, report] = import_character(file);
    EXPECT_NEAR(report.height, height * 0.0254f, 1e-5f) << "axis " << axis;
    EXPECT_TRUE(has_note(report, "inches -> metres (FBX unit scale factor 2.54)"));
    EXPECT_GT(detail::to_eigen(character.to_ground).linear().determinant(), 0);
    detail::Skinner skinner(character);
    float bottom = 1e9f;
    for (const Vec3& position : skinner.pose({})) bottom = std::min(bottom, position.z);
    EXPECT_NEAR(bottom, lowest * 0.0254f, 1e-5f) << "axis " << axis << ", sign " << sign;
  }
  EXPECT_THROW(import_character(folder.write("body.fbx", fbx_tetrahedron(7, 1, "1"))), ImportError);
  EXPECT_THROW(import_character(folder.write("body.fbx", fbx_tetrahedron(1, 1, "-1"))), ImportError);
}

TEST_F(ImportFormats, ColladaSaysItsAxisAndUnit) {
  const std::filesystem::path file = folder.write("body.dae",
                                                  R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 30 0 0 0 20 0 0 0 180</float_array><technique_common>
<accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 1 2 3 2 0 3</p></triangles>
</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node id="n">
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)");
  const ImportReport report = import_character(file).report;
  EXPECT_NEAR(report.height, 1.8f, 1e-5f);
  EXPECT_TRUE(has_note(report, "z up"));
  EXPECT_FALSE(has_note(report, "y up"));
  ImportOptions options;
  options.up = UpAxis::y;
  const ImportReport turned = import_character(file, options).report;
  EXPECT_NEAR(turned.height, 0.2f, 1e-5f);
  EXPECT_TRUE(has_note(turned, "y up -> z up, as the caller says"));
}

TEST_F(ImportFormats, TextMayBeginWithAByteOrderMark) {
  const std::string text = "v 0 0 0\nv 0.5 0 0\nv 0 1.8 0\nf 1 2 3\n";
  const Character plain = import_character(folder.write("plain.obj", text)).character;
  const Character marked = import_character(folder.write("marked.obj", "\xEF\xBB\xBF" + text)).character;
  EXPECT_EQ(marked.vertices, plain.vertices);
  EXPECT_EQ(marked.triangles, plain.triangles);
  std::string wide = "\xFF\xFE";
  for (const char c : text) wide.append({c, '\0'});
  for (const char* name : {"wide.obj", "wide.ply"}) {
    try {
      import_character(folder.write(name, wide));
      ADD_FAILURE() << name << " was accepted";
    } catch (const ImportError& error) {
      EXPECT_NE(std::string(error.what()).find("text in UTF-16"), std::string::npos) << error.what();
    }
  }
}

const char* const md5_mesh = R"(MD5Version 10
commandline ""
numJoints 2
numMeshes 1
joints {
	"hips"	-1 ( 0 0 40 ) ( 0 0 0 )
	"head"	0 ( 0 0 60 ) ( 0 0 0 )
}
mesh {
	shader "none"
	numverts 4
	vert 0 ( 0 0 ) 0 1
	vert 1 ( 1 0 ) 1 1
	vert 2 ( 0 1 ) 2 2
	vert 3 ( 1 1 ) 4 1
	numtris 2
	tri 0 0 1 3
	tri 1 0 3 2
	numweights 5
	weight 0 0 1 ( 0 0 -40 )
	weight 1 0 1 ( 20 0 -40 )
	weight 2 0 0.5 ( 0 0 32 )
	weight 3 1 0.5 ( 0 0 12 )
	weight 4 1 1 ( 20 0 12 )
}
)";

const char* const md5_anim = R"(MD5Version 10
commandline ""
numFrames 3
numJoints 2
frameRate 2
numAnimatedComponents 2
hierarchy {
	"hips"	-1 1 0	//
	"head"	0 32 1	// hips
}
bounds {
	( 0 0 0 ) ( 20 0 72 )
	( 0 0 0 ) ( 20 0 72 )
	( 0 0 0 ) ( 20 0 72 )
}
baseframe {
	( 0 0 40 ) ( 0 0 0 )
	( 0 0 20 ) ( 0 0 0 )
}
frame 0 {
	0 0
}
frame 1 {
	60 -0.382683
}
frame 2 {
	120 -0.707107
}
)";

/// The game's own tools end lines so; assimp 5.2 loses every second header line (the frame rate) of a file
/// with bare line feeds.
std::string with_carriage_returns(const std::string& text) {
  std::string out;
  for (const char c : text) out.append(c == '\n' ? "\r" : "").push_back(c);
  return out;
}

TEST_F(ImportFormats, SaysThatNodesShareAName) {
  std::string text = with_carriage_returns(md5_mesh);
  const std::filesystem::path distinct = folder.write("distinct.md5mesh", text);
  EXPECT_FALSE(has_note(import_character(distinct).report, "several nodes"));
  text.replace(text.find("\"head\""), 6, "\"hips\"");
  const std::filesystem::path shared = folder.write("shared.md5mesh", text);
  EXPECT_TRUE(has_note(import_character(shared).report, "several nodes are named 'hips'"));
}

TEST_F(ImportFormats, Md5WithItsMotionInAnotherFile) {
  ImportOptions options;
  options.clip_files = {folder.write("stroll.md5anim", with_carriage_returns(md5_anim))};
  const auto [character, report] =
      import_character(folder.write("strip.md5mesh", with_carriage_returns(md5_mesh)), options);
  EXPECT_NEAR(report.height, 1.8288f, 1e-5f);
  EXPECT_TRUE(has_note(report, "inches -> metres, guessed"));
  ASSERT_EQ(character.clips.size(), 1u);
  EXPECT_EQ(character.clips[0].name, "stroll");
  EXPECT_NEAR(character.clips[0].seconds, 1.0f, 1e-6f);
  ASSERT_GE(character.root_joint, 0);
  EXPECT_EQ(character.joints[static_cast<std::size_t>(character.root_joint)].name, "hips");
  // 120 inches along x, and a quarter of a turn of the head about the vertical, which takes x into +-y.
  detail::Skinner skinner(character);
  const auto pose = skinner.pose({0, character.clips[0].seconds});
  float top_x = 0;
  float top_y = 0;
  for (std::uint32_t v = 0; v < pose.size(); ++v) {
    const std::uint32_t begin = character.influence_begin[v];
    const Bone& bone = character.bones[character.influences[begin].bone];
    if (character.influence_begin[v + 1] - begin > 1 || character.joints[bone.joint].name != "head") continue;
    top_x = pose[v].x;
    top_y = pose[v].y;
  }
  EXPECT_NEAR(top_x, 0, 1e-4f);
  EXPECT_NEAR(std::abs(top_y), 0.508f, 1e-4f);
}

TEST_F(ImportFormats, IqmGivesItsRestPose) {
  std::string bytes = "INTERQUAKEMODEL";
  bytes.push_back('\0');
  const auto add = [&](const std::vector<std::uint32_t>& words) {
    for (const std::uint32_t word : words)
      for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(word >> shift & 0xff));
  };
  constexpr std::uint32_t header = 124;
  constexpr std::uint32_t text = header;
  constexpr std::uint32_t mesh = text + 4;
  constexpr std::uint32_t arrays = mesh + 24;
  constexpr std::uint32_t triangles = arrays + 20;
  constexpr std::uint32_t positions = triangles + 24;
  constexpr std::uint32_t size = positions + 48;
  add({2, size, 0, 4, text, 1, mesh, 1, 4, arrays, 2, triangles, 0});
  add(std::vector<std::uint32_t>(14, 0));
  add({0});                      // an empty name
  add({0, 0, 0, 4, 0, 2});       // one mesh of four vertices and two triangles
  add({0, 0, 7, 3, positions});  // floats, three a vertex
  add({0, 1, 3, 0, 3, 2});
  for (const float coordinate : {0.0f, 0.0f, 0.0f, 20.0f, 0.0f, 0.0f, 0.0f, 0.0f, 72.0f, 20.0f, 0.0f, 72.0f})
    add({std::bit_cast<std::uint32_t>(coordinate)});

  const auto [character, report] = import_character(folder.write("post.iqm", bytes));
  EXPECT_EQ(report.triangles, 2u);
  EXPECT_NEAR(report.height, 1.8288f, 1e-5f);
  EXPECT_EQ(character.root_joint, -1);
  EXPECT_TRUE(has_note(report, "rest pose alone"));
}

std::string bvh(const std::string& root, const std::string& child, const std::string& offset) {
  return "HIERARCHY\nROOT " + root +
         "\n{\n\tOFFSET 0 0 0\n\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation "
         "Yrotation\n\tJOINT " +
         child + "\n\t{\n\t\tOFFSET " + offset +
         "\n\t\tCHANNELS 3 Zrotation Xrotation Yrotation\n\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 10 "
         "0\n\t\t}\n\t}\n}\n"
         "MOTION\nFrames: 3\nFrame Time: 1\n0 100 0 0 0 0 0 0 0\n100 100 0 0 0 0 0 0 45\n300 100 0 0 0 0 0 0 "
         "90\n";
}

TEST_F(ImportFormats, BvhPlaysOnASkeletonOfTheSameJointsWhateverItsUnit) {
  const auto [character, report] = strip_with(folder.write("walk.bvh", bvh("hips", "head", "0 50 0")));
  ASSERT_EQ(character.clips.size(), 2u);
  EXPECT_TRUE(has_note(report, "positions scaled by 0.01")) << report.notes.back();
  expect_equal_clips(character, 0, 1);
  EXPECT_TRUE(end_of_way(character, 1).isApprox(Eigen::Vector3f(3, 1, 0), 1e-5f));
}

TEST_F(ImportFormats, BvhOfAnotherSkeletonIsRefused) {
  EXPECT_THROW(strip_with(folder.write("walk.bvh", bvh("Root", "Chest", "0 50 0"))), ImportError);
  EXPECT_THROW(strip_with(folder.write("walk.bvh", bvh("hips", "head", "50 0 0"))), ImportError);
}

TEST_F(ImportFormats, BvhAloneIsNoCharacter) {
  EXPECT_THROW(import_character(folder.write("walk.bvh", bvh("hips", "head", "0 50 0"))), ImportError);
}

TEST_F(ImportFormats, ClipsMatchThroughNamespaces) {
  for (const std::string prefix : {"mixamorig:", "mixamorig1:", "mixamorig_", "Armature|"}) {
    SkinnedStrip source;
    source.hips = prefix + "hips";
    source.head = prefix + "head";
    const auto [character, report] = strip_with(folder.write("stroll.gltf", source.text()));
    EXPECT_EQ(report.clips.at(1).name, "stroll");
    EXPECT_EQ(report.clips.at(1).channels, 2u) << prefix;
    expect_equal_clips(character, 0, 1);
  }
}

/// As modelling tools write it: an armature that turns z up to y up and centimetres to metres.
TEST_F(ImportFormats, ClipUnderATurnedAndScaledArmatureMovesAlike) {
  SkinnedStrip source;
  source.armature = "\"rotation\":[-0.70710678,0,0,0.70710678],\"scale\":[0.01,0.01,0.01],";
  source.hips_turn = "\"rotation\":[0.70710678,0,0,0.70710678],";
  source.head_place = "\"translation\":[0,50,0]";
  for (std::size_t key = 0; key < source.way.size(); key += 3) {
    const float up = source.way[key + 1];
    source.way[key] *= 100;
    source.way[key + 1] = -100 * source.way[key + 2];
    source.way[key + 2] = 100 * up;
  }
  const auto [character, report] = strip_with(folder.write("blend.gltf", source.text()));
  expect_equal_clips(character, 0, 1);
  EXPECT_TRUE(end_of_way(character, 1).isApprox(Eigen::Vector3f(3, 1, 0), 1e-5f));
}

TEST_F(ImportFormats, ClipOfATallerSkeletonIsScaledAndLimbsKeepTheirLength) {
  SkinnedStrip source;
  source.head_place = "\"translation\":[0,1,0]";
  for (float& coordinate : source.way) coordinate *= 2;
  const auto [character, report] = strip_with(folder.write("giant.gltf", source.text()));
  expect_equal_clips(character, 0, 1);
  EXPECT_TRUE(end_of_way(character, 1).isApprox(Eigen::Vector3f(3, 1, 0), 1e-5f));
}

}  // namespace
}  // namespace bch
