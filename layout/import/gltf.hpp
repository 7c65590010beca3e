// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include <bch/characters.hpp>

// Private to the importer: a glTF 2 file as a scene of assimp's types. assimp's own reader is not used: 5.2.5 takes
// normalised integers for floats, reads all animations as linear and ignores what a file requires.

namespace bch::detail::importing {

/// Says how the parts of a channel are interpolated, which assimp's type does not hold. Of a cubic part the keys come in
/// threes of the same time: tangent before the key, value, tangent behind it.
struct ChannelInterpolation {
  Interpolation positions = Interpolation::linear;
  Interpolation rotations = Interpolation::linear;
  Interpolation scales = Interpolation::linear;
};

/// Deletes a scene whose nodes nest deeper than a stack is long.
struct SceneDeleter {
  void operator()(aiScene* scene) const;
};

/// Holds the default scene of a glTF file. Names of nodes are unique: a repeated one has the node's index added.
struct GltfScene {
  std::unique_ptr<aiScene, SceneDeleter> scene;
  std::unordered_map<const aiNodeAnim*, ChannelInterpolation> interpolations;  ///< of all channels
  std::vector<std::string> notes;
  std::string posed_morphs;  ///< says where morph targets have weights other than 0; empty: nowhere
};

/// Reads a glTF file.
/// Errors:  throws ImportError.
GltfScene read_gltf(const std::filesystem::path& file);

}  // namespace bch::detail::importing
