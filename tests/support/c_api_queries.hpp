// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/c_api.hpp"

// Every query of the C interface once, for all tests that ask them all.

namespace bch::test {

/// A crowd among walls for the C interface, and what is asked about it.
struct CScene {
  CScene(const ShapeSet& of, Crowd people, std::vector<Pair> asked);

  const ShapeSet& shapes;
  const OwnedSet set;
  const Crowd crowd;
  const bch_agents agents;
  const std::vector<Pair> pairs;
  const std::vector<double> x, y;    ///< of each pair, metres, and of each agent
  const std::vector<double> nearer;  ///< a distance for each
  const std::vector<bch_vec2> along;
  const OwnedObstacles walls;
  bch_query_options options = BCH_QUERY_OPTIONS_INIT;
};
constexpr const char* walls_text =
    "LINESTRING(-40 0, 40 1) POLYGON((-2 -2, 2 -2, 2 2, -2 2)) LINESTRING(9 -40, 9 40)";

/// A query with arrays, or an object, of its own. It asks without allocating memory itself.
struct CQuery {
  std::string name;
  bool needs_memory;  ///< at every call
  std::function<bch_status()> run_query;
  std::function<std::string()> answers;  ///< what has been written, as bytes
};
std::vector<CQuery> all_queries(const CScene& scene);

}  // namespace bch::test
