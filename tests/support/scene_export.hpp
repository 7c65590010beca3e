// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <filesystem>

#include <bch/character.hpp>

namespace bch {

/// Writes a character through assimp, in the format of the file's extension: glb, gltf or dae.
/// Frame:   metres, y up. Limits: joints need names of their own; glTF keeps four weights a vertex, Collada
///          one clip. assimp 5.2 writes no FBX that it reads back: binary files break off, text files lose
///          their bind matrices.
/// Errors:  throws std::runtime_error on another extension, or with assimp's reason.
void write_with_assimp(const Character& character, const std::filesystem::path& file);

}  // namespace bch
