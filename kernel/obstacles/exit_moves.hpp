// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "kernel/obstacles/body_query.hpp"
#include "kernel/obstacles/ends_hull.hpp"
#include "layout/format/cut_discs.hpp"

namespace bch::detail {

/// Represents a move of an agent that leaves an obstacle over one segment.
struct ExitMove {
  double depth = 0;
  ObstaclePlace::Vector direction = {0, 0};  ///< in the world
};

/// Finds the moves out of the obstacles that a body touches, and of the areas that contain it.
class ExitMoves {
 public:
  ExitMoves(BodyQuery& query, const PlacedBody& body)
      : query_(query), body_(body), discs_(cut_discs(body.shapes, body.root_index())) {}

  /// Returns the longest of the obstacles' shortest moves.
  ExitMove longest();

 private:
  /// Holds the interval of a segment's line in which discs are considered.
  struct Range {
    double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
  };

  void find_touched(std::span<const LocalSegment> segments);
  bool is_touched(const LocalSegment& segment) const noexcept;
  /// Returns whether all touched segments are points.
  bool is_post() const noexcept;
  /// Returns the move away from a point, in the direction of the disc that overlaps it the deepest.
  ExitMove from_post(const LocalSegment& post) const;
  /// Returns the shortest move out of an obstacle: over a touched segment, or one that has all touched ones behind it.
  ExitMove shortest(std::span<const LocalSegment> segments);
  /// Returns whether all touched segments are behind a segment, seen from its outer side.
  bool has_all_behind(const LocalSegment& segment, int side) const;
  /// Returns the interval of a segment's line onto which the touched segments project.
  Range touched_range(const LocalSegment& segment) const;
  /// Returns the longest of the moves out of areas, each over the area's segment nearest to the body's centre. `areas` ascend.
  ExitMove longest_out_of(std::span<const std::uint32_t> areas);
  ExitMove over(const LocalSegment& segment, Range range) const;
  double depth_towards(int side, const LocalSegment& segment, Range range) const noexcept;
  double with_margin(double depth, const LocalSegment& segment) const noexcept;
  const WorldSegment& in_world(const LocalSegment& segment) const noexcept {
    return query_.obstacles().segments[segment.slot];
  }

  BodyQuery& query_;
  const PlacedBody& body_;
  const CutDiscs discs_;
  std::vector<const LocalSegment*> touched_;
  EndsHull hull_;  ///< of the touched segments
};

}  // namespace bch::detail
