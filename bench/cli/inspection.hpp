// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/characters/shape_table.hpp"

namespace bch::cli {

/// Holds properties of a hierarchy's cut at one depth.
struct DepthFacts {
  std::uint32_t depth = 0;
  std::size_t discs = 0;
  double mean_radius = 0;  ///< metres
  double area = 0;         ///< of the union of the discs, square metres
};

/// Holds properties of one slab of a body.
struct SlabFacts {
  Heights heights;  ///< metres
  std::size_t contours = 0, nodes = 0, leaves = 0;
  double outline_area = 0, disc_area = 0;  ///< square metres; of the leaves' union
};

/// Returns heights as a text such as "0.40 to 1.00 m".
std::string text_of(const Heights& heights);

/// Describes one shape in detail.
struct ShapeFacts {
  std::optional<std::uint32_t> index;  ///< in the table; none for a free choice of time
  ShapeSource source;
  const Shape& shape;
  double outline_area = 0;
  std::vector<DepthFacts> depths;  ///< 0 to the height; of whole bodies
  std::vector<SlabFacts> slabs;    ///< of bodies that are cut
};

/// Returns the facts of a shape. `planes`: those that cut the body.
ShapeFacts examine(const Shape& shape, const ShapeSource& source, std::optional<std::uint32_t> index,
                   std::span<const float> planes);

/// Returns the number of nodes, of all slabs together.
std::size_t nodes_of(const Shape& shape);

struct ShapeTable {
  std::span<const ShapeSource> sources;
  std::span<const Shape> shapes;
};

std::string text_of(const LoadedCharacter& character);
std::string text_of(const LoadedCharacter& character, const ShapeTable& table);
std::string text_of(const LoadedCharacter& character, const ShapeFacts& facts);

nlohmann::ordered_json json_of(const LoadedCharacter& character);
nlohmann::ordered_json json_of(const LoadedCharacter& character, const ShapeTable& table);
nlohmann::ordered_json json_of(const LoadedCharacter& character, const ShapeFacts& facts);

/// Draws one panel a depth, or of a body in slabs one a slab: the outline filled, the discs over it.
std::string draw_shape(const LoadedCharacter& character, const ShapeFacts& facts);

/// Returns a title: "shape 3: walk at 1.25 s".
std::string shape_title(const LoadedCharacter& character, const ShapeFacts& facts);

/// Returns the slabs of a clip, from the ground up, or the whole body.
std::span<const AnimatedDiscs> slabs_or_whole(const AnimatedDiscs& discs);

/// Holds properties of a clip as moving discs.
struct AnimatedFacts {
  double seconds = 0;
  bool loops = false;
  std::size_t slabs = 0;             ///< 0: the body is whole
  std::size_t chunks = 0, keys = 0;  ///< of all slabs
  std::size_t fewest = 0, most = 0;  ///< discs of a chunk
  double mean = 0;                   ///< discs of a chunk
  std::size_t bytes = 0;             ///< in a baked file
};

AnimatedFacts facts_of(const AnimatedDiscs& discs);

/// Returns "1.20 s, loops, 9 chunks, 112 to 150 discs, 48.1 kB".
std::string text_of(const AnimatedFacts& facts);
nlohmann::ordered_json json_of(const AnimatedFacts& facts);

/// Represents a clip as moving discs, seen at a time.
struct AnimatedView {
  std::string character, clip;
  const AnimatedDiscs& discs;
  double seconds;
  const Shape* body;  ///< of the pose at that time, cut as the discs are; null: unknown
};

/// Represents a slab of a clip at the time of a view, or a body that is whole.
struct AnimatedPart {
  const AnimatedDiscs& discs;
  const AnimatedShape& shape;
  const AnimatedChunk& chunk;  ///< that of the time
  const Outline* outline;      ///< of the pose; null: unknown
  std::string heights;         ///< "0.40 to 1.00 m", "slab 3" where nothing is; empty: the body is whole
};

/// Returns the slabs of a clip, the highest first, as bodies stand, or the whole body. `shape` is that of the view's discs.
std::vector<AnimatedPart> parts_of(const AnimatedView& view, const AnimatedShape& shape);
/// Returns "112 discs in 2 rings".
std::string text_of(const AnimatedChunk& chunk);

std::string text_of(const AnimatedView& view);
nlohmann::ordered_json json_of(const AnimatedView& view);

/// Draws, slab by slab, the discs at the time on the body's outline and, from key to key, the rings and the ways of the discs; what they
/// cover at times all over the clip; and the keys and discs of its chunks along the time.
std::string draw_animated(const AnimatedView& view);

}  // namespace bch::cli
