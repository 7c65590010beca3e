// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "layout/import/scene.hpp"

// Private to the importer: aiMesh -> vertices, influences, triangles.

namespace bch::detail::importing {

/// Holds the bones of a character under construction. Meshes that share a skeleton bring the same bones again.
class BoneTable {
 public:
  explicit BoneTable(std::vector<Bone>& bones) : bones_(&bones) {}

  std::uint32_t add(std::uint32_t joint, const Affine3& inverse_bind);

 private:
  std::vector<Bone>* bones_;
  std::map<std::pair<std::uint32_t, std::array<float, 12>>, std::uint32_t> indices_;
};

using InfluenceLists = std::vector<std::vector<Influence>>;

/// Returns normalised influences of every vertex of a mesh with bones, in order of bone.
/// Errors:  throws ImportError on bones, indices and weights that make no sense, and if all weights are zero.
InfluenceLists read_influences(const SceneFile& file, const NodeList& nodes, const aiMesh& mesh,
                               const std::string& mesh_name, BoneTable& bones, ImportReport& report);

/// Appends every instance of every mesh. Joints are indices into `nodes`.
/// Returns: for each bone whether it is one of a skin, not the node of a rigid mesh.
std::vector<bool> read_meshes(const SceneFile& file, const NodeList& nodes, Character& character,
                              ImportReport& report);

/// Makes one vertex of those that are equal in position and influences, and drops those of no triangle.
void weld_vertices(Character& character, ImportReport& report);

}  // namespace bch::detail::importing
