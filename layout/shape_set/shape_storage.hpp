// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "layout/base/aligned_vector.hpp"
#include "layout/format/shape_arrays.hpp"
#include "layout/shape_set/shape_flattener.hpp"

namespace bch::detail {

/// Holds the extents of the parts of a shape that have no fixed size: how many elements, or where the first one is.
struct ShapeExtent {
  std::size_t nodes = 0;  ///< floats; a shape begins at a multiple of 16, a cache line
  std::size_t rows = 0;   ///< of supports
  std::size_t contours = 0, points = 0;
  std::size_t segments = 0;  ///< of leaf_segments

  friend bool operator==(const ShapeExtent&, const ShapeExtent&) = default;
};

/// Calls visit(part...) for each part, with that of every one of `extents`.
template <class Visit, class... Extents>
void for_each_part(Visit visit, Extents&... extents) {
  visit(extents.nodes...);
  visit(extents.rows...);
  visit(extents.contours...);
  visit(extents.points...);
  visit(extents.segments...);
}

ShapeExtent extent_of(const FlatShape& shape);

/// Returns where the next shape begins.
constexpr std::size_t next_line(std::size_t floats) {
  return (floats + 15) / 16 * 16;
}

/// Holds the arrays of a set, owned.
struct ShapeStorage {
  AlignedVector<std::uint32_t> depths;
  AlignedVector<Root> roots;
  AlignedVector<Tree> trees;
  AlignedVector<float> nodes, reach, support;
  AlignedVector<DiscBlock> inscribed;
  AlignedVector<Profile> profiles;
  AlignedVector<ContourRange> shape_contours;
  AlignedVector<Contour> contours;
  AlignedVector<Vec2> points;
  AlignedVector<std::uint32_t> leaf_segments;
  AlignedVector<float> segment_margin;
  AlignedVector<Heights> heights;

  ShapeArrays arrays() const;

  /// Reserves room for so many shapes of such an extent, of which nothing is written yet.
  void reserve(const ShapeSetPlan& plan, std::size_t shapes, const ShapeExtent& extent);
  /// Makes the arrays with elements of a fixed size large enough for so many shapes, as far as the plan has them.
  void resize(const ShapeSetPlan& plan, std::size_t shapes);
  /// Makes the others end with such an extent behind this place.
  /// Errors:  throws std::length_error beyond 2^31 floats of nodes or 2^32 of the others.
  void allocate(const ShapeExtent& at, const ShapeExtent& size);
  /// Makes the others end at this place at the latest. Allocates nothing.
  void shorten(const ShapeExtent& end) noexcept;
  /// Writes a shape; there has to be room. Of arrays without elements nothing is written. Different shapes may be
  /// written at the same time.
  void store(std::size_t shape, const FlatBody& body, const ShapeExtent& at);

 private:
  void store_level(std::size_t root, const Bvh8& tree, std::size_t node);
  void store_culling(std::size_t shape, const FlatShape& flat, const ShapeExtent& at);
  void store_outline(std::size_t shape, const FlatShape& flat, const ShapeExtent& at);
};

}  // namespace bch::detail
