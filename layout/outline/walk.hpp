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

/// Represents a straight piece of a contour. It begins at `begin`, a point of the segment from begin.from to begin.to,
/// and goes along that segment, until the next stretch of the contour begins.
struct Stretch {
  Place begin;
  GridPoint rounded_begin;
};

/// Walks around connected pieces of the union of a pose's triangles, counter-clockwise. It follows the candidates: the
/// edges that may be part of the outline (OutlineCandidates).
///
/// The unbounded face is always to the right. A walk leaves the current stretch where the first candidate sticks out to
/// the right, or at the end of the stretch. Of all candidates at that point it takes the one that turns the farthest
/// to the right. This candidate bounds the unbounded face, too: a ray that begins in the direction straight back and
/// turns counter-clockwise sweeps that face, and this candidate is the first that it meets. A whisker (a part without
/// area) is walked to its tip and back, and a vertex where pieces only touch is passed once for each piece.
///
/// Every walk ends, because candidates cut each other into finitely many directed pieces, and the step from a piece to
/// the next is a one-to-one map of these pieces. So some piece must come again, and the first to do so is the piece
/// where the walk began.
class OutlineWalk {
 public:
  /// `loops` are the functions of one instruction set that compute many elements at once (segment_search.hpp).
  explicit OutlineWalk(const OutlineLoops& loops) : loops_(&loops) {}

  /// Sets the candidates of the following walks. They must not change until the last walk() has returned.
  void begin(const CandidateList& candidates);

  /// Appends the stretches of the contour that begins at `start`, the lexicographically smallest vertex of its
  /// connected piece of the union.
  /// Errors:  throws std::logic_error if the walk is longer than the boundary of any face can be.
  void walk(GridPoint start, std::vector<Stretch>& contour);

  /// Returns whether a contour has passed along a candidate of this component of the mesh (CandidateList::component).
  bool touched(std::uint32_t component) const { return touched_[component] != 0; }

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
  SegmentSearch search_{};      ///< its results are in the arrays above
  std::size_t near_count_ = 0;  ///< candidates that the current stretch may meet
  std::vector<std::uint8_t> touched_;
  SegmentTree tree_;  ///< over the candidates, if they are many
  bool has_tree_ = false;
  double last_length_ = 0;  ///< of the last stretch, if there is a tree: a guess for the next one
};

}  // namespace bch::detail
