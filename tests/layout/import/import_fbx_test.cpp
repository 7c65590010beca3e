// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <zlib.h>

#include "layout/base/random.hpp"
#include "layout/import/fbx_document.hpp"
#include "tests/support/fbx_text.hpp"
#include "tests/support/import_test.hpp"
#include "tests/support/test.hpp"

// Every row of the chapter's table of FBX, against the published chain.

namespace bch {
namespace {

using detail::importing::FbxFile;
using detail::importing::FbxRecord;
using detail::importing::FbxValue;
using Eigen::Affine3d;
using Eigen::Vector3d;

class ImportFbx : public test::ImportTest {
 protected:
  ImportedCharacter read(const FbxText& fbx) const { return import("man.fbx", fbx.text()); }

  static std::vector<Vector3d> centred(std::vector<Vector3d> positions) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& position : positions) box.extend(position);
    for (Vector3d& position : positions) position -= Vector3d(box.center().x(), box.center().y(), 0);
    return positions;
  }

  static void expect_pose(const Character& character, PoseTime at, const std::vector<Vector3d>& of_file,
                          const std::string& place) {
    std::vector<Vector3d> expected, found;
    for (const Vector3d& p : of_file) expected.emplace_back(p.x(), -p.z(), p.y());
    detail::Skinner skinner(character);
    for (const Vec3& p : skinner.pose(at)) found.push_back(detail::to_eigen(p).cast<double>());
    expected = centred(expected);
    found = centred(found);
    ASSERT_EQ(found.size(), expected.size()) << place;
    for (const Vector3d& position : expected) {
      double nearest = 1e9;
      for (const Vector3d& other : found) nearest = std::min(nearest, (other - position).norm());
      EXPECT_LT(nearest, 2e-3) << place << ": no vertex at " << position.transpose();
    }
  }

  /// Compares the rest pose, and those of the clip at times between its keys and just beside them.
  void expect_as_written(const FbxText& fbx, const std::string& what) {
    SCOPED_TRACE(what);
    ImportedCharacter imported = read(fbx);
    imported.character.root_joint = -1;
    expect_pose(imported.character, {}, fbx.pose(0, true), "rest");
    if (fbx.curves.empty()) return;
    ASSERT_EQ(imported.character.clips.size(), 1u);
    EXPECT_NEAR(imported.character.clips[0].seconds, fbx.stop - fbx.start, 1e-5);
    for (const double time : {0.0, 0.13, 0.25, 0.49, 0.51, 0.75, 0.98, 1.0})
      expect_pose(imported.character, {0, static_cast<float>(time)}, fbx.pose(time),
                  "at " + std::to_string(time));
  }

  void expect_refused(const FbxText& fbx, const std::string& reason) const {
    EXPECT_TRUE(test::has(complaint("man.fbx", fbx.text()), reason));
  }
};

TEST_F(ImportFbx, EveryPartOfTheChain) {
  const struct {
    const char* name;
    Vector3d value;
  } parts[] = {{"Lcl Rotation", {20, -40, 70}},
               {"Lcl Scaling", {1.2, 0.8, 1.5}},
               {"PreRotation", {10, 20, 90}},
               {"PostRotation", {30, -50, 90}},
               {"RotationOffset", {0.1, 0.2, -0.1}},
               {"RotationPivot", {0, -0.4, 0.1}},
               {"ScalingOffset", {0.2, 0, 0.1}},
               {"ScalingPivot", {0.3, 0.2, 0}},
               {"GeometricTranslation", {0.1, 0.2, 0.3}},
               {"GeometricRotation", {30, 40, -50}},
               {"GeometricScaling", {1.1, 0.7, 2}}};
  FbxText all = man();
  for (const auto& [name, value] : parts)
    for (const bool moves : {false, true})
      for (const int node : {2, 3, 5}) {
        FbxText fbx = man();
        if (moves) move_spine(fbx);
        fbx.nodes[static_cast<std::size_t>(node)].vectors[name] = value;
        fbx.bind(fbx.meshes.back());
        expect_as_written(fbx,
                          std::string(name) + (moves ? ", moving" : "") + ", node " + std::to_string(node));
        all.nodes[static_cast<std::size_t>(node)].vectors[name] = value;
      }
  all.bind(all.meshes.back());
  expect_as_written(all, "all");
  move_spine(all);
  expect_as_written(all, "all, moving");
}

TEST_F(ImportFbx, EveryOrderOfRotation) {
  for (int order = 0; order < 6; ++order)
    for (const int active : {0, 1}) {
      FbxText fbx = man();
      move_spine(fbx);
      fbx.nodes[2].vectors["Lcl Rotation"] = {20, -40, 70};
      fbx.nodes[2].vectors["PreRotation"] = fbx.nodes[2].vectors["PostRotation"] = {0, 30, 40};
      fbx.nodes[2].numbers["RotationOrder"] = order;
      fbx.nodes[2].numbers["RotationActive"] = active;
      expect_as_written(fbx, "order " + std::to_string(order) + ", active " + std::to_string(active));
    }
  FbxText spheric = man();
  spheric.nodes[2].numbers["RotationOrder"] = 6;
  expect_as_written(spheric, "spheric, of a node that is not turned");
  spheric.nodes[2].vectors["Lcl Rotation"] = {20, 30, 0};
  expect_refused(spheric, "FBX node 'Spine' has the rotation order 6");
}

TEST_F(ImportFbx, EveryKindOfInheritance) {
  for (const int type : {0, 1, 2})
    for (const Vector3d& scale : {Vector3d(1.5, 1.5, 1.5), Vector3d(1.5, 0.8, 1.2)})
      for (const bool turned : {false, true}) {
        FbxText fbx = man();
        fbx.nodes[1].vectors["Lcl Scaling"] = scale;
        fbx.nodes[2].numbers["InheritType"] = type;
        fbx.nodes[2].vectors["Lcl Scaling"] = {1, 2, 1};
        if (turned) fbx.nodes[2].vectors["Lcl Rotation"] = {20, -40, 70};
        fbx.meshes.back().clusters.pop_back();
        fbx.meshes.back().clusters[0] = {1, {0, 1, 2, 3}, {1, 1, 1, 1}};
        fbx.bind(fbx.meshes.back());
        expect_as_written(fbx, "type " + std::to_string(type) + ", scale " + std::to_string(scale.y()));
        if (!scale.isApprox(Vector3d::Constant(1.5))) continue;
        fbx.curves = {{1, "Lcl Scaling", 0, {0, 1}, {1.5, 2}},
                      {1, "Lcl Scaling", 1, {0, 1}, {1.5, 2}},
                      {1, "Lcl Scaling", 2, {0, 1}, {1.5, 2}},
                      {2, "Lcl Rotation", 1, {0, 1}, {0, 60}}};
        expect_as_written(fbx, "moving, type " + std::to_string(type));
      }
  FbxText fbx = man();
  fbx.nodes[2].numbers["InheritType"] = 7;
  expect_refused(fbx, "FBX node 'Spine' has the InheritType 7");
  fbx.nodes[2].numbers["InheritType"] = 0;
  fbx.nodes[1].vectors["Lcl Scaling"] = {1.5, 0.8, 1.2};
  fbx.curves = {{2, "Lcl Rotation", 1, {0, 1}, {0, 60}}};
  expect_refused(fbx, "FBX clip 'Take 001', node 'Spine': shears it");
}

TEST_F(ImportFbx, EveryKindOfKey) {
  for (const int flags : {2, 0x102, 4, 0x408})
    for (const char* const property : {"Lcl Rotation", "Lcl Translation", "Lcl Scaling", "RotationOffset"}) {
      FbxText fbx = man();
      const double size = property == std::string("Lcl Rotation") ? 100 : 0.5;
      const auto slope = static_cast<float>(size);
      fbx.curves = {{2, property, 1, {0, 0.5, 1}, {0.1 * size, size, 0.4 * size}, flags, slope, -2 * slope},
                    {2, "Lcl Rotation", 2, {0, 1}, {0, 300}}};
      expect_as_written(fbx, std::string(property) + ", flags " + std::to_string(flags));
      fbx.curves.pop_back();
      expect_as_written(fbx, std::string(property) + " alone, flags " + std::to_string(flags));
    }
}

TEST_F(ImportFbx, KeysOutsideOfTheClip) {
  FbxText fbx = man();
  fbx.start = 0.5;
  fbx.stop = 1.5;
  fbx.curves = {{2, "Lcl Rotation", 1, {-1, 0.75, 3}, {-40, 60, -80}},
                {1, "Lcl Translation", 0, {1, 1.25}, {0, 0.5}, 2}};
  expect_as_written(fbx, "keys before and behind");
}

TEST_F(ImportFbx, CubicKeysWithoutTangentsAreNoted) {
  FbxText fbx = man();
  fbx.curves = {{2, "Lcl Rotation", 1, {0, 1}, {0, 60}, 0x108}};
  EXPECT_TRUE(test::has_note(
      read(fbx).report, "clip 'Take 001': cubic keys without tangents of their own are blended linearly"));
}

TEST_F(ImportFbx, ASkinIsBoundAsTheFileSays) {
  FbxText fbx = man();
  fbx.nodes[5].vectors["Lcl Translation"] = {5, 6, 7};  // after it was bound, which does not move a skin
  fbx.nodes[2].vectors["Lcl Rotation"] = {0, 0, 40};
  expect_as_written(fbx, "moved");
}

TEST_F(ImportFbx, WeightsInPercent) {
  FbxText fbx = man();
  for (FbxTextCluster& cluster : fbx.meshes.back().clusters)
    for (double& weight : cluster.weights) weight *= 100;
  move_spine(fbx);
  expect_as_written(fbx, "percent");
  fbx.meshes.back().clusters[0].mode = "Total1";
  expect_refused(fbx, "which is not within 0 and 1");
  fbx = man();
  fbx.meshes.back().clusters[1].mode = "Additive";
  expect_refused(fbx, "FBX mesh of node 'Body' adds what its bone 'Spine' does to the rest");
}

TEST_F(ImportFbx, NodesThatShareANameAreKnownByIdentity) {
  FbxText fbx = man();
  move_spine(fbx);
  fbx.nodes[0].name = fbx.nodes[3].name = fbx.nodes[5].name = fbx.nodes[6].name = "Spine";
  expect_as_written(fbx, "meshes named as a bone");
  // Two people.
  FbxText pair = man();
  move_spine(pair);
  const FbxText other = pair;
  const auto first = static_cast<int>(pair.nodes.size());
  for (FbxTextNode node : other.nodes) {
    if (node.parent >= 0) node.parent += first;
    pair.nodes.push_back(node);
  }
  pair.nodes[static_cast<std::size_t>(first)].vectors["Lcl Translation"] = {1.2, 0, 0.3};
  pair.nodes[static_cast<std::size_t>(first) + 5].vectors["Lcl Translation"] = {1.2, 0, 0.3};
  for (FbxTextCurve curve : other.curves) {
    curve.node += first;
    for (double& value : curve.values) value *= -0.5;
    pair.curves.push_back(curve);
  }
  for (FbxTextMesh mesh : other.meshes) {
    mesh.node += first;
    for (Vector3d& point : mesh.points) point += Vector3d(0.01, 0.02, 0);
    for (FbxTextCluster& cluster : mesh.clusters) cluster.node += first;
    pair.bind(mesh);
    pair.meshes.push_back(mesh);
  }
  expect_as_written(pair, "two people");
}

TEST_F(ImportFbx, WhatIsNotRead) {
  FbxText twins = man();
  twins.nodes[1].name = "Spine";
  expect_refused(twins, "has two bones named 'Spine'");
  FbxText layers = man();
  layers.curves = {{2, "Lcl Rotation", 1, {0, 1}, {0, 60}},
                   {2, "Lcl Rotation", 1, {0, 1}, {0, 30}, 4, 0, 0, 1}};
  expect_refused(layers, "FBX clip 'Take 001' blends layers that move Lcl Rotation of node 'Spine'");
  FbxText geometric = man();
  geometric.curves = {{2, "Lcl Rotation", 1, {0, 1}, {0, 60}}, {3, "GeometricRotation", 1, {0, 1}, {0, 60}}};
  expect_refused(geometric, "moves GeometricRotation of node 'Hat'");
  for (const std::string percent : {"0", "100", "-3", "animated"}) {
#ifdef BCH_SANITIZED
    if (percent == "animated") continue;  // assimp loses the memory of its channel
#endif
    FbxText blend = man();
    blend.more_objects =
        "Geometry: 7000, 'Geometry::Fat', 'Shape' {\nVersion: 100\nIndexes: *1 {\na: 1\n}\n"
        "Vertices: *3 {\na: 5,0,0\n}\nNormals: *3 {\na: 0,0,0\n}\n}\n"
        "Deformer: 7001, 'Deformer::bs', 'BlendShape' {\nVersion: 100\n}\n"
        "Deformer: 7002, 'SubDeformer::Fat', 'BlendShapeChannel' {\nVersion: 100\nDeformPercent: " +
        percent + "\nFullWeights: *1 {\na: 100\n}\n}\n";
    blend.more_connections = "C: 'OO',7001,1000\nC: 'OO',7002,7001\nC: 'OO',7000,7002\n";
    if (percent == "animated") {
      blend.curves = {{2, "Lcl Rotation", 1, {0, 1}, {0, 60}}};
      blend.more_objects.replace(blend.more_objects.find(percent), percent.size(), "0");
      blend.more_connections += "C: 'OP',6000,7002, 'DeformPercent'\n";
    }
    if (percent == "0")
      expect_as_written(blend, "a blend shape at 0");
    else
      expect_refused(blend, "FBX blend shape 'Fat' moves vertices");
  }
}

// ---- Records of FBX files, binary and text, sound and damaged.

template <class Number>
std::string bytes_of(Number number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

/// Returns a number as one of a type of FBX's.
std::string number_as(char type, double number) {
  switch (type | 0x20) {
    case 'l':
      return bytes_of(static_cast<std::int64_t>(number));
    case 'i':
      return bytes_of(static_cast<std::int32_t>(number));
    default:
      return bytes_of(number);
  }
}

/// Returns the type that a binary file has for a number.
char type_of(const FbxRecord& record) {
  if (record.name == "C" || record.values.size() == 3) return 'L';  // ids
  if (record.name != "P") return 'I';
  const std::string_view kind = record.text(1);
  return kind == "KTime" ? 'L' : kind == "enum" || kind == "int" ? 'I' : 'D';
}

std::string packed_array(const FbxFile& file, const FbxRecord& record) {
  FbxRecord holder;
  holder.children = {record};
  const bool whole =
      record.name.ends_with("Index") || record.name == "Indexes" || record.name.starts_with("KeyAttr");
  const char type = record.name == "KeyTime" ? 'l' : whole ? 'i' : 'd';
  std::string plain;
  const std::vector<double> numbers = file.numbers(holder, record.name);
  for (const double number : numbers) plain += number_as(type, number);
  std::string packed(compressBound(plain.size()), '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(plain.data()),
           plain.size());
  // Floats have the bits of the whole numbers in the text.
  const char stated = record.name == "KeyAttrDataFloat" ? 'f' : type;
  return stated + bytes_of(static_cast<std::uint32_t>(numbers.size())) + bytes_of(std::uint32_t{1}) +
         bytes_of(static_cast<std::uint32_t>(size)) + packed.substr(0, size);
}

std::string text_value(std::string text) {
  if (const std::size_t end = text.find("::"); end != text.npos)
    text = text.substr(end + 2) + std::string("\0\1", 2) + text.substr(0, end);
  return "S" + bytes_of(static_cast<std::uint32_t>(text.size())) + text;
}

/// Writes a record as in a binary file, where it begins so many bytes behind the start.
std::string binary(const FbxFile& file, const FbxRecord& record, std::size_t begin) {
  std::string values;
  for (const FbxValue& value : record.values)
    values += value.type == 't'   ? packed_array(file, record)
              : value.type == 'n' ? type_of(record) + number_as(type_of(record), value.number)
                                  : text_value(std::string(value.bytes));
  const std::size_t head = 13 + record.name.size() + values.size();
  std::string below;
  for (const FbxRecord& child : record.children) below += binary(file, child, begin + head + below.size());
  if (!record.children.empty()) below += std::string(13, '\0');
  const auto word = [](std::size_t number) { return bytes_of(static_cast<std::uint32_t>(number)); };
  return word(begin + head + below.size()) + word(record.values.size()) + word(values.size()) +
         static_cast<char>(record.name.size()) + std::string(record.name) + values + below;
}

std::string binary(const FbxFile& file) {
  std::string bytes("Kaydara FBX Binary  \0\x1a\0", 23);
  bytes += std::string("\xe8\x1c\0\0", 4);  // version 7400
  for (const FbxRecord& record : file.root().children) bytes += binary(file, record, bytes.size());
  return bytes + std::string(13 + 160, '\0');
}

FbxText moving_man() {
  FbxText fbx = man();
  move_spine(fbx);
  fbx.curves[0].flags = 0x408;
  fbx.curves[0].slope = 90;
  fbx.nodes[2].vectors["PostRotation"] = {30, -50, 90};
  fbx.nodes[3].vectors["GeometricRotation"] = {30, -50, 90};
  return fbx;
}

TEST(FbxRecords, ABinaryFileIsReadAsItsText) {
  TemporaryFolder folder;
  const std::filesystem::path path = folder.write("man.fbx", moving_man().text());
  const Character text = import_character(path).character;
  const Character read_again = import_character(folder.write("man.fbx", binary(FbxFile(path)))).character;
  ASSERT_EQ(read_again.clips.size(), 1u);
  EXPECT_LT(test::farthest_apart(text, PoseTime{}, read_again, PoseTime{}), 1e-6f);
  EXPECT_LT(test::farthest_in_clips(text, 0, read_again, 0), 1e-6f);
}

/// Decodes all that the importer does.
/// Returns: whether the file is read; otherwise it is refused.
bool decode(const std::filesystem::path& path) {
  try {
    const detail::importing::FbxDocument document(path);
    for (const auto id : document.all("AnimationCurve")) read_curve(document, *document.object(id));
    for (const auto id : document.all("Deformer", "Cluster"))
      document.file().numbers(*document.object(id), "Transform");
    return true;
  } catch (const ImportError&) {
    return false;
  }
}

TEST(FbxRecords, DamageIsRefusedOrRead) {
  TemporaryFolder folder;
  const std::filesystem::path path = folder.write("man.fbx", moving_man().text());
  const std::string texts[] = {moving_man().text(), binary(FbxFile(path))};
  detail::Random random(51);
  for (const std::string& text : texts) {
    std::uint32_t refused = 0;
    EXPECT_TRUE(decode(folder.write("whole.fbx", text)));
    for (std::uint32_t i = 0; i < test::samples(120); ++i) {
      std::string damaged = text;
      const auto place = [&] { return random.below(static_cast<std::uint32_t>(damaged.size())); };
      for (int change = 0; change < 3; ++change) damaged[place()] = static_cast<char>(random.below(256));
      if (i % 4 == 0) damaged.resize(place());
      refused += !decode(folder.write("damaged.fbx", damaged));
    }
    EXPECT_GT(refused, 0u);
  }
}

TEST(FbxRecords, DeepRecordsAreRefused) {
  TemporaryFolder folder;
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "A: {";
  EXPECT_THROW(FbxFile(folder.write("deep.fbx", deep)), ImportError);
}

}  // namespace
}  // namespace bch
