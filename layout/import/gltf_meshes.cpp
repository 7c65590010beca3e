// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include "layout/import/gltf_draco.hpp"
#include "layout/import/gltf_parts.hpp"
#include "layout/import/scene.hpp"

namespace bch::detail::importing {
namespace {

constexpr std::size_t no_skin = static_cast<std::size_t>(-1);

/// What a primitive's vertices make.
enum Mode : std::size_t { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };

std::size_t corners_of(Mode mode) {
  return mode == points ? 1 : mode < triangles ? 2 : 3;
}

/// Lists that do not come out even end with a face that lacks corners.
std::size_t faces_of(Mode mode, std::size_t corners) {
  const std::size_t each = corners_of(mode);
  if (mode == points || mode == lines || mode == triangles) return (corners + each - 1) / each;
  if (corners < each) return 0;
  return mode == line_loop ? corners : corners + 1 - each;
}

/// Returns the place of a face's corner `k` in the list. Faces of a strip turn the same way.
std::size_t corner_of(Mode mode, std::size_t face, std::size_t k, std::size_t corners) {
  switch (mode) {
    case line_loop:
      return (face + k) % corners;
    case line_strip:
      return face + k;
    case triangle_strip:
      return face + (face % 2 == 1 && k < 2 ? 1 - k : k);
    case triangle_fan:
      return k == 0 ? 0 : face + k;
    default:
      return face * corners_of(mode) + k;
  }
}

void make_faces(Mode mode, const std::vector<std::uint32_t>& list, aiMesh& mesh) {
  const std::size_t size = faces_of(mode, list.size());
  mesh.mFaces = new aiFace[size];
  mesh.mNumFaces = static_cast<unsigned>(size);
  for (std::size_t f = 0; f < size; ++f) {
    aiFace& face = mesh.mFaces[f];
    face.mIndices = new unsigned[corners_of(mode)];
    for (std::size_t k = 0; k < corners_of(mode); ++k) {
      const std::size_t corner = corner_of(mode, f, k, list.size());
      if (corner < list.size()) face.mIndices[face.mNumIndices++] = list[corner];
    }
  }
}

/// A primitive of the file, whose attributes stand in accessors or in a Draco mesh.
class Primitive {
 public:
  Primitive(GltfFile& file, const JsonValue& json) : file_(file), json_(json) {
    if (const JsonValue extension = json["extensions"]["KHR_draco_mesh_compression"])
      draco_.emplace(file, extension);
  }

  JsonValue attribute(const std::string& name) const { return json_["attributes"][name.c_str()]; }

  std::vector<float> floats(const std::string& name, const char* type) {
    const JsonValue accessor = file_.named_by(attribute(name), "accessors");
    return draco_
               ? draco_->attribute<float>(name.c_str(), components_of(type), accessor["normalized"].as_bool())
               : file_.floats(accessor, type);
  }
  std::vector<std::uint32_t> indices(const std::string& name, const char* type) {
    return draco_ ? draco_->attribute<std::uint32_t>(name.c_str(), components_of(type), false)
                  : file_.indices(file_.named_by(attribute(name), "accessors"), type);
  }

  /// The corners of its faces, as numbers of vertices.
  std::vector<std::uint32_t> corners(std::size_t vertices) {
    if (draco_) return draco_->corners();
    if (const JsonValue list = json_["indices"])
      return file_.indices(file_.named_by(list, "accessors"), "SCALAR");
    std::vector<std::uint32_t> all(vertices);
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }

  Mode mode() const {
    const auto mode = static_cast<Mode>(json_["mode"].integer(triangle_fan, triangles));
    return draco_ ? triangles : mode;  // a strip is compressed as its triangles
  }

 private:
  GltfFile& file_;
  JsonValue json_;
  std::optional<DracoMesh> draco_;
};

/// Positions and faces. A primitive without positions draws nothing.
void read_primitive(Primitive& primitive, aiMesh& mesh) {
  if (!primitive.attribute("POSITION")) return;
  const std::vector<float> positions = primitive.floats("POSITION", "VEC3");
  mesh.mVertices = new aiVector3D[positions.size() / 3];
  mesh.mNumVertices = static_cast<unsigned>(positions.size() / 3);
  for (unsigned v = 0; v < mesh.mNumVertices; ++v)
    mesh.mVertices[v] = vector_from(&positions[3 * std::size_t{v}]);
  make_faces(primitive.mode(), primitive.corners(mesh.mNumVertices), mesh);
}

using WeightLists = std::vector<std::vector<aiVertexWeight>>;

/// Adds the weights of JOINTS_n and WEIGHTS_n to the lists of their joints.
void read_weights(Primitive& primitive, const std::string& set, const aiMesh& mesh, WeightLists& lists) {
  const JsonValue joints = primitive.attribute("JOINTS_" + set);
  const std::vector<std::uint32_t> indices = primitive.indices("JOINTS_" + set, "VEC4");
  const std::vector<float> values = primitive.floats("WEIGHTS_" + set, "VEC4");
  if (indices.size() != 4 * std::size_t{mesh.mNumVertices} || values.size() != indices.size())
    joints.reject("and its weights are not as many as the " + count(mesh.mNumVertices, "vertex", "vertices"));
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == 0) continue;
    if (indices[i] >= lists.size())
      joints.reject("gives vertex " + std::to_string(i / 4) + " joint " + std::to_string(indices[i]) +
                    " of " + std::to_string(lists.size()));
    lists[indices[i]].emplace_back(static_cast<unsigned>(i / 4), values[i]);
  }
}

/// A bone for every joint of the skin, as assimp has it.
void read_bones(GltfReader& reader, Primitive& primitive, const JsonValue& skin, aiMesh& mesh) {
  GltfFile& file = reader.file;
  const JsonValue joints = skin["joints"], binds = skin["inverseBindMatrices"];
  WeightLists lists(joints.size());
  for (std::size_t set = 0; primitive.attribute("JOINTS_" + std::to_string(set)); ++set)
    read_weights(primitive, std::to_string(set), mesh, lists);
  std::vector<float> matrices;
  if (binds) {
    matrices = file.floats(file.named_by(binds, "accessors"), "MAT4");
    if (matrices.size() < 16 * lists.size())
      binds.reject("has fewer matrices than the skin has joints, " + std::to_string(lists.size()));
  }
  if (lists.empty()) return;  // assimp does not free an array of no bones
  mesh.mBones = new aiBone* [lists.size()] {};
  mesh.mNumBones = static_cast<unsigned>(lists.size());
  for (std::size_t j = 0; j < lists.size(); ++j) {
    aiBone& bone = *(mesh.mBones[j] = new aiBone);
    file.named_by(joints[j], "nodes");
    bone.mName = reader.names[joints[j].integer(reader.names.size())];
    if (binds) bone.mOffsetMatrix = matrix_from(&matrices[16 * j]);
    bone.mWeights = new aiVertexWeight[lists[j].size()];
    bone.mNumWeights = static_cast<unsigned>(lists[j].size());
    std::copy(lists[j].begin(), lists[j].end(), bone.mWeights);
  }
}

/// The meshes of the scene under construction, by mesh and skin of the file.
class MeshList {
 public:
  explicit MeshList(GltfReader& reader) : reader_(reader) {}

  /// Appends a mesh for each primitive.
  std::vector<unsigned> add(const JsonValue& mesh, const std::optional<JsonValue>& skin) {
    std::vector<unsigned> indices;
    const JsonValue primitives = mesh["primitives"];
    std::string name = mesh["name"].text().substr(0, longest_name);
    if (name.empty()) name = mesh.place();
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      indices.push_back(static_cast<unsigned>(meshes_.size()));
      aiMesh& made = *meshes_.emplace_back(new aiMesh);
      made.mName = primitives.size() > 1 ? name + "-" + std::to_string(p) : name;
      // The count alone: what is made of it is a note.
      made.mNumAnimMeshes = static_cast<unsigned>(primitives[p]["targets"].size());
      Primitive primitive(reader_.file, primitives[p]);
      read_primitive(primitive, made);
      if (skin) read_bones(reader_, primitive, *skin, made);
    }
    return indices;
  }

  void move_to(aiScene& scene) {
    scene.mMeshes = new aiMesh* [meshes_.size()] {};
    scene.mNumMeshes = static_cast<unsigned>(meshes_.size());
    for (std::size_t m = 0; m < meshes_.size(); ++m) scene.mMeshes[m] = meshes_[m].release();
  }

 private:
  GltfReader& reader_;
  std::vector<std::unique_ptr<aiMesh>> meshes_;
};

/// A node's own weights count before those of its mesh.
void check_morphs(GltfReader& reader, const JsonValue& node, const JsonValue& mesh) {
  const JsonValue weights = node["weights"] ? node["weights"] : mesh["weights"];
  if (!has_morphs(mesh)) return;
  for (std::size_t w = 0; w < weights.size(); ++w)
    if (weights[w].number() != 0)
      reader.result.posed_morphs =
          weights[w].place() + " moves vertices by a morph target, which is not read (only weights of 0 are)";
}

}  // namespace

bool has_morphs(const JsonValue& mesh) {
  const JsonValue primitives = mesh["primitives"];
  for (std::size_t p = 0; p < primitives.size(); ++p) {
    const JsonValue targets = primitives[p]["targets"];
    for (std::size_t t = 0; t < targets.size(); ++t)
      if (targets[t]["POSITION"]) return true;
  }
  return false;
}

void read_gltf_meshes(GltfReader& reader) {
  const GltfFile& file = reader.file;
  // The map is in the order of the file's meshes, which is the order in which messages number them.
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> users;
  const JsonValue nodes = file.root()["nodes"];
  for (std::size_t n = 0; n < reader.nodes.size(); ++n) {
    const JsonValue mesh = nodes[n]["mesh"], skin = nodes[n]["skin"];
    if (reader.nodes[n] == nullptr || !mesh) continue;
    check_morphs(reader, nodes[n], file.named_by(mesh, "meshes"));
    if (skin) file.named_by(skin, "skins");
    users[{mesh.integer(no_skin), skin.integer(no_skin, no_skin)}].push_back(n);
  }
  MeshList meshes(reader);
  for (const auto& [key, their_nodes] : users) {
    const JsonValue mesh = file.root()["meshes"][key.first];
    std::optional<JsonValue> skin;
    if (key.second != no_skin) skin = file.root()["skins"][key.second];
    const std::vector<unsigned> indices = meshes.add(mesh, skin);
    for (const std::size_t n : their_nodes) {
      reader.nodes[n]->mMeshes = new unsigned[indices.size()];
      reader.nodes[n]->mNumMeshes = static_cast<unsigned>(indices.size());
      std::copy(indices.begin(), indices.end(), reader.nodes[n]->mMeshes);
    }
  }
  meshes.move_to(*reader.result.scene);
}

}  // namespace bch::detail::importing
