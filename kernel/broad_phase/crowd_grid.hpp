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

/// Holds the extent of the positions of some agents, and the sizes of their roots.
struct CrowdBounds {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  double min_x = infinity, max_x = -infinity;  ///< of the agents' positions, metres
  double min_y = infinity, max_y = -infinity;
  double offset = 0;                               ///< no root's centre is farther from its agent
  double least_radius = infinity, max_radius = 0;  ///< of their root discs, enlarged

  void add(const CrowdBounds& other) noexcept;
};

/// Returns the bounds of agents begin .. end at their levels. `margin`: as in BroadPhase::find().
CrowdBounds bounds(const ShapeSetView& shapes, const Agents& agents, double margin, std::size_t begin,
                   std::size_t end) noexcept;

/// Represents an agent's root disc in units of a grid. The centre is modulo 2^32: differences below 2^31 units are right
/// as signed numbers, however large the world.
struct GridDisc {
  std::uint64_t cell;
  std::uint32_t x, y;
  float radius;  ///< enlarged, see CrowdGrid
  std::uint32_t agent;
};

/// Represents square cells over a crowd, in numbered rows, once for every class of sizes: class c has a
/// quarter of the cell width of class c - 1, and the smallest such cells that a disc of the class fits in.
/// The centres of two discs that overlap are in one cell, or in neighbouring ones, of the grid of the larger
/// disc.
///
/// Rounding. A unit is 2^-29 of class 0's cell. With E the crowd's extent, a centre relative to the crowd's
/// corner is off by less than 2^-50 E from rounding and by sqrt(2) units from dropping their fractions; the
/// overlap test in float, radii's rounding included, by less than 2^-21 of them. So radii become
/// (1 + 2^-20) (radius + 2^-50 E + 2 units), and no overlap is missed. A cell's width exceeds the diameter of
/// its discs by 2^-10, which is more than all that: a unit is at most 2^-17 of any class's cell.
class CrowdGrid {
 public:
  static constexpr std::uint32_t max_classes = 7;

  explicit CrowdGrid(const CrowdBounds& bounds) noexcept;

  /// Writes the discs of agents begin .. end to discs[begin .. end]. `margin`: as for the bounds.
  void place(const ShapeSetView& shapes, const Agents& agents, double margin, std::size_t begin,
             std::size_t end, GridDisc* discs) const noexcept;

  std::uint32_t class_count() const noexcept { return class_count_; }
  /// Returns the end of the cells of a class: all of its cells are below, and so are those of the classes
  /// before it.
  std::uint64_t end_cell(std::uint32_t size_class) const noexcept { return classes_[size_class].end; }
  /// Returns the difference from a cell to the one above it. The cells beside a cell have the numbers next to
  /// its own.
  std::uint64_t stride(std::uint32_t size_class) const noexcept { return classes_[size_class].stride; }
  /// Returns the cell of a coarser class, or of the same, that a cell is a part of.
  std::uint64_t coarser(std::uint64_t cell, std::uint32_t from, std::uint32_t to) const noexcept;

 private:
  /// Holds the cells of a class of sizes. There are empty cells about every row and class, so that no cell
  /// has another row's beside it.
  struct Class {
    double max_radius;                 ///< metres
    std::uint64_t first, stride, end;  ///< cells
  };

  double corner_x_, corner_y_;
  double units_;  ///< a metre
  double slack_;  ///< metres
  std::uint32_t class_count_ = 0;
  std::array<Class, max_classes> classes_;
};

}  // namespace bch::detail
