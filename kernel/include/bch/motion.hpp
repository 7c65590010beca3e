// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <bch/body_set.hpp>
#include <bch/query.hpp>

namespace bch {

/// Places a motion at a time: a key of its path. Between two keys, position and heading are linear in time; the turn is
/// the difference of the headings, even if that is the long way round.
struct PathKey {
  double time, x, y, heading;  ///< seconds; metres in the world; radians
  double z = 0;  ///< metres: the height of the agent's ground, which counts between bodies of spheres
};

/// Describes an agent who goes along a path and plays a clip. Before the first key of the path, and after the last one, the agent stands
/// at that key.
struct Motion {
  const AnimatedShape* shape;
  std::span<const PathKey> path;  ///< at least one key, ascending
  double clip_begin =
      0;  ///< the time at which the clip begins; a clip that does not loop stands still before its beginning and after its end
};

/// Limits the times at which motions are examined; both ends are included.
struct TimeInterval {
  double from, to;
};

/// Finds when the two motions of each pair first touch: the earliest time of an interval at which their solids overlap (see
/// AnimatedShape), or infinity if there is none. Paths, turning and discs are taken at every real time, not sampled. Two bodies of spheres
/// meet in space, and stand at the heights of their paths; where one is of discs, both count as seen from above.
///
/// The time is never later than the first contact. At that time the solids are apart by at most the tolerance, 2 um per
/// metre of both reaches, 1e-14 of the positions, and 1e-14 V T. V is the speed of the path plus the greatest speed of
/// the clip's discs. T is the time of the next path key (after the last one: 1e6 s) + 2 |clip_begin| + 3 times the clip's latest time. The
/// tolerance is a distance: the time is early by at most the tolerance over the speed at which the solids come together. By default that is
/// 5 ms at 1 m a second, and a quarter of a second at 0.02 m a second. The time is finite where the solids only pass each other that
/// closely. Times are the same bits on every processor, for any number of threads, any split of the batch and exchanged motions. A later
/// end of the interval changes no time.
///
/// Units:   seconds within +-1e6, metres within +-1e9, headings within +-1e9 rad, a turn of at most 1e3 rad from key to key.
/// Sizes:   as many times as pairs, which name motions by index. A motion may be paired with itself.
/// Errors:  throws std::invalid_argument, before anything is written, on sizes that differ, an index out of range, an interval that ends
///          before it begins or is not within these units, a tolerance below 1e-6 m; naming the motion and key, on a shape or a path that
///          is missing, keys that do not ascend or are not within these units; and,
///          naming the pair, on a search of more than 1e8 steps, most of them from key to key of clips within reach.
/// Threads: runs in the caller's TBB arena. Allocates for the motions and for each task.
/// Cost:    grows with the keys of the paths and, while two bodies are within reach of each other, with the cycles of clips that loop. For
///          bodies at rest, of which both loop with the same period or one does not move, only two cycles are searched.
void first_contact(std::span<const Motion> motions, std::span<const Pair> pairs, const TimeInterval& interval,
                   std::span<double> times, double tolerance = 0.005);

/// Returns the time until which a motion touches none of the others: the least time that first_contact() finds for it and each of
/// them, with the motion as the one with the lower index. It is infinity if there is no contact.
/// Cost:    after an early contact, the other motions are examined only until then.
/// Errors:  as first_contact(); messages number the motion itself after the others.
/// Threads: uses one thread; several threads may call it at once.
double free_until(const Motion& motion, std::span<const Motion> others, const TimeInterval& interval,
                  double tolerance = 0.005);

}  // namespace bch
