// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>

#include "layout/import/gltf.hpp"
#include "layout/import/gltf_file.hpp"

// Private to the importer: what the parts of the glTF reader share.

namespace bch::detail::importing {

/// Holds a glTF file while it becomes a scene.
struct GltfReader {
  GltfFile file;
  GltfScene result;
  std::vector<std::string> names;  ///< of the nodes of the file, unique
  std::vector<aiNode*> nodes;      ///< likewise; null for those that are not of the scene
};

/// The longest name of a node or mesh: assimp's strings have an end, and what is added to a name must be before
/// it.
constexpr std::size_t longest_name = 900;

/// Returns the numbers of an array of that length.
template <std::size_t size>
std::array<float, size> numbers_of(const JsonValue& list) {
  if (list.size() != size) list.reject("has not " + std::to_string(size) + " numbers");
  std::array<float, size> numbers;
  for (std::size_t i = 0; i < size; ++i) numbers[i] = list[i].number();
  return numbers;
}

inline aiVector3D vector_from(const float* xyz) {
  return {xyz[0], xyz[1], xyz[2]};
}
inline aiQuaternion quaternion_from(const float* xyzw) {
  return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}
/// Returns a matrix of 16 numbers, given column by column.
aiMatrix4x4 matrix_from(const float* columns);

/// Gives the scene the meshes of its nodes, one for every primitive and skin.
void read_gltf_meshes(GltfReader& reader);

/// Gives the scene the animations of the file.
void read_gltf_animations(GltfReader& reader);

/// Returns whether morph targets move vertices of a mesh.
bool has_morphs(const JsonValue& mesh);

}  // namespace bch::detail::importing
