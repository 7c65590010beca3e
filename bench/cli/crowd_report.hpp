// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bench/characters/shape_table.hpp"
#include "bench/cli/crowd_answers.hpp"
#include "bench/cli/options.hpp"

namespace bch::cli {

struct CrowdOptions {
  std::vector<std::string> characters{"default:male", "default:female"};
  ShapeOptions shapes;
  AnswerOptions answer;
  std::uint32_t agents = 10000;
  double density = 3;
  std::uint64_t seed = 1;
  std::string json, csv, svg;
  std::string svg_depth;
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
/// Lists the colliding pairs at the finest level as CSV.
std::string csv_report(const CrowdRun& run);

}  // namespace bch::cli
