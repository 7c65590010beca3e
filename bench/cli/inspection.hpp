// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <nlohmann/json.hpp>
#include <optional>
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

}  // namespace bch::cli
