// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/ratios/suite.hpp"

namespace bch::bench {

constexpr float leaf_threshold = 0.01f;  ///< metres, of the hierarchies that tables build

/// Judges a ratio: "PASS", or by how much it misses what it needs: "needs 20: 19 % short".
std::string verdict(double ratio, double needed);
/// Judges a value that must not exceed `most`: "PASS", or "at most 1.5: 8 % over".
std::string verdict_at_most(double value, double most);

/// Represents a part of what is printed: benchmarks that are timed together, and what is told of them.
struct Table {
  std::string name;
  std::string benchmarks;  ///< a regular expression of their names
  std::function<void(const Results&)> print;
};

/// The following functions add benchmarks and return the tables of them. The scene must outlive the suite.

/// Adds the benchmarks `collide/<workload>/<semantics>/<leaves>/<instruction set>[/threads:<n>]` and
/// `collide/<workload>/boundary/<kind>`: collide(), and structures of others.
std::vector<Table> collide_tables(Suite& suite, Scene& scene);
/// Adds the benchmarks `threads/<n>` and `batches/<size>`: one query of many pairs, and queries of a few.
std::vector<Table> call_tables(Suite& suite, Scene& scene);
/// Adds the benchmarks `crowd/<agents>/<what>`: pairs and answers of whole crowds.
std::vector<Table> crowd_tables(Suite& suite, Scene& scene);
/// Adds the benchmarks `<query>/<workload>/<instruction set|reference>[/threads:<n>]`: the queries beside
/// collide().
std::vector<Table> query_tables(Suite& suite, Scene& scene);
/// Adds the benchmarks `obstacles/<query>`: a crowd on a floor plan.
std::vector<Table> obstacle_tables(Suite& suite, Scene& scene);
/// Adds the benchmarks `motions/<first_contact|sampled>/<free|touching>` and `motions/bytes`: people who
/// walk, as animated shapes.
std::vector<Table> motion_tables(Suite& suite, Scene& scene);
/// Adds the benchmarks `bodies/<find_all|loop>`: a crowd of bodies of discs.
std::vector<Table> body_tables(Suite& suite);
/// Adds the benchmarks `shapes/<count>`: a crowd of so many different shapes, up to `most`.
std::vector<Table> shape_count_tables(Suite& suite, Scene& scene, std::uint32_t most);
/// Adds the benchmarks `plans/<row>/<bake|query>`: sets by different plans.
std::vector<Table> plan_tables(Suite& suite, Scene& scene);
/// Adds the benchmarks `slices/<row>/<workload>/<leaves>` and `slices/<row>/build`: bodies in slabs.
std::vector<Table> slice_tables(Suite& suite, Scene& scene);
/// Adds the benchmarks `construction/<character>/<instruction set>/<stage>` of the characters, and
/// `growth/<triangles>/<stage>` of the built-in man with fewer and with more triangles.
std::vector<Table> build_tables(Suite& suite, Scene& scene);
/// Adds the benchmarks `load/<part>`: a baked file of the scene's poses, in the file cache.
std::vector<Table> load_tables(Suite& suite, Scene& scene);
/// Adds the benchmarks `check/<crowd>/<frames>[/threads:<n>]`: whole recordings, in memory.
std::vector<Table> check_tables(Suite& suite, Scene& scene);
/// Adds the benchmarks `moments/<poses|shown|grid|own>`: a crowd of animated shapes at times of a walk.
std::vector<Table> moment_tables(Suite& suite, Scene& scene);

/// Returns the name of a benchmark of collide().
std::string collide_name(std::string_view workload, const QueryOptions& query,
                         std::string_view implementation);
/// Returns the numbers of threads to measure with: powers of two, and all of the machine's.
std::vector<int> thread_counts();
/// Returns a name as a benchmark's that is timed by so many threads.
std::string with_threads(const std::string& name, int threads);
/// Returns the name of the instruction set that every processor of this kind has.
std::string base_implementation();
/// Returns the names of the instruction sets that run here and are wider than one lane.
std::vector<std::string> wide_implementations();

}  // namespace bch::bench
