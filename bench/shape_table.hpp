// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/characters.hpp"
#include "layout/shape_set.hpp"

namespace bch::cli {

/// Where a shape comes from. Its index in the table is the number by which files and tables name it.
struct ShapeSource {
  std::uint32_t character = 0;
  PoseTime at;
};

/// The poses of all characters, one character after the other, as every command numbers them.
std::vector<ShapeSource> list_shapes(std::span<const LoadedCharacter> characters, std::uint32_t poses);

/// "walk", or "rest pose".
std::string clip_name(const LoadedCharacter& character, PoseTime at);

struct BuiltShapes {
  std::vector<Shape> shapes;     ///< one a source
  double outline_seconds = 0;    ///< the mean of a shape, one thread: skinning and outline
  double hierarchy_seconds = 0;  ///< likewise: the hierarchy
};

/// Builds contour hierarchies, in parallel, with a progress bar.
/// Errors:  throws InputError naming the character, clip and time of a pose that has no outline.
BuiltShapes build_shapes(std::span<const LoadedCharacter> characters, std::span<const ShapeSource> sources,
                         double threshold);

}  // namespace bch::cli
