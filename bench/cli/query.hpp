// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <bch/body_set.hpp>
#include <bch/geometry.hpp>
#include <bch/obstacles.hpp>
#include <bch/query.hpp>

#include "bench/base/csv_input.hpp"
#include "bench/base/exit_codes.hpp"
#include "bench/base/options.hpp"
#include "bench/characters/body_models.hpp"
#include "kernel/broad_phase/pair_limit.hpp"
#include "kernel/runtime/all_options.hpp"

namespace bch::cli {

/// Refers to what agents have: shapes, or bodies of spheres.
using AnySet = std::variant<const ShapeSet*, const BodySet*>;

/// Holds the input of a query.
struct QueryInput {
  AnySet set;
  const AgentTable& table;
  std::span<const Pair> pairs;
  detail::AllOptions options;
  std::uint32_t directions;                ///< of a penetration
  std::optional<Vec2> direction;           ///< of a penetration: the only one
  bool points;                             ///< of a clearance: with point_columns
  const ObstacleSet* obstacles = nullptr;  ///< all agents against these, in place of pairs

  std::size_t size() const { return obstacles == nullptr ? pairs.size() : table.id.size(); }
};

/// Represents one of the questions that --what names.
struct QueryKind {
  const char* name;
  const char* columns;  ///< after first,second
  const char* help;     ///< what they are, in the words of --help
  /// Returns the answer as CSV, without the header, in the order of the pairs or agents.
  std::string (*rows)(const QueryInput& input);
  const char* sphere_columns;         ///< of bodies of spheres
  bool moving = false;                ///< asks how agents move
  bool of_obstacles = true;           ///< can be asked about obstacles
  bool spheres_of_obstacles = false;  ///< and so of bodies of spheres
};

/// More columns of a clearance.
constexpr const char* point_columns = ",first_x,first_y,second_x,second_y";
constexpr const char* sphere_point_columns = ",first_x,first_y,first_z,second_x,second_y,second_z";

/// Returns all kinds of queries; the first is the default.
std::span<const QueryKind> query_kinds();

const QueryKind& query_kind(const std::string& name);

/// Returns the names of the first columns: what an answer is about.
const char* subject_columns(const ObstacleSet* obstacles);

/// Returns the help on all kinds of queries, a line for each.
std::string query_help();

/// Returns all pairs that collide or, with a finite max_distance, are within it, in the order of the agents' lines. `what`: "within" counts
/// as that query does, also who stands inside whom; else distances count alone.
/// Errors:  throws std::length_error where there are more pairs of neighbours than `most`.
std::vector<Pair> all_pairs(const AnySet& set, const AgentTable& table, const std::string& what,
                            const detail::AllOptions& options, std::size_t most);

/// Holds the options of a command that takes obstacles.
struct ObstacleOptions {
  std::string file, heights;  ///< empty: no obstacles; infinite
  bool walkable = false;

  void add_to(CLI::App& command, const char* help);
  /// Errors:  throws UsageError.
  void require_fitting(const CLI::App& command) const;
  /// Errors:  throws InputError.
  std::optional<ObstacleSet> read() const;
};

/// Calls find(most), by which so many pairs of neighbours are found; 0: what is usual for the agents of a file.
/// Errors:  throws InputError where there are more, which find() says by std::length_error.
template <class Find>
auto within_limit(std::size_t most, const std::string& file, const AgentTable& table, const Find& find) {
  if (most == 0) most = detail::usual_max_pairs(table.id.size());
  try {
    return find(most);
  } catch (const std::length_error&) {
    throw InputError(fmt::format(
        "{}: more than {} pairs of agents are near each other; --max-pairs raises the limit", file, most));
  }
}

/// Renumbers the agents' shapes to those in use. Returns: where these come from; no other is built.
std::vector<PoseId> keep_used(std::span<const PoseId> sources, AgentTable& table);

/// Holds what the command line of bch query says.
struct QueryCommandOptions {
  std::string character, agents, pairs;
  ObstacleOptions obstacles;
  bool all_pairs = false, guard_ids = false;
  std::string what = query_kinds().front().name;
  std::uint32_t directions = 16;
  std::string direction;  ///< empty: the best of many
  double max_distance = HUGE_VAL;
  std::size_t max_pairs = 0;  ///< of neighbours, for all_pairs; 0: what is usual
  std::string overlap = "zero";
  bool points = false;
  BodyKind kind;
  ShapeOptions shapes;
  AnswerOptions answer;

  /// Errors:  throws UsageError.
  std::optional<Vec2> only_direction() const;
  /// Returns whether the heights of bodies count.
  bool compares_heights(const AgentTable& table) const {
    return !table.z.empty() || !obstacles.heights.empty();
  }
};

/// Refuses options that do not go together.
/// Errors:  throws UsageError.
void require_fitting(const CLI::App& command, const QueryCommandOptions& options);

}  // namespace bch::cli
