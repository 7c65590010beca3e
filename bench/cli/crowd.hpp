// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include <bch/bodies.hpp>
#include <bch/body_set.hpp>
#include <bch/crowd.hpp>
#include <bch/pairs.hpp>

#include "bench/base/options.hpp"
#include "bench/characters/crowd.hpp"
#include "bench/characters/shape_table.hpp"
#include "kernel/runtime/all_options.hpp"

namespace bch::cli {

/// Holds the answers for all pairs at one level of detail.
struct LevelAnswers {
  std::uint32_t depth = 0;
  double discs = 0;  ///< of a shape, mean
  std::vector<std::uint8_t> hits;
  std::uint64_t hit_count = 0;
  std::uint64_t cleared = 0;        ///< pairs that the single cylinder hits and this level does not
  double nanoseconds_per_pair = 0;  ///< median of the runs
  std::uint32_t runs = 0;
};

struct CrowdAnswers {
  std::vector<Pair> pairs;           ///< every pair that can collide at any level, sorted
  std::vector<LevelAnswers> levels;  ///< as in the shape set

  const LevelAnswers& finest() const { return levels.back(); }
};

/// Answers all candidates at every level, one batch call a level, and takes the time of it.
/// Precondition: level 0 of the set is depth 0.
CrowdAnswers answer_crowd(const ShapeSet& set, const Crowd& crowd, const detail::AllOptions& options);

struct CrowdOptions {
  std::vector<std::string> characters{"default:male", "default:female"};
  ShapeOptions shapes;
  AnswerOptions answer;
  std::uint32_t agents = 10000;
  double density = 3;
  std::uint64_t seed = 1;
  std::string json, csv, svg;
  std::string svg_depth;
  bool live = false;  ///< bodies of spheres, posed anew in every frame
  std::uint32_t frames = 20, spheres = 256;
};

/// Holds everything that a run of `bch crowd` knows in the end.
struct CrowdRun {
  const CrowdOptions& options;
  std::span<const LoadedCharacter> characters;  ///< none: the shapes were baked
  double threshold;                             ///< of all hierarchies, metres
  const BuiltShapes& built;                     ///< empty likewise
  const ShapeSet& set;
  const Crowd& crowd;
  const CrowdAnswers& answers;
  const char* implementation;
  unsigned threads;
};

std::string text_report(const CrowdRun& run);
nlohmann::ordered_json json_report(const CrowdRun& run);

/// Returns the colliding pairs at the finest level.
std::vector<Pair> hits_of(const CrowdAnswers& answers);
/// Lists pairs as CSV.
std::string csv_of(std::span<const Pair> pairs);
/// Orders pairs by their first, then their second agents.
bool before(Pair a, Pair b);
std::vector<Pair> sorted(const bch::Crowd::Pairs& found);
/// Names characters, with their numbers of triangles.
std::string names_of(std::span<const LoadedCharacter> characters);
/// Says how many agents stand where.
std::string agents_text(const CrowdOptions& options, const Crowd& crowd);

/// Holds what a picture shows of a body, in the frame of its agent.
struct DrawnBody {
  Outline outline;
  Disc cylinder;              ///< around all of it
  std::vector<Sphere> parts;  ///< spheres, or discs, which are at height 0
};

struct CrowdPicture {
  const Crowd& crowd;
  double density = 0;
  double reach = 0;  ///< of no body is a point farther from its agent, metres
  std::function<DrawnBody(std::uint32_t agent)> body = {};
  std::vector<Pair> cleared = {};    ///< only their cylinders overlap
  std::vector<Pair> colliding = {};  ///< their parts do
  DrawnBody key = {};                ///< stands for all of them in the legend
  std::string title = {};
  std::string parts_are = {};      ///< a sentence of the caption
  std::string part_name = "disc";  ///< or "sphere"
};

/// Returns what is drawn of a crowd of shapes: the cuts and the answers at a level. Refers to all that it is made of.
CrowdPicture picture_of(std::span<const Shape> shapes, const Crowd& crowd, const CrowdAnswers& answers,
                        std::uint32_t level, double density);

/// Draws the middle of the crowd from above as SVG: outlines filled, parts over them. Colours show whether an
/// agent collides, only its cylinder does, or neither. They differ in lightness as much as in hue, so
/// that they can be distinguished with colour blindness and in grey print.
std::string draw_crowd(const CrowdPicture& picture);

/// Holds the milliseconds that frames took.
struct FrameTimes {
  std::vector<double> posing, queries;

  std::vector<double> whole() const;
};

/// Holds everything that a run of `bch crowd --live` knows in the end. Pairs are those of the last frame, sorted.
struct LiveRun {
  const CrowdOptions& options;
  std::span<const LoadedCharacter> characters;
  const WalkingCrowd& crowd;
  const LiveBodies& bodies;
  FrameTimes times;
  std::vector<Pair> candidates, collisions;
  std::size_t checked;  ///< candidates that were compared with brute force
  const char* implementation;
  unsigned threads;
};

/// Poses all agents anew and finds who collides, frame after frame; the first one is not timed. Writes and prints what is asked for.
/// Errors:  throws std::logic_error where answers differ from those of brute force.
void run_live_crowd(const CrowdOptions& options);

std::string text_report(const LiveRun& run);
nlohmann::ordered_json json_report(const LiveRun& run);

}  // namespace bch::cli
