// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bch/body_set.hpp>
#include <bch/query.hpp>

namespace bch {

/// Tests whether the two agents of each pair collide at their levels, touching included, and writes 1 for a hit and 0 otherwise.
///
/// A collision is never missed: agents whose outlines meet collide at every level. Agents that do not collide at one level do
/// not collide at a deeper one either. A false positive has a gap of at most the sizes of two discs and 4 um per metre of the two
/// shapes' reaches; between exact leaves, of at most 1.7 um per metre. The answer is the same bits on every processor, for any
/// number of threads, any split of the batch and either order within a pair. Only the difference of positions counts, so
/// answers far from the origin are the same as at the origin.
///
/// Agents at different heights (Agents::z) collide where their heights meet, too.
/// Meshes that have a point in common are hits in either case. The exception is lone triangles that are points on the grid of
/// OutlineBuilder, because outlines leave them out.
///
/// Options: leaves, implementation.
/// Sizes:   hits.size() == pairs.size(); an agent may be paired with itself (it collides).
/// Errors:  throws std::invalid_argument, before hits is touched, on sizes that differ, an index out of
///          range, a position or heading that is not finite or beyond the limits, unknown leaves, or an implementation that
///          this processor does not run. The message names the agent or pair and the value. Agents that no pair names are not checked.
/// Threads: runs in the caller's TBB arena, isolated from the cancellation of the caller's task group. Queries do not depend on
///          the threads' rounding mode, treatment of denormals and traps, and leave them as they are.
void collide(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
             std::span<std::uint8_t> hits, const QueryOptions& options = {});

/// Tests whether the bodies of the two agents of each pair have a point in common in space, touching included, and writes 1 for a hit and
/// 0 otherwise: whether some sphere of one overlaps some sphere of the other. What spheres hold never meets without a hit; a false
/// positive has a gap of at most 4 um per metre of the two bodies' reaches, beside what spheres stand out. The answer is the same bits
/// on every processor, for any number of threads, any split of the batch and either order within a pair.
/// Levels:  bodies have one, so agents have none or 0 for all.
/// Sizes, errors, threads: as for collide() of a ShapeSet. `implementation` is as in QueryOptions.
void collide(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
             std::span<std::uint8_t> hits, const Implementation* implementation = nullptr);

}  // namespace bch
