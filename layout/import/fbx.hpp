// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <assimp/scene.h>

#include <deque>
#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

#include "layout/import/fbx_chain.hpp"

// Private to the importer: what assimp 5.2.5 makes of an FBX file, compared with what the file says.

namespace bch::detail::importing {

/// Corrects the scene that assimp has made of an FBX file: transforms of nodes, bones and their weights, and clips. What agrees with
/// the file keeps its bits. Afterwards the names of nodes are unique, and bones and channels name theirs.
/// Returns: notes on what is not read as the file has it.
/// Errors:  throws ImportError where the file has what is not read.
std::vector<std::string> correct_fbx(const std::filesystem::path& file, aiScene& scene);

/// Holds a file's models, each with the node that assimp has made of it.
struct FbxScene {
  FbxDocument document;
  FbxChain chain;
  std::deque<FbxModel> models;  ///< parents first
  std::unordered_map<FbxId, const FbxModel*> by_id;
  std::unordered_map<const FbxModel*, aiNode*> node_of;
  std::vector<std::string> notes;

  /// Errors:  throws ImportError if the nodes are not those of the file.
  FbxScene(const std::filesystem::path& file, const aiScene& scene);

  /// Returns a transform of a node as assimp's type.
  static aiMatrix4x4 matrix_of(const Eigen::Affine3d& map);
  static Eigen::Affine3d map_of(const aiMatrix4x4& matrix);

 private:
  void place_children(const aiNode& node, const FbxModel* parent, std::vector<const FbxModel*>& left);
  FbxModel read_model(FbxId id) const;
};

/// Tells whether two transforms are the same except for rounding: linear parts to a relative tolerance, translations to a fraction of themselves or of one.
bool agree(const Eigen::Affine3d& a, const Eigen::Affine3d& b, double tolerance);

void correct_fbx_meshes(FbxScene& file, aiScene& scene);
void correct_fbx_clips(FbxScene& file, aiScene& scene);

}  // namespace bch::detail::importing
