// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "layout/base/aligned_vector.hpp"
#include "layout/format/shape_arrays.hpp"
#include "layout/shape_set/shape_flattener.hpp"

namespace bch::detail {

/// Holds, for each part of a shape without a fixed size, a number of elements or the position of the first element.
struct ShapeExtent {
  std::size_t nodes = 0;  ///< floats; a shape begins at a multiple of 16, a cache line
  std::size_t rows = 0;   ///< of supports
  std::size_t contours = 0, points = 0;
  std::size_t segments = 0;  ///< of leaf_segments

  friend bool operator==(const ShapeExtent&, const ShapeExtent&) = default;
};

/// Calls visit(part...) for each part, with the same part of all `extents`.
template <class Visit, class... Extents>
void for_each_part(Visit visit, Extents&... extents) {
  visit(extents.nodes...);
  visit(extents.rows...);
  visit(extents.contours...);
  visit(extents.points...);
  visit(extents.segments...);
}

ShapeExtent extent_of(const FlatShape& shape);

/// Returns the position of the next shape's nodes, on a cache line.
constexpr std::size_t next_line(std::size_t floats) {
  return (floats + 15) / 16 * 16;
}

/// Owns the arrays of a set.
struct ShapeStorage {
  AlignedVector<std::uint32_t> depths;
  AlignedVector<Root> roots;
  AlignedVector<Tree> trees;
  AlignedVector<float> nodes, max_extent, support;
  AlignedVector<DiscBlock> inscribed;
  AlignedVector<Profile> profiles;
  AlignedVector<ContourRange> shape_contours;
  AlignedVector<Contour> contours;
  AlignedVector<Vec2> points;
  AlignedVector<std::uint32_t> leaf_segments;
  AlignedVector<float> segment_margin;
  AlignedVector<Heights> heights;

  ShapeArrays arrays() const;

  /// Reserves memory for `shapes` shapes of an extent, and writes nothing.
  void reserve(const ShapeSetPlan& plan, std::size_t shapes, const ShapeExtent& extent);
  /// Resizes the arrays that have a fixed number of elements per shape and that the plan has.
  void resize(const ShapeSetPlan& plan, std::size_t shapes);
  /// Resizes the other arrays so that a part of size `size` fits at `at`.
  /// Errors:  throws std::length_error beyond 2^31 floats of nodes or 2^32 elements of another array.
  void allocate(const ShapeExtent& at, const ShapeExtent& size);
  /// Shortens the other arrays to end at `end` at the latest. Allocates nothing.
  void shorten(const ShapeExtent& end) noexcept;
  /// Writes a shape into allocated places, except into arrays without elements. Threads may write different shapes at
  /// the same time.
  void store(std::size_t shape, const FlatBody& body, const ShapeExtent& at);

 private:
  void store_level(std::size_t root, const Bvh8& tree, std::size_t node);
  void store_culling(std::size_t shape, const FlatShape& flat, const ShapeExtent& at);
  void store_outline(std::size_t shape, const FlatShape& flat, const ShapeExtent& at);
};

}  // namespace bch::detail
