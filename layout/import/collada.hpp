// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <string>

// Private to the importer: what assimp 5.2.5 does not know of Collada. It takes all keys for linear, and the joints of a skin for the
// first nodes of their names.

namespace bch::detail::importing {

/// Returns the text of a Collada file as assimp reads it rightly: curves as lines, joints by the ids of their nodes. An empty one for
/// other files, and where nothing needs to be changed.
/// Errors:  throws ImportError where the file has what is not read.
std::string rewritten_collada(const std::filesystem::path& file);

/// Makes jumps of the short ramps in which rewritten_collada() writes them.
void restore_jumps(aiScene& scene);

}  // namespace bch::detail::importing
