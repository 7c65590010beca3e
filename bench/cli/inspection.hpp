// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/files.hpp>

#include "bench/base/options.hpp"
#include "bench/characters/shape_table.hpp"

namespace bch::cli {

/// Holds properties of a hierarchy's cut at one depth.
struct DepthFacts {
  std::uint32_t depth = 0;
  std::size_t discs = 0;
  double mean_radius = 0;  ///< metres
  double area = 0;         ///< of the union of the discs, square metres
};

/// Describes one shape in detail.
struct ShapeFacts {
  std::optional<std::uint32_t> index;  ///< in the table; none for a free choice of time
  PoseId source;
  const Shape& shape;
  double outline_area = 0;
  std::vector<DepthFacts> depths;  ///< 0 to the height
};

/// Returns the facts of a shape.
ShapeFacts examine(const Shape& shape, const PoseId& source, std::optional<std::uint32_t> index);

struct ShapeTable {
  std::span<const PoseId> sources;
  std::span<const Shape> shapes;
};

std::string text_of(const LoadedCharacter& character);
std::string text_of(const LoadedCharacter& character, const ShapeTable& table);
std::string text_of(const LoadedCharacter& character, const ShapeFacts& facts);

nlohmann::ordered_json json_of(const LoadedCharacter& character);
nlohmann::ordered_json json_of(const LoadedCharacter& character, const ShapeTable& table);
nlohmann::ordered_json json_of(const LoadedCharacter& character, const ShapeFacts& facts);

/// Draws one panel a depth: the outline filled, the discs over it.
std::string draw_shape(const LoadedCharacter& character, const ShapeFacts& facts);

/// Returns "walk at 1.25 s", or "rest pose".
std::string pose_title(const LoadedCharacter& character, PoseTime at);
/// Returns a title: "shape 3: walk at 1.25 s".
std::string shape_title(const LoadedCharacter& character, const ShapeFacts& facts);

/// Holds a body of spheres in a pose.
struct BodyFacts {
  PoseId source;
  const BodyModel& model;
  std::vector<Sphere> spheres;
  Heights heights;
  std::size_t bytes = 0;

  std::vector<bool> are_core() const;  ///< which spheres a query tests first
};

BodyFacts examine(const BodyModel& model, const PoseId& source);

std::string text_of(const LoadedCharacter& character, const BodyFacts& facts);
nlohmann::ordered_json json_of(const LoadedCharacter& character, const BodyFacts& facts);

/// Draws the spheres from the side and from above, with the outline of the skin and the bones.
std::string draw_body(const LoadedCharacter& character, const BodyFacts& facts);

/// Holds properties of a clip as moving spheres.
struct AnimatedFacts {
  double seconds = 0;
  bool loops = false;
  std::size_t chunks = 0, keys = 0;
  std::size_t fewest = 0, most = 0;  ///< discs of a chunk
  double mean = 0;                   ///< discs of a chunk
  std::size_t bytes = 0;             ///< in a baked file
};

AnimatedFacts facts_of(const AnimatedDiscs& discs);

/// Returns "1.20 s, loops, 9 chunks, 112 to 150 discs, 48.1 kB".
std::string text_of(const AnimatedFacts& facts);
nlohmann::ordered_json json_of(const AnimatedFacts& facts);

/// Represents a clip as moving spheres, seen at a time.
struct AnimatedView {
  std::string character, clip;
  const AnimatedDiscs& discs;
  double seconds;
  const Outline* outline;  ///< of the pose at that time; null: unknown
};

/// Returns the chunk of a time.
const AnimatedChunk& chunk_at(const AnimatedDiscs& discs, double seconds);

std::string text_of(const AnimatedView& view);
nlohmann::ordered_json json_of(const AnimatedView& view);

/// Draws the discs at the time on the body's outline and, from key to key, the paths of the discs.
std::string draw_animated(const AnimatedView& view);

/// Loads a file that a user named.
/// Errors:  throws BakedFileError; InputError where memory does not suffice.
BakedShapes open_baked(const std::string& file);

/// Loads a file that has to answer in a certain way.
/// Errors:  throws InputError as well where the file has no shapes, or exact leaves are asked for of a set without them.
BakedShapes load_baked_for(const std::string& file, const AnswerOptions& answer);

/// Returns the models of bodies of a baked file.
/// Errors:  throws InputError naming the model that body_model() refuses.
std::vector<BodyModel> models_of(const std::string& file, const BakedShapes& baked);

/// Describes a baked file for people.
/// Errors:  as models_of() throws, here and below.
std::string text_of(const std::string& file, const BakedShapes& baked);
/// Describes what verify() checked, after it found no error.
std::string verified_text(const ShapeSet& set);
/// Lists the shapes of a baked file, one a line.
std::string table_text(const BakedShapes& baked);
/// Describes a baked file and its shapes as JSON.
nlohmann::ordered_json json_of(const std::string& file, const BakedShapes& baked);

/// Returns the name of a clip of a baked file; empty where it has none.
std::string clip_name(const ShapeOrigins& origins, const BakedClip& clip);

}  // namespace bch::cli
