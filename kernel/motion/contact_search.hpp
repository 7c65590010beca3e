// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include "kernel/motion/moving_body.hpp"
#include "kernel/motion/placed_nodes.hpp"
#include "kernel/motion/step_limit.hpp"

namespace bch::detail {

/// Finds the first contact of two motions, for one pair of motions after the other. Keeps its memory in
/// between.
///
/// 1. Time is divided at the keys of both paths. Between two keys, the bounding circles of the bodies overlap
///    during at most one interval, found from a quadratic equation. Only that interval is searched.
/// 2. It is divided into time windows for which clips store hulls (swept 32-DOPs), from long to short ones.
///    If the hulls of a window are separated along a line, the window contains no contact. The shortest window
///    with a hull is one chunk of a clip: a part of the clip in which all discs have the same keys. If its
///    hulls are not separated, it is divided at the keys of both clips.
/// 3. Between two keys of the clips every disc moves along a chord, except for a deviation by rotation. The
///    first time at which two nodes may touch is then the root of a quadratic equation. The trees are
///    descended if that time is before the earliest contact of leaves found so far.
/// 4. If a contact is found and the deviation exceeds half the tolerance, the interval is halved, see
///    first_by_bisection() in placed_nodes.hpp.
///
/// If both bodies are of spheres, steps 3 and 4 are in 3D, and step 1 also requires that their heights
/// overlap. Hulls are compared as seen from above, or for spheres also in bands of height; hulls contain the
/// bodies, so no contact is lost.
///
/// Never late: discs are enlarged by the deviation from chords, and by `slack_`, which bounds the rounding in
/// double. Below, extents are the sum of both bodies' extents, in 3D with their heights.
///     (time)      2^-48 T v. v is the greatest speed of a disc between two keys of the path. T bounds all
///                 numbers that occur when a time of the motion is converted into a time of the clip and a
///                 fraction between keys. The conversion has fewer than 32 roundings.
///     (position)  2^-48 of the coordinates: interpolation between two keys, and their difference
///     (turn)      4e-10 of the extents: cosine and sine of rotation() are off by 2e-10 each
///     (root)      2^-20 of the extents: more than all errors but (time) and (position), see below
///
/// T is the largest time between the keys, plus 2 |clip begin|, plus 3 times the largest time of the clip: in
/// cycle n, times of the clip are shifted by (clip begin) - (time of the clip's first key) + n * length, and
/// n * length exceeds the time since the clip began by at most one length.
///
/// (time) is never taken as more than two other bounds. Keys of the path are exact, so the body's position
/// is off by at most the displacement between two keys. A disc is off, within its body, by at most twice the
/// extent.
///
/// (root): A computed root belongs to a polynomial whose coefficients are off by at most 2^-50 (6 extents)^2
/// = 36 * 2^-50 extents^2, because no disc is placed farther away than the extents. The enlargement adds at
/// least (2^-20 extents)^2 = 2^-40 extents^2 to the polynomial, which is over 28 times that error. So the
/// root is no later than the contact of the original discs. (root) also covers the rounding where hulls are
/// compared along a line (SeparatingLine).
///
/// At the time found, the distance of two discs is at most twice `margin_`, which is the enlargement of both
/// together.
///
/// If two agents stand still and loop clips of the same period, their motion is periodic. Two cycles are then
/// examined, which contain a whole cycle in spite of rounding. StepLimit ends any other search that takes too
/// long.
class ContactSearch {
 public:
  explicit ContactSearch(double tolerance) : tolerance_(tolerance) {}

  /// Returns the time of the first contact in [from, to], or infinity. If a contact is found, a later `to`
  /// gives the same time.
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
  double margin_ = 0;  ///< enlargement of two discs together, in the current interval
  MovingBody* a_ = nullptr;
  MovingBody* b_ = nullptr;
  PlacedNodes nodes_a_, nodes_b_;
  std::vector<Open> open_;
};

}  // namespace bch::detail
