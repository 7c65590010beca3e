// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "kernel/runtime/implementation.hpp"
#include "layout/base/disc.hpp"
#include "layout/format/agents.hpp"
#include "layout/shape_set/shape_set.hpp"

namespace bch {

struct ClearanceOptions {
  /// The largest distance of interest in metres, not negative; may be infinite. Pairs farther apart get an
  /// infinite distance and nothing else. The smaller the limit, the sooner they are rejected.
  double max_distance = std::numeric_limits<double>::infinity();
  /// The implementation to use, as in QueryOptions.
  const kernel::Implementation* implementation = nullptr;
};

/// The nearest discs of the two cuts: indices into cut(hierarchy, depth) of each agent's shape and level.
struct ClosestDiscs {
  std::uint32_t first, second;
  friend bool operator==(const ClosestDiscs&, const ClosestDiscs&) = default;
};
constexpr ClosestDiscs no_cut_nodes{0xffffffff, 0xffffffff};

/// The output arrays of clearance(). Empty directions and nodes are not computed, which saves time.
struct ClearanceAnswers {
  std::span<float> distance;           ///< metres; infinite beyond max_distance
  std::span<Vec2> direction = {};      ///< unit vectors; (0, 0) beyond max_distance
  std::span<ClosestDiscs> nodes = {};  ///< no_cut_nodes beyond max_distance
};

/// How far apart two agents are: for each pair the least gap between a disc of one's cut and a disc of the
/// other's; negative where discs overlap, then the deepest overlap of two of them. With it the unit vector in
/// the world from the first agent's nearest disc to the second's: moving the second agent along it, or the
/// first one against it, widens that gap the fastest. Where the two centres coincide, (1, 0) from the agent
/// with the lower index to the other.
///
/// Never larger than the distance of the outlines: an outline that crosses another has a clearance of at most
/// 0. Below it by no more than r_A + r_B + (r_A^2 + r_B^2) / 2 D, with r the radii of the nearest discs and D
/// = distance + r_A + r_B (below 3 cm for leaf discs of 1 cm), and 4 um per metre of the two shapes' reach
/// and of D. The discs of the cuts alone count, not the nodes above them, so that a distance is one of two
/// discs. Where collide() says 1 in boundary semantics, the distance is at most 0; where the distance is
/// positive, it says 0. It may say 0 where discs overlap and nodes above them do not: a distance below 0 is
/// no collision yet. The same bits on every processor, for any number of threads and any split of the batch;
/// exchanging the agents of a pair exchanges the nodes and negates the direction. Of gaps that are equal, the
/// one with the first disc of the agent with the lower index counts, then that with the first disc of the
/// other.
///
/// Shapes:  as many distances as pairs, directions and nodes as many or none. An agent may be paired with
///          itself.
/// Errors:  throws std::invalid_argument, before anything is written, as collide() does, and on a
///          max_distance that is negative or NaN.
/// Threads: runs in the caller's TBB arena. Allocates nothing.
void clearance(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
               const ClearanceAnswers& answers, const ClearanceOptions& options = {});

}  // namespace bch
