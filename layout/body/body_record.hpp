// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include <bch/body_set.hpp>

#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Bodies are bounded in bands of height, metres above their own grounds: below the first plane, between the planes, above the last one.
constexpr std::uint32_t body_bands = 3;
constexpr float band_planes[body_bands - 1] = {0.5f, 1.0f};
/// The supports of a band hold what is up to this far below and above it, so that bodies whose grounds differ by no more need only be
/// compared in equal bands.
constexpr float band_overlap = 0.01f;
/// The supports of a band in which a body has nothing. (Not infinite: the product with a weight of 0 has to be a number.)
constexpr float empty_support = -1e30f;

/// Arrays of a record are padded to this many floats, a cache line.
constexpr std::uint32_t record_line = 16;
constexpr std::uint32_t max_spheres = 4096;

/// Begins a record. All bounds are rounded outward; margins for what a query rounds are the query's own.
struct BodyHeader {
  float x, y, radius;  ///< a disc that holds all spheres as seen from above
  float bottom, top;   ///< heights that hold all spheres
  float max_extent;    ///< no point of a sphere is farther from the origin
  std::uint32_t sphere_count;
  std::uint32_t leaf_size;    ///< 4 or 8
  std::uint32_t leaf_count;   ///< leaf i has slots i * leaf_size .. (i + 1) * leaf_size - 1
  std::uint32_t node_stride;  ///< leaf_count, rounded up to whole lines
  float unused[6];
};
static_assert(sizeof(BodyHeader) == record_line * sizeof(float));

// A record, in floats from its beginning: the header; the core spheres, all x, all y, all z, all radii; the supports of the bands (each
// as in supports.hpp); then the leaf nodes: x, y and radius of a disc that holds a leaf's spheres as seen from above, and their bottom
// and top, each an array of node_stride floats, with nodes behind the last leaf that are infinitely far away; then the leaves: x, y, z
// and radii of leaf_size spheres. Slots behind the last sphere repeat it.
constexpr std::uint32_t record_core = record_line;
constexpr std::uint32_t record_supports = record_core + 4 * core_spheres;
constexpr std::uint32_t record_nodes = record_supports + body_bands * support_stride;

/// Returns the header of a record. (Inlined for certain, so that instruction sets share no function.)
[[gnu::always_inline]] inline const BodyHeader& header_of(const float* record) noexcept {
  return *reinterpret_cast<const BodyHeader*>(record);
}

/// Returns the leaf of a record: x, y, z and radii of leaf_size spheres. (Inlined for certain, as above.)
[[gnu::always_inline]] inline const float* leaf_of(const float* record, std::uint32_t leaf) noexcept {
  const BodyHeader& header = header_of(record);
  return record + record_nodes + 5 * header.node_stride + std::size_t{4} * header.leaf_size * leaf;
}

/// Returns the sphere in a slot of a record.
inline Sphere sphere_of(const float* record, std::uint32_t slot) noexcept {
  const std::uint32_t size = header_of(record).leaf_size;
  const float* const x = leaf_of(record, slot / size) + slot % size;
  return {x[0], x[size], x[2 * size], x[3 * size]};
}

/// Holds the records of all bodies as plain pointers: what kernels read. Valid while the set lives.
struct BodySetView {
  ShapeSetView ground;  ///< of roots alone: the discs of the bodies, and their heights
  const float* records;
  const std::uint64_t* record_begin;           ///< per body, floats
  const std::uint32_t* const* sphere_in_slot;  ///< per body, the numbers of its spheres

  /// Returns the record of a body. (Inlined for certain, so that instruction sets share no function.)
  [[gnu::always_inline]] const float* record(std::uint32_t body) const noexcept {
    return records + record_begin[body];
  }
  /// Returns the number of the sphere in a slot of a body.
  [[gnu::always_inline]] std::uint32_t number(std::uint32_t body, std::uint32_t slot) const noexcept {
    const std::uint32_t last = header_of(record(body)).sphere_count - 1;
    return sphere_in_slot[body][slot < last ? slot : last];
  }
};

}  // namespace bch::detail
