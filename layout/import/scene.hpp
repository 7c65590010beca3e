// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include <bch/import.hpp>

#include "layout/character/eigen.hpp"
#include "layout/import/gltf.hpp"

// Private to the importer: a file as a scene of assimp's types, and the first checks of it.

namespace bch::detail::importing {

/// The largest number that is not taken for damage: the squares of larger ones leave float's range soon
/// after.
constexpr float largest_number = 1e15f;

/// Returns a text whose control characters are replaced by blanks, so that a message stays one line whatever a file contains.
std::string one_line(const std::string& text);

[[noreturn]] void reject(const std::filesystem::path& file, const std::string& reason);

/// Returns a number with its noun: "1 face", "2 faces".
std::string count(std::size_t number, const std::string& noun, const std::string& plural = "");

std::string to_string(const aiString& text);

struct SceneFile {
  std::filesystem::path path;
  Assimp::Importer importer;  ///< owns the scene of a file that assimp reads
  GltfScene gltf;             ///< of a glTF file
  std::unique_ptr<aiScene, SceneDeleter> ply;
  const aiScene* scene = nullptr;
  std::string format;
  std::vector<std::string> notes;  ///< on what was corrected or is not read
  std::size_t max_triangles = ImportOptions().max_triangles;

  /// Reads the scene of a file.
  /// Errors:  throws ImportError if the file cannot be read as a scene with a root node.
  SceneFile(const std::filesystem::path& file, const ImportOptions& options);
  /// Takes a scene that the caller owns, as if a reader of this name had found it in the file.
  SceneFile(const std::filesystem::path& file, const aiScene& scene_there, const std::string& reader)
      : path(file), scene(&scene_there), format(reader) {}

  bool is_fbx() const { return format == "Autodesk FBX Importer"; }

  [[noreturn]] void reject(const std::string& reason) const { importing::reject(path, reason); }
};

/// Does all of import_character() except reading the file.
/// Errors:  throws ImportError, and what validate() and the skinning throw.
ImportedCharacter character_of(const SceneFile& file, const ImportOptions& options);

/// Holds the nodes of a scene, parents first.
struct NodeList {
  std::vector<Joint> joints;
  std::vector<const aiNode*> nodes;
  std::unordered_map<std::string, std::uint32_t> by_name;  ///< the first of that name
  std::set<std::string> shared_names;                      ///< of more than one node
};

NodeList read_nodes(const SceneFile& file);

/// Notes, once, that several nodes have this name. Bones and clips know their node by its name alone.
void note_if_shared(const NodeList& nodes, const std::string& name, ImportReport& report);

/// Returns a matrix of the file as an affine map.
/// Errors:  throws ImportError naming `what` if the matrix is not finite or not affine.
Affine3 read_matrix(const SceneFile& file, const aiMatrix4x4& matrix, const std::string& what);

/// Returns every joint's transform at rest into the frame of the file.
std::vector<Eigen::Affine3d> rest_to_file(const std::vector<Joint>& joints);

}  // namespace bch::detail::importing
