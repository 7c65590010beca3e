// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include "kernel/motion/moving_body.hpp"
#include "kernel/motion/placed_nodes.hpp"
#include "kernel/motion/step_limit.hpp"

namespace bch::detail {

/// Finds the first contacts of two motions, pair after pair, and keeps its memory meanwhile.
///
/// Time is cut where a path has a key. Between two keys of the paths bodies come as near as their reaches for an interval at most, which a
/// square root tells; there alone the clips are gone through, from window to window of their hulls: where these are apart along a line
/// there is no contact, and else shorter windows are examined, in the end those between two keys of the clips. From key to key every disc
/// moves straight on except for the deviation from a chord by rotation, so that the first time at which two nodes may touch is a root, too, and the trees are
/// descended where there is one before the earliest contact of leaves so far. What deviates more than half the tolerance is halved in time,
/// but only where a contact is found.
///
/// Where both bodies are of spheres, these are tested in 3D, and only while their heights allow it. What else is known
/// of bodies, reaches and hulls, is seen from above, which misses nothing. The reaches below are then those on the
/// ground and in height together.
///
/// Never late: discs are enlarged by what their paths may deviate from chords, and by `slack_`, which holds what double rounds:
///
///     (time)      2^-48 of the times at the greatest speed of any disc between two keys of the path: a time of the motion becomes one
///                 of the clip and fractions of intervals, and these a time, by fewer than 32 roundings. No number there is larger than
///                 the largest time between the keys, twice that at which the clip begins and three times the clip's own ones:
///                 a round is moved by (begin of the clip) - (own begin) + n (length), where n (length) is no more than a
///                 length beyond the time since the clip began. Keys of the path are exact, so that no speed counts beyond them, and
///                 no more than the displacement between them; nor does a disc move by more than twice the reach
///     (position)  2^-48 of the coordinates: blends of two keys, and their difference
///     (turn)      4e-10 of the reaches: rotation()
///     (root)      2^-20 of the reaches, which is more than all but (time) and (position), and than sums along a line: a
///                 computed root is that of a polynomial whose coefficients are off by 2^-50 of (6 reaches)^2 at most, because
///                 nothing is placed that is farther away than the reaches. The square of what discs are enlarged by is 32
///                 times as much, so that it is no later than
///                 where the discs themselves touch.
///
/// At the time that is found, two discs are at most twice as far apart as both were enlarged.
///
/// Where both stand and repeat themselves together, nothing changes after a round of theirs; two are examined, which hold one whatever
/// rounds. What else goes on for too long is given up: StepLimit.
class ContactSearch {
 public:
  explicit ContactSearch(double tolerance) : tolerance_(tolerance) {}

  /// Returns the first contact from one time to another, or infinity. Contacts up to `to` do not depend on it.
  /// Errors:  throws StepLimit::Reached.
  double first(const MotionFacts& a, const MotionFacts& b, double from, double to);

 private:
  double end_of_two_cycles(double time, double until);
  double first_near(double from, double end, double to, unsigned level);
  bool hulls_are_apart(double from, double end, unsigned level) const;
  double first_between(double from, double end);
  double first_of_nodes();
  void place(double from, double end);
  template <class Make>
  void open_children(PlacedNodes& nodes, std::uint32_t node, const MovingDisc& other, double last, Make make);

  struct Open {
    std::uint32_t i, j;
    double time;
  };

  double tolerance_;
  StepLimit limit_;
  bool in_space_ = false;  ///< whether both bodies are of spheres
  double slack_ = 0;
  double margin_ = 0;  ///< what two discs are enlarged by in an interval
  MovingBody* a_ = nullptr;
  MovingBody* b_ = nullptr;
  PlacedNodes nodes_a_, nodes_b_;
  std::vector<Open> open_;
};

}  // namespace bch::detail
