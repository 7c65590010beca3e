// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include <bch/pairs.hpp>

#include "kernel/distance/clearance_arguments.hpp"
#include "layout/base/plane_point.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Returns the number of the leaf of tree `root` that contains the segment whose first point has the index `point`. Of
/// several such leaves, it is the one whose disc is nearest to (x, y), and of equally near ones the first.
std::uint32_t leaf_containing(const ShapeSetView& shapes, std::size_t root, std::uint32_t point, double x,
                              double y);

/// Computes the outputs of a clearance from the nearest features (discs or segments) that a kernel found for
/// two agents. It computes them from the agents' positions, in double, so that squares do not underflow.
class PlacedFeatures {
 public:
  /// `pair`: the lower index first. Keeps references to all arguments.
  PlacedFeatures(const ShapeSetView& shapes, const Agents& agents, Pair pair,
                 const NearestFeatures& nearest) noexcept
      : shapes_(shapes), agents_(agents), pair_(pair), nearest_(nearest) {}

  const NearestFeatures& nearest() const noexcept { return nearest_; }

  /// Returns the numbers of the nearest discs, each counted in its agent's cut: the discs of its tree at the
  /// agent's level. For segments, returns the numbers of the leaves that contain them. If several leaves contain a
  /// segment, leaf_containing() chooses the one nearest to the segment's point in points().
  DiscPair numbers() const;

  /// Returns sign (1 or -1) times the unit vector from the first feature to the second. Returns (sign, 0) if the
  /// features are discs with the same centre.
  Vec2 direction(double sign) const;

  /// Returns the nearest points of the two features.
  NearestPoints points() const;

 private:
  struct Disc {
    double x, y, radius;
  };
  /// Represents a segment of an agent, in the agent's frame, and the parameter t of its point nearest to the
  /// other segment.
  struct Segment {
    PlanePoint from, edge;
    double t;
    PlanePoint nearest() const noexcept { return from + t * edge; }
  };
  struct Segments {
    Segment a, b;
    PlanePoint between;  ///< from a's nearest point to b's, in the world's axes
  };

  std::size_t root(std::uint32_t agent) const noexcept { return agents_.root(agent, shapes_.level_count); }
  Disc disc(std::uint32_t agent, std::uint32_t place) const noexcept;
  PlanePoint between() const;
  PlanePoint along(double sign) const;
  Segment segment(std::uint32_t point) const noexcept;
  Segments segments() const;
  Vec2 end(std::uint32_t agent, std::uint32_t place, PlanePoint unit) const;

  const ShapeSetView& shapes_;
  const Agents& agents_;
  const Pair pair_;
  const NearestFeatures& nearest_;
};

}  // namespace bch::detail
