// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include "kernel/motion/moving_body.hpp"
#include "kernel/motion/placed_nodes.hpp"
#include "kernel/motion/step_limit.hpp"
#include "kernel/motion/still_segment.hpp"
#include "kernel/obstacles/near_segments.hpp"

namespace bch::detail {

/// Finds the first contacts of motions with obstacles, motion after motion, and keeps its memory meanwhile: as ContactSearch does with two
/// motions, of which one is the segments that are near.
///
/// A path is cut into stretches no longer than twice the reach; the segments within reach of one are found by the tree of boxes. Discs are enlarged by
/// the deviation from a chord by rotation and by `slack_`, which has what ContactSearch derives, for one body, with the reach twice: no node is
/// farther than three reaches from where a stretch begins, and no end of a segment that it touches farther than another one. Coordinates of a segment
/// that is long or far are off by 2^-48 of these at most: StaticSegment::slack. Twice that is at most 1.8e-14 of the distances to both its
/// ends together, as OutlineSegment derives for half of it.
///
/// An area holds a disc wholly or not at all as long as no disc touches a segment. Whether it does can change only in the beginning and
/// where a chunk begins, and is asked then. An area without a segment within reach holds the body if it holds the body's position.
class ObstacleSearch {
 public:
  ObstacleSearch(const Implementation& implementation, const ObstacleView& obstacles,
                 double tolerance) noexcept
      : near_(implementation, obstacles), tolerance_(tolerance) {}

  /// Returns the first contact of a body from one time to another, or infinity. Contacts up to `to` do not depend on it.
  /// Errors:  throws StepLimit::Reached.
  double first(const MotionFacts& motion, double from, double to);

 private:
  double first_on_path(double from, double end, double to);
  double first_near(double from, double end, double to);
  double first_between(double from, double end);
  double first_of_nodes();
  bool find_near(double from, double end);
  void place(double from, double end);
  void open(std::uint32_t node, std::uint32_t segment, double last);
  bool is_inside_at_chunk_begin(double time);
  bool is_in_area(double x, double y);

  struct Open {
    std::uint32_t node, segment;
    double time;
  };

  NearSegments near_;
  double tolerance_;
  StepLimit limit_;
  double reach_ = 0, slack_ = 0;
  double margin_ = 0;  ///< what discs are enlarged by in an interval
  MovingBody* body_ = nullptr;
  std::uint32_t chunks_tested_ = 0;  ///< chunks that had begun
  PlacedNodes nodes_;
  std::vector<WorldSegment> found_;      ///< near the stretch
  std::vector<StaticSegment> segments_;  ///< the same, in the interval
  std::vector<Open> open_;
};

}  // namespace bch::detail
