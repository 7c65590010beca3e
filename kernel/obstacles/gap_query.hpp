// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include <bch/pairs.hpp>

#include "kernel/obstacles/body_query.hpp"
#include "layout/base/rounding.hpp"

namespace bch::detail {

/// Holds the nearest obstacle of an agent so far.
struct NearestObstacle {
  double gap;  ///< metres; of nothing found, the limit
  /// Name what is nearest of the agent: a segment of its outline by the point where it begins, or no_point and a disc of its cut.
  std::uint32_t point = no_point, disc = 0;
  std::uint32_t root = 0;  ///< of the agent's level
  LocalSegment segment = {};
  ObstaclePlace place = {};
  bool is_found = false, is_near_enough = false;
};

/// Writes what is asked for of an agent's nearest obstacle.
void store(const ShapeSetView& shapes, const ClearanceAnswers& answers, std::size_t i,
           const NearestObstacle& nearest);

/// Measures the distances of agents from obstacles: what clearance() and within() share.
class GapQuery {
 public:
  /// Takes what is measured. With `exact_leaves` that is outlines where shapes have exact leaves, else discs.
  GapQuery(const Implementation& implementation, const ShapeSetView& shapes, bool exact_leaves) noexcept
      : implementation_(implementation), shapes_(shapes), exact_leaves_(exact_leaves) {}

  /// Finds the least gap of at most `limit`, metres. The search ends where one is at most `enough` or, where `inside`
  /// counts, an area holds the agent or its outline a path.
  NearestObstacle find(BodyQuery& query, std::uint32_t agent, double limit, double enough, bool inside) const;

 private:
  /// Finds what is nearer than the best of a body beyond the distance at which prepare() looked.
  void search_outward(BodyQuery& query, const PlacedBody& body, double enough, ObstacleGap& best,
                      NearestObstacle& nearest) const;
  void search(const PlacedBody& body, std::span<const LocalSegment> segments, double enough,
              ObstacleGap& best, NearestObstacle& nearest) const;

  const Implementation& implementation_;
  const ShapeSetView& shapes_;
  const bool exact_leaves_;
};

}  // namespace bch::detail
