// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
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
/// the two shapes' reach apart. So it may be early, or finite where the outlines only pass each other within that distance. Times are the same bits on
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

/// The shapes of bodies that move by themselves, at the times that agents show them, for all queries. A moment, that is, a body at a
/// time of its clip, is made once for all agents that show it, and stays as long as its place is not needed for another one. Moments
/// are cheap where agents share them, on a grid of times for instance. Keeps its memory: where calls have shown as many moments and
/// bodies have been as large before, a call allocates nothing. One that was moved from can only be assigned to or destroyed.
///
///     MomentSet moments(bodies);
///     moments.show(body, seconds, shape);                      // agents' bodies and times, and the shapes that they get
///     collide(moments.set(), {shape, x, y, heading}, pairs, hits);
class MomentSet {
 public:
  /// Takes bodies, which have to outlive this, and the plan of set(), which has places for `kept` moments, or for as many as a call shows:
  /// those of before are found again.
  /// Errors:  throws std::invalid_argument on none, naming it on a null pointer and on a body that is cut at other planes than the
  ///          plan's, and on a bad plan.
  explicit MomentSet(std::span<const AnimatedShape* const> bodies, const ShapeSetPlan& plan = {},
                     std::size_t kept = 1000);
  MomentSet(MomentSet&&) noexcept;
  MomentSet& operator=(MomentSet&&) noexcept;
  ~MomentSet();

  /// Makes each moment that agents show and that is not there yet, in parallel, and writes the shape of each agent: Agents::shape for
  /// set(). It shows what AnimatedShape::shape() is at these seconds: every query answers the same. (Candidate pairs are those of the root
  /// discs, which may be others.)
  /// Units:   seconds of the clip, within +-1e6, as AnimatedShape::shape() has them.
  /// Sizes:   as many seconds, and shapes, as bodies, which are indices into those of the constructor.
  /// Errors:  throws std::invalid_argument, before anything is written, on sizes that differ and, naming the agent, on an index out of
  ///          range or a time that is not within these units.
  /// Threads: runs in the caller's TBB arena. For one thread at a time, while no query runs.
  /// Cost:    30 us for each new moment of 125 discs, 2 us where the plan has the level of all depths alone, without culling data, outlines
  ///          and slices; and 10 ns for each agent.
  void show(std::span<const std::uint32_t> bodies, std::span<const double> seconds,
            std::span<std::uint32_t> shapes);

  /// Returns the set that the written shapes are of; void after the next show().
  const ShapeSet& set() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A key of a path says where a motion is at a time. Between two keys it goes straight on and turns evenly: by the difference of their
/// headings, the long way round, too.
struct PathKey {
  double time, x, y, heading;  ///< seconds, metres in the world, radians
};

/// An agent who goes along a path and plays a clip. Before the first key of the path, and after the last one, the agent stands there.
struct Motion {
  const AnimatedShape* shape;
  std::span<const PathKey> path;  ///< at least one key, ascending
  double clip_begin =
      0;  ///< the time at which the clip is at its beginning; one that does not loop stands still before and after it
};

/// Times that motions are looked at, both included.
struct TimeInterval {
  double from, to;
};

/// Finds when two motions first touch: the earliest time of an interval at which their solids overlap (see AnimatedShape), infinity where
/// they do not. Paths, turning and discs are as they are at every real time, not sampled. Bodies in slabs touch when the first of their slabs do;
/// one that is whole is in every slab that its heights reach.
///
/// The time is never later than the first contact. At that time the solids are at most the tolerance apart, and 2 um for each metre of
/// both reaches and what double rounds of positions and times, below 1e-14 of these (of times at the greatest speed). So it is early
/// by at most the tolerance over the speed at which they come together, and finite where they only pass by that closely. Times are the same bits on
/// every processor, for any number of threads, any split of the batch and exchanged motions; a later end of the interval changes no time.
///
/// Units:   seconds within +-1e6, metres within +-1e9, headings within +-1e9 rad, a turn of at most 1e3 rad from key to key.
/// Sizes:   as many times as pairs, which name motions by index. A motion may be paired with itself.
/// Errors:  throws std::invalid_argument, before anything is written, on sizes that differ, an index out of range, an interval that ends
///          before it begins or is not within these units, a tolerance below 1e-6 m, and, naming the motion and key, on a shape or a path that is
///          missing, keys that do not ascend or are not within these units; naming the pair, on bodies that are cut at different planes.
/// Threads: runs in the caller's TBB arena. Allocates for the motions and for each task.
void first_contact(std::span<const Motion> motions, std::span<const Pair> pairs, const TimeInterval& interval,
                   std::span<double> times, double tolerance = 0.005);

/// Returns until when a motion has contact with none of others: the least of what first_contact() says of it, with the lower index, and
/// each of them.
/// Cost:    pairs behind one that touches early are looked at until then alone.
/// Errors:  as first_contact(); the motion itself is named as the one behind the others.
/// Threads: one; several may ask at once.
double free_until(const Motion& motion, std::span<const Motion> others, const TimeInterval& interval,
                  double tolerance = 0.005);

}  // namespace bch
