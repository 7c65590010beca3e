// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <bch/geometry.hpp>

namespace bch::detail {

/// Holds what a person looks like in a pose: metres, in the frame of the shape, whose origin is the person's
/// place.
struct PageShape {
  std::string name;
  std::vector<std::vector<Vec2>> contours;
  std::vector<Disc> discs = {};  ///< those of a level, which the page shows on demand; may be empty
};

/// Represents a point of an outline: millimetres in the shape's frame.
struct ShapePoint {
  std::int16_t x = 0;
  std::int16_t y = 0;
  friend bool operator==(const ShapePoint&, const ShapePoint&) = default;
};

/// How far, in millimetres, an outline of the page may lie from the one that was given.
inline constexpr double outline_tolerance = 2.5;

/// Returns a closed contour with as few of its points as describe it within outline_tolerance, rounded to millimetres.
/// Source:  D. Douglas, T. Peucker, "Algorithms for the reduction of the number of points required to represent a
///          digitized line or its caricature", Cartographica 10, 1973.
std::vector<ShapePoint> simplified(const std::vector<Vec2>& contour);

/// Holds the shapes of a page, in the order in which they were added.
class PageShapes {
 public:
  void add(const PageShape& shape);
  std::size_t size() const { return names_.size(); }
  const std::vector<std::string>& names() const { return names_; }

  /// Returns about how many characters blocks() and the names take.
  std::size_t block_size() const;
  std::string blocks() const;

 private:
  std::vector<std::string> names_;
  std::size_t name_bytes_ = 0;
  std::vector<std::uint32_t> contours_begin_{0}, points_begin_{0}, discs_begin_{0};
  std::vector<ShapePoint> points_;
  std::vector<std::int16_t> discs_;  ///< x, y, radius in millimetres
};

}  // namespace bch::detail
