// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <span>

#include <bch/query.hpp>

namespace bch {

/// The displacement of the first agent of each pair relative to the second: its own displacement less the
/// other's. Neither agent turns.
/// Units:   metres in the world; each within +-1e9.
struct Displacements {
  std::span<const double> x, y;
};

/// Finds when the two agents of each pair first touch while they move without turning: the least t in [0, 1] at which
/// discs of their cuts touch when the first agent has moved by t times its displacement, or infinity.
///
/// The discs of the cuts alone count, not the nodes above them: whether these overlap changes on the way, and
/// a time has to be no later than the outlines' contact. The time is 0 where discs of the cuts overlap already,
/// also where the agents move apart. A displacement that is zero as a float gives 0 only where collide() with
/// Leaves::discs and boundary semantics answers 1, and infinity otherwise. The time is never later than the
/// outlines' first contact. At that time the outlines are at most the leaf discs' sizes and 4 um per metre of way and of
/// the two shapes' reach apart. So it may be early, or finite where the outlines only pass each other within that distance. The same bits on
/// every processor, for any number of threads and any split of the batch, and for exchanged agents with the
/// displacement negated. Solid semantics would add nothing: an agent that is inside has crossed the outline
/// before, unless it starts there.
///
/// Bodies in slabs, or at different heights, touch when the first parts do that may meet; and at 0 where bodies in slabs collide
/// now, in solid semantics with Leaves::discs.
///
/// Options: implementation.
/// Sizes:   as many displacements in x, in y, and times as pairs. An agent may be paired with itself (0).
/// Errors:  throws std::invalid_argument, before anything is written, as collide() does, and on a
///          displacement that is not finite or beyond the limits.
/// Threads: runs in the caller's TBB arena. Allocates nothing, but for bodies in slabs or at different heights.
/// Source:  the slide of the paper's experiment, which the paper makes in small steps.
void time_of_impact(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                    const Displacements& displacements, std::span<float> times,
                    const QueryOptions& options = {});

}  // namespace bch
