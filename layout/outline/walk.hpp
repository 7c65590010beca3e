// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "layout/outline/candidates.hpp"
#include "layout/outline/grid_geometry.hpp"
#include "layout/outline/segment_tree.hpp"

namespace bch::detail {

/// Represents a straight piece of a contour: it begins at `begin` and goes on in the direction of begin.to, until where
/// the contour's next stretch begins.
struct Stretch {
  Place begin;
  GridPoint rounded_begin;
};

/// Walks around connected pieces of the union, counter-clockwise along the candidates.
///
/// The unbounded face is always to the right. A walk leaves the stretch it is on where the first candidate
/// sticks out to the right, or at the stretch's end; of all candidates there it takes the first one
/// counter-clockwise from where it came, which bounds the same face. A whisker is walked to its tip and back,
/// and a vertex where pieces only touch is passed once for each of them.
///
/// A walk ends: "the next stretch" is a one-to-one map of the finitely many directed pieces into which the
/// candidates cut each other, so the first piece must come again, and it is the first that comes again.
class OutlineWalk {
 public:
  explicit OutlineWalk(const OutlineLoops& loops) : loops_(&loops) {}

  /// Walks along these candidates from now on, which must not change before the last walk().
  void begin(const CandidateList& candidates);

  /// Appends the stretches of the contour through a vertex that is the lexicographically smallest of its
  /// connected piece of the union, starting there.
  /// Errors:  throws std::logic_error should the walk be longer than any face's boundary can be.
  void walk(GridPoint start, std::vector<Stretch>& contour);

  /// Returns whether a contour has come along a candidate of this island.
  bool touched(std::uint32_t island) const { return touched_[island] != 0; }

 private:
  void find_near(const Place& here, GridPoint rounded_here);
  template <class Each>
  void for_each(const std::vector<std::uint64_t>& bits, Each each) const;
  void find_near_piece(const Place& here, double begin, double end);
  bool cross_in_pieces(const Stretch& now, Stretch& next);
  bool take_first_crossing(const Place& here, double limit, Stretch& next);
  void take_first_direction(const Place& here, Stretch& next);
  void touch(std::uint32_t segment);

  const OutlineLoops* loops_;
  const CandidateList* candidates_ = nullptr;
  std::vector<std::uint32_t> near_;
  std::vector<double> side_a_, side_b_, along_, at_;
  std::vector<std::uint64_t> crossing_, ending_;
  SegmentSearch search_{};      ///< with results in the arrays above
  std::size_t near_count_ = 0;  ///< candidates that the current stretch may meet
  std::vector<std::uint8_t> touched_;
  SegmentTree tree_;  ///< over the candidates, where they are many
  bool has_tree_ = false;
  double last_length_ = 0;  ///< of a stretch, where there is a tree: the next one is often about as long
};

}  // namespace bch::detail
