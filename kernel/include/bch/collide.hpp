// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

#include <bch/query.hpp>

namespace bch {

/// Answers each pair: 1 where the two agents collide at their levels, touching included, else 0.
///
/// A collision is never missed. Agents whose outlines meet collide at every level, and those that do not
/// collide at one level do not at a deeper one either. A false positive has a gap
/// of at most the sizes of two discs and 4 um per metre of the two shapes' reaches; between exact leaves, of at most 1.7 um
/// per metre. The answer is the same bits on every
/// processor, for any number of threads, any split of the batch and either order within a pair. Only the
/// difference of positions counts: far from the origin the answer is that of the same placement at the
/// origin.
///
/// Bodies in slabs (ShapeSetPlan::slices) collide where two of their slabs do, solid, whatever `semantics` says: inside a body
/// crossing outlines alone mean nothing. Agents at different heights (Agents::z) collide where parts of them do whose heights
/// meet. Meshes that have a point in common are hits in either case.
///
/// Options: semantics, leaves, implementation.
/// Sizes:   hits.size() == pairs.size(); an agent may be paired with itself (it collides).
/// Errors:  throws std::invalid_argument, before hits is touched, on sizes that differ, an index out of
///          range, a position or heading that is not finite or beyond the limits, unknown semantics or leaves, solid
///          semantics on a set that was not planned for it, an implementation that this processor does not
///          run; the message names the agent or pair and the value. Agents that no pair names are not checked.
/// Threads: runs in the caller's TBB arena. The rounding mode, treatment of denormals and traps that threads are set to
///          do not matter to any query, and stay as they are. An exception or cancellation of tasks beside it does not
///          touch it.
void collide(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
             std::span<std::uint8_t> hits, const QueryOptions& options = {});

}  // namespace bch
