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

/// Returns the number of the leaf of a tree, `root`, that holds a segment of an outline, named by the point where it begins: the one whose disc is
/// nearest to (x, y), of equally near ones the first.
std::uint32_t leaf_containing(const ShapeSetView& shapes, std::size_t root, std::uint32_t point, double x,
                              double y);

/// Holds what a kernel found of two agents, and all outputs of it. What is computed here is so in double, where squares do not underflow,
/// and from the positions themselves.
class PlacedFeatures {
 public:
  /// Takes the pair, the lower index first. Everything has to outlive this.
  PlacedFeatures(const ShapeSetView& shapes, const Agents& agents, Pair pair,
                 const NearestFeatures& nearest) noexcept
      : shapes_(shapes), agents_(agents), pair_(pair), nearest_(nearest) {}

  const NearestFeatures& nearest() const noexcept { return nearest_; }

  /// Returns the numbers of the discs in the cuts. Of segments: of the leaves that hold them, those whose discs are nearest to points();
  /// of equally near ones the first.
  DiscPair numbers() const;

  /// Returns the unit vector from one feature to the other, or with a sign of -1 that from the second to the first; (sign, 0)
  /// where centres of discs coincide.
  Vec2 direction(double sign) const;

  /// Returns the points that are nearest to each other.
  NearestPoints points() const;

 private:
  struct Disc {
    double x, y, radius;
  };
  /// Represents a segment of an agent, in its frame, and the parameter t at which it is nearest to the other one.
  struct Segment {
    PlanePoint from, edge;
    double t;
    PlanePoint nearest() const noexcept { return from + t * edge; }
  };
  struct Segments {
    Segment a, b;
    PlanePoint between;  ///< from one nearest point to the other, in the world's axes
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
