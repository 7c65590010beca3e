// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/mesh.hpp"

#include <algorithm>
#include <bit>
#include <compare>
#include <numeric>
#include <span>

#include "layout/import/polygon.hpp"

namespace bch::detail::importing {
namespace {

std::string describe(const aiMesh& mesh, unsigned index) {
  const std::string name = to_string(mesh.mName);
  return "mesh " + std::to_string(index) + (name.empty() ? "" : " '" + name + "'");
}

std::vector<Vec3> read_vertices(const SceneFile& file, const aiMesh& mesh, const std::string& mesh_name) {
  if (mesh.mNumVertices > 0 && mesh.mVertices == nullptr) file.reject(mesh_name + " has no positions");
  std::vector<Vec3> vertices(mesh.mNumVertices);
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    vertices[v] = {mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z};
    const std::string place = mesh_name + ", vertex " + std::to_string(v);
    if (!to_eigen(vertices[v]).allFinite()) file.reject(place + " is not finite");
    if (to_eigen(vertices[v]).cwiseAbs().maxCoeff() > largest_number)
      file.reject(place + " is absurdly far away");
  }
  return vertices;
}

std::vector<std::array<std::uint32_t, 3>> read_triangles(const SceneFile& file, const aiMesh& mesh,
                                                         const std::string& mesh_name,
                                                         const std::vector<Vec3>& vertices,
                                                         ImportReport& report) {
  if (mesh.mNumFaces > 0 && mesh.mFaces == nullptr) file.reject(mesh_name + " has no faces where it says so");
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(mesh.mNumFaces);
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    const std::span corners(face.mIndices, face.mIndices == nullptr ? 0 : face.mNumIndices);
    const bool good =
        corners.size() >= 3 && std::all_of(corners.begin(), corners.end(),
                                           [&](unsigned corner) { return corner < vertices.size(); });
    if (good)
      append_triangles_of(vertices, corners, triangles);
    else
      ++report.dropped_faces;
  }
  return triangles;
}

/// The meshes of one node, one after the other.
class MeshAppender {
 public:
  MeshAppender(const SceneFile& file, const NodeList& nodes, Character& character, ImportReport& report)
      : file_(file), nodes_(nodes), character_(character), report_(report), bones_(character.bones) {
    character.influence_begin = {0};
  }

  void append(std::uint32_t node, unsigned mesh_index) {
    if (mesh_index >= file_.scene->mNumMeshes || file_.scene->mMeshes == nullptr ||
        file_.scene->mMeshes[mesh_index] == nullptr)
      file_.reject("node '" + nodes_.joints[node].name + "' names mesh " + std::to_string(mesh_index) +
                   ", which does not exist");
    const aiMesh& mesh = *file_.scene->mMeshes[mesh_index];
    const std::string name = describe(mesh, mesh_index);
    // Bones place a mesh in the scene without its node, so further instances would all coincide.
    if (mesh.mNumBones > 0 && !skins_.insert({mesh_index, true}).second) {
      report_.notes.push_back(name + " has bones and hangs on several nodes: it is taken once");
      return;
    }
    const std::vector<Vec3> vertices = read_vertices(file_, mesh, name);
    const auto triangles = read_triangles(file_, mesh, name, vertices, report_);
    if (triangles.empty()) {
      report_.dropped_vertices += vertices.size();
      return;
    }
    if (mesh.mNumAnimMeshes > 0) report_.notes.push_back(name + " has morph targets, which are ignored");
    ++report_.meshes;
    append_triangles(triangles);
    append_vertices(vertices, influences(mesh, name, node));
  }

  std::vector<bool> is_skin() const { return is_skin_; }

 private:
  const SceneFile& file_;
  const NodeList& nodes_;
  Character& character_;
  ImportReport& report_;
  BoneTable bones_;
  std::map<unsigned, bool> skins_;
  std::vector<bool> is_skin_;

  InfluenceLists influences(const aiMesh& mesh, const std::string& name, std::uint32_t node) {
    InfluenceLists lists;
    if (mesh.mNumBones > 0) {
      lists = read_influences(file_, nodes_, mesh, name, bones_, report_);
    } else {
      const std::uint32_t bone = bones_.add(node, {});
      lists.assign(mesh.mNumVertices, {Influence{bone, 1.0f}});
    }
    is_skin_.resize(character_.bones.size(), mesh.mNumBones > 0);
    return lists;
  }

  void append_triangles(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    if (character_.triangles.size() + triangles.size() > file_.max_triangles)
      file_.reject("more than " + count(file_.max_triangles, "triangle") +
                   ", those of each instance of a mesh; ImportOptions::max_triangles raises the limit");
    const auto offset = static_cast<std::uint32_t>(character_.vertices.size());
    for (const auto& [a, b, c] : triangles)
      character_.triangles.push_back({a + offset, b + offset, c + offset});
  }

  void append_vertices(const std::vector<Vec3>& vertices, const InfluenceLists& lists) {
    constexpr std::size_t most = 0x7fffffff;
    if (character_.vertices.size() + vertices.size() > most) file_.reject("too many vertices");
    character_.vertices.insert(character_.vertices.end(), vertices.begin(), vertices.end());
    for (const std::vector<Influence>& list : lists) {
      if (character_.influences.size() + list.size() > most) file_.reject("too many weights");
      character_.influences.insert(character_.influences.end(), list.begin(), list.end());
      character_.influence_begin.push_back(static_cast<std::uint32_t>(character_.influences.size()));
    }
  }
};

std::span<const Influence> influences_of(const Character& c, std::uint32_t vertex) {
  return std::span(c.influences)
      .subspan(c.influence_begin[vertex], c.influence_begin[vertex + 1] - c.influence_begin[vertex]);
}

/// Values are finite, so this is a total order but for the two zeros, which are equal positions.
std::weak_ordering order(float a, float b) {
  return a < b   ? std::weak_ordering::less
         : b < a ? std::weak_ordering::greater
                 : std::weak_ordering::equivalent;
}

/// Compares two vertices by position, then by influences.
std::weak_ordering compare_vertices(const Character& c, std::uint32_t a, std::uint32_t b) {
  for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z})
    if (const auto result = order(c.vertices[a].*axis, c.vertices[b].*axis); result != 0) return result;
  const std::span<const Influence> of_a = influences_of(c, a);
  const std::span<const Influence> of_b = influences_of(c, b);
  return std::lexicographical_compare_three_way(
      of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
      [](const Influence& x, const Influence& y) -> std::weak_ordering {
        if (x.bone != y.bone) return x.bone <=> y.bone;
        return order(x.weight, y.weight);
      });
}

/// Finds for every vertex the first of those that are equal to it.
std::vector<std::uint32_t> find_equals(const Character& c) {
  std::vector<std::uint32_t> sorted(c.vertices.size());
  std::iota(sorted.begin(), sorted.end(), 0u);
  std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
    const std::weak_ordering result = compare_vertices(c, a, b);
    return result != 0 ? result < 0 : a < b;
  });
  std::vector<std::uint32_t> first_equal(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const bool repeats = i > 0 && compare_vertices(c, sorted[i - 1], sorted[i]) == 0;
    first_equal[sorted[i]] = repeats ? first_equal[sorted[i - 1]] : sorted[i];
  }
  return first_equal;
}

}  // namespace

std::uint32_t BoneTable::add(std::uint32_t joint, const Affine3& inverse_bind) {
  const auto elements = std::bit_cast<std::array<float, 12>>(inverse_bind);
  const auto next = static_cast<std::uint32_t>(bones_->size());
  const auto [place, added] = indices_.try_emplace({joint, elements}, next);
  if (added) bones_->push_back({joint, inverse_bind});
  return place->second;
}

std::vector<bool> read_meshes(const SceneFile& file, const NodeList& nodes, Character& character,
                              ImportReport& report) {
  MeshAppender appender(file, nodes, character, report);
  for (std::uint32_t n = 0; n < nodes.nodes.size(); ++n) {
    const aiNode& node = *nodes.nodes[n];
    if (node.mNumMeshes > 0 && node.mMeshes == nullptr)
      file.reject("node '" + nodes.joints[n].name + "' has no meshes where it says so");
    for (unsigned m = 0; m < node.mNumMeshes; ++m) appender.append(n, node.mMeshes[m]);
  }
  if (character.triangles.empty()) file.reject("no triangles");
  if (report.dropped_faces > 0)
    report.notes.push_back(count(report.dropped_faces, "face was", "faces were") +
                           " dropped: points, lines, or vertices that are not there");
  return appender.is_skin();
}

void weld_vertices(Character& character, ImportReport& report) {
  const std::vector<std::uint32_t> first_equal = find_equals(character);
  constexpr std::uint32_t none = 0xffffffff;
  std::vector<std::uint32_t> new_index(character.vertices.size(), none);
  std::vector<bool> used(character.vertices.size());
  Character welded;
  welded.influence_begin = {0};
  for (auto& triangle : character.triangles) {
    for (std::uint32_t& vertex : triangle) {
      used[vertex] = true;
      const std::uint32_t original = first_equal[vertex];
      if (new_index[original] == none) {
        new_index[original] = static_cast<std::uint32_t>(welded.vertices.size());
        welded.vertices.push_back(character.vertices[original]);
        const std::span<const Influence> influences = influences_of(character, original);
        welded.influences.insert(welded.influences.end(), influences.begin(), influences.end());
        welded.influence_begin.push_back(static_cast<std::uint32_t>(welded.influences.size()));
      }
      vertex = new_index[original];
    }
  }
  report.dropped_vertices += static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
  character.vertices = std::move(welded.vertices);
  character.influences = std::move(welded.influences);
  character.influence_begin = std::move(welded.influence_begin);
}

}  // namespace bch::detail::importing
