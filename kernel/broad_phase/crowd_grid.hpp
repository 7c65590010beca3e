// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <bch/agents.hpp>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Holds the extent of the positions of some agents, and the sizes of their root discs.
struct CrowdBounds {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  double min_x = infinity, max_x = -infinity;  ///< of the agents' positions, metres
  double min_y = infinity, max_y = -infinity;
  double offset = 0;  ///< upper bound of the distance from an agent to its root's centre
  double least_radius = infinity, max_radius = 0;  ///< of their root discs, enlarged

  void add(const CrowdBounds& other) noexcept;
};

/// Returns the bounds of agents begin .. end at their levels. `margin`: as in BroadPhase::find().
CrowdBounds bounds(const ShapeSetView& shapes, const Agents& agents, double margin, std::size_t begin,
                   std::size_t end) noexcept;

/// Represents an agent's root disc in units of a grid. The centre is modulo 2^32: in a world of any size,
/// differences below 2^31 units are correct as signed numbers.
struct GridDisc {
  std::uint64_t cell;
  std::uint32_t x, y;
  float radius;  ///< enlarged, see CrowdGrid
  std::uint32_t agent;
};

/// Represents square cells over a crowd, in numbered rows, with a grid for every size class of discs. Class c
/// has a quarter of the cell width of class c - 1. A disc belongs to the class with the smallest cells in
/// which it fits. The centres of two overlapping discs are in the same cell or in neighbouring cells of the
/// larger disc's grid.
///
/// Rounding. A unit is 2^-29 of class 0's cell width; E is the crowd's extent.
///
///     (1) A centre relative to the crowd's corner is off by less than 2^-50 E (rounding) + sqrt(2) units
///         (truncation).
///     (2) The overlap test in float, with rounded radii, is off by less than 2^-21 of the radii.
///     (3) Radii become (1 + 2^-20) (radius + 2^-50 E + 2 units), so no overlap is missed.
///     (4) A cell is wider than its discs by 2^-10 of their diameter, which exceeds (1) to (3): a unit is at
///         most 2^-17 of any cell.
class CrowdGrid {
 public:
  static constexpr std::uint32_t max_classes = 7;

  explicit CrowdGrid(const CrowdBounds& bounds) noexcept;

  /// Writes the discs of agents begin .. end to discs[begin .. end]. `margin`: as for the bounds.
  void place(const ShapeSetView& shapes, const Agents& agents, double margin, std::size_t begin,
             std::size_t end, GridDisc* discs) const noexcept;

  std::uint32_t class_count() const noexcept { return class_count_; }
  /// Returns the end of the cells of a class. Lower cells belong to this class or to classes before it.
  std::uint64_t end_cell(std::uint32_t size_class) const noexcept { return classes_[size_class].end; }
  /// Returns the difference between the numbers of a cell and the cell above it. Neighbours in a row differ
  /// by 1.
  std::uint64_t stride(std::uint32_t size_class) const noexcept { return classes_[size_class].stride; }
  /// Returns the cell of class `to`, coarser than or equal to `from`, that contains a cell of class `from`.
  std::uint64_t coarser(std::uint64_t cell, std::uint32_t from, std::uint32_t to) const noexcept;

 private:
  /// Holds the cells of a size class. Every row and class is surrounded by empty cells, so that neighbouring
  /// numbers never belong to different rows.
  struct Class {
    double max_radius;                 ///< metres
    std::uint64_t first, stride, end;  ///< cells
  };

  double corner_x_, corner_y_;
  double units_;  ///< per metre
  double slack_;  ///< metres
  std::uint32_t class_count_ = 0;
  std::array<Class, max_classes> classes_;
};

}  // namespace bch::detail
