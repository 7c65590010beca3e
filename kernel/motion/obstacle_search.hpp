// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <vector>

#include "kernel/motion/moving_body.hpp"
#include "kernel/motion/placed_nodes.hpp"
#include "kernel/motion/static_segment.hpp"
#include "kernel/motion/step_limit.hpp"
#include "kernel/obstacles/near_segments.hpp"

namespace bch::detail {

/// Finds the first contact of a motion with obstacles, for one motion after the other. Keeps its memory in
/// between. Works like ContactSearch; nearby segments replace the second body.
///
/// A path is divided into parts no longer than twice the extent; the tree of boxes finds the segments within
/// extent of a part. Discs are enlarged by the deviation from chords by rotation, and by `slack_`: the errors
/// that ContactSearch derives, for one body and with twice the extent. Twice is needed because nodes are
/// within three extents of where the part begins, and the ends of segments that they touch within one more.
/// Coordinates of a long or far segment are off by 2^-48 of themselves at most (StaticSegment::slack). Twice
/// that is at most 1.8e-14 of the sum of the distances to both its ends; OutlineSegment derives half of that.
///
/// As long as no disc touches a segment, a polygon contains a disc wholly or not at all. That can change only
/// at the beginning and where a chunk begins, and is tested there. A polygon without a segment within reach
/// contains the body if it contains the body's position.
class ObstacleSearch {
 public:
  ObstacleSearch(const Implementation& implementation, const ObstacleView& obstacles,
                 double tolerance) noexcept
      : near_(implementation, obstacles), tolerance_(tolerance) {}

  /// Returns the time of the first contact in [from, to], or infinity. `to` does not change earlier contacts.
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
  double max_extent_ = 0, slack_ = 0;
  double margin_ = 0;  ///< enlargement of a disc in the current interval
  MovingBody* body_ = nullptr;
  std::uint32_t chunks_tested_ = 0;  ///< chunks begun at the last test of polygons
  PlacedNodes nodes_;
  std::vector<WorldSegment> found_;      ///< near the part of the path
  std::vector<StaticSegment> segments_;  ///< the same, relative to the interval's first position
  std::vector<Open> open_;
};

}  // namespace bch::detail
