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

/// Holds a key of a motion's path: where the agent is at a time.
/// Between two keys, position and heading are linear in time; the rotation is the difference of the headings,
/// even if that is more than half a circle.
struct PathKey {
  double time, x, y, heading;  ///< seconds; metres in the world; radians
  double z = 0;  ///< metres: the height of the agent's ground, considered only between bodies of spheres
};

/// Describes an agent who goes along a path and plays a clip.
/// Before the first key of the path the agent stands at the first key, and after the last one at the last.
struct Motion {
  const AnimatedShape* shape;
  std::span<const PathKey> path;  ///< at least one key, ascending
  /// The time at which the clip begins.
  /// A clip that does not loop stands still before its beginning and after its end.
  double clip_begin = 0;
};

/// Limits the times at which motions are examined; both ends are included.
struct TimeInterval {
  double from, to;
};

/// Finds when the two motions of each pair first touch, or infinity if they do not within the interval.
/// Every real time is considered, not only samples. The time is never late. It is early by at most tolerance
/// / (speed of approach), with the tolerance in metres. See "Motions" in kernel/accuracy.md.
/// Sizes:   `times` is as long as `pairs`, which are indices of motions. A motion paired with itself has the
///          time interval.from.
/// Errors:  throws std::invalid_argument, before anything is written, on sizes that differ, on a value that
///          is missing or out of range, which the message names, and on a search of more than 1e8 steps.
/// Threads: runs in the caller's TBB arena. Allocates for the motions and for each task.
void first_contact(std::span<const Motion> motions, std::span<const Pair> pairs, const TimeInterval& interval,
                   std::span<double> times, double tolerance = 0.005);

/// Returns the time until which a motion touches none of the others, or infinity.
/// It is the least time that first_contact() finds for the pairs (motion, other). Once a contact is found,
/// the remaining motions are examined only up to the time of that contact.
/// Errors:  as first_contact(); in messages, `motion` has the index others.size().
/// Threads: uses one thread; several threads may call it at once.
double free_until(const Motion& motion, std::span<const Motion> others, const TimeInterval& interval,
                  double tolerance = 0.005);

}  // namespace bch
