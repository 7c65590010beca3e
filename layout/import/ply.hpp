// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <filesystem>
#include <memory>

#include "layout/import/gltf.hpp"

// Private to the importer: a PLY file as a scene of assimp's types. assimp's own reader is not used: 5.2.5 takes the data of a
// binary file to begin behind all line feeds, ends an element at a comment, and makes one triangle of a strip.

namespace bch::detail::importing {

/// Returns whether a file begins as PLY does.
bool is_ply(const std::filesystem::path& file);

/// Reads a PLY file: its vertices, faces and strips of triangles, in text and both binary orders.
/// Errors:  throws ImportError.
std::unique_ptr<aiScene, SceneDeleter> read_ply(const std::filesystem::path& file);

}  // namespace bch::detail::importing
