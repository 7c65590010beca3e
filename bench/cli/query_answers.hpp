// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <optional>
#include <span>
#include <string>

#include <bch/collide.hpp>
#include <bch/geometry.hpp>
#include <bch/obstacles.hpp>

#include "bench/base/csv_input.hpp"

namespace bch::cli {

/// Holds the input of a query.
struct QueryInput {
  const ShapeSet& set;
  const AgentTable& table;
  std::span<const Pair> pairs;
  QueryOptions options;
  std::uint32_t directions;                ///< of a penetration
  std::optional<Vec2> direction;           ///< of a penetration: the only one
  bool points;                             ///< of a clearance: with point_columns
  const ObstacleSet* obstacles = nullptr;  ///< all agents against these, in place of pairs

  std::size_t size() const { return obstacles == nullptr ? pairs.size() : table.id.size(); }
};

/// Represents one of the questions that --what names.
struct QueryKind {
  const char* name;
  const char* columns;  ///< beside first,second
  const char* help;     ///< what they are, in the words of --help
  /// Returns the answer as CSV, without the header, in the order of the pairs or agents.
  std::string (*rows)(const QueryInput& input);
  bool moving = false;       ///< asks how agents move
  bool of_obstacles = true;  ///< can be asked about obstacles
};

/// More columns of a clearance.
constexpr const char* point_columns = ",first_x,first_y,second_x,second_y";
/// More columns of contacts, of sets of bodies in slabs.
constexpr const char* slab_columns = ",first_slab,second_slab";

/// Returns all kinds of queries; the first is the default.
std::span<const QueryKind> query_kinds();

const QueryKind& query_kind(const std::string& name);

/// Returns the names of the first columns: what an answer is about.
const char* subject_columns(const ObstacleSet* obstacles);

/// Returns the help on all kinds of queries, a line for each.
std::string query_help();

}  // namespace bch::cli
