// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <bch/characters.hpp>
#include <bch/shapes.hpp>

#include "bench/characters/crowd.hpp"

namespace bch::bench {

/// Returns the character with every triangle cut into four at the middles of its edges, `times` times. A
/// middle moves with the bones of both ends.
Character finer(const Character& character, int times);

/// Returns the character refined as by finer(), with relief as cloth and muscles have it at every size. Each
/// middle stands out of its edge, or into it, by up to an eighth of the edge's length along the surface's
/// normal. The result is the same for a character everywhere.
Character with_relief(const Character& character, int times);

using Hits = std::vector<std::uint8_t>;

/// Holds agents, and the pairs of them that a benchmark asks for.
struct Workload {
  std::string name;
  cli::Crowd crowd;
  std::vector<Pair> pairs;

  Agents agents() const { return crowd.agents(); }
};

struct WorkloadSizes {
  std::uint32_t pairs = 20'000;   ///< of all but the crowd, whose pairs are those of the broad phase
  std::uint32_t agents = 10'000;  ///< of the crowd
};

void add_agent(cli::Crowd& crowd, std::uint32_t shape, double x, double y, double heading);

/// Returns the names of the workloads, in the order of reports:
///   colliding     distinct pairs whose meshes intersect
///   near_miss     distinct pairs whose root discs overlap while the meshes do not intersect
///   no_hit        distinct pairs whose root discs overlap while their contour hierarchies do not collide
///   crowd         the broad phase's pairs of a crowd at 3 agents per square metre
///   candidates    those of the same crowd with a margin of 0.5 m
///   paper500      the paper's protocol: 500 colliding cases in sequence, over and over
///   paper500_cached  the same cases, each repeated before the next: the paper shows that order and leaves it out of its
///                    results
/// The last two are small enough for the processor to learn every branch. They serve for comparison with the
/// paper, not for judging performance.
std::span<const std::string_view> workload_names();

/// Draws pairs with agents of their own, shapes and headings at random. The second root disc's centre is
/// anywhere in the disc about the first one's centre in which the two overlap. Only pairs that are wanted are
/// kept. The result is the same for the same shapes and seed everywhere.
/// Errors:  throws std::runtime_error naming the workload once a million pairs in a row were not wanted.
Workload random_pairs(std::string_view name, std::uint64_t seed, std::span<const Shape> shapes,
                      std::uint32_t pairs, const std::function<bool(const Agents&, Pair)>& wanted);

/// The density and the seed of the crowd, and of others that are measured with it.
constexpr double agents_per_square_metre = 3;
constexpr std::uint64_t crowd_seed = 34;

constexpr double clearance_limit =
    0.5;  ///< metres: of clearances that are asked for, and the candidates' margin

/// Returns the crowd, or with a margin the candidates.
Workload crowd_pairs(const ShapeSet& set, std::uint32_t agents, double margin = 0);

/// Returns a workload of the same pairs on stairs that lead up along x: each step is 17 cm high and 30 cm deep.
Workload on_stairs(Workload workload);

/// Repeats the first `cases` pairs of a workload, `pairs` in all. Cached: each case over and over, then the
/// next; else the cases in sequence, over and over.
Workload repeated(std::string_view name, const Workload& from, std::uint32_t cases, std::uint32_t pairs,
                  bool cached);

}  // namespace bch::bench
