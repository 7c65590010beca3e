// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "layout/format/shape_arrays.hpp"
#include "layout/format/shape_preconditions.hpp"

/// Contains the checks behind shape_preconditions(), and what the checks share. Each check throws
/// std::invalid_argument that names the array, the place in it and the value.
namespace bch::detail::shape_checks {

// These functions check the whole set: array_checks.cpp.
void alignment(const ShapeArrays& a);
void depths(const ShapeArrays& a);
void sizes(const ShapeArrays& a);
void heights(const ShapeArrays& a);
void rows(const ShapeArrays& a);
void single_depth(const ShapeArrays& a);
void infinite_rows(const ShapeArrays& a);
void max_extents(const ShapeArrays& a);
void roots(const ShapeArrays& a);
void supports(const ShapeArrays& a);
void inscribed(const ShapeArrays& a);
void profiles(const ShapeArrays& a);
void shape_contours(const ShapeArrays& a);
void contour_points(const ShapeArrays& a);
void points(const ShapeArrays& a);
void segment_margins(const ShapeArrays& a);
void contour_discs(const ShapeArrays& a);

// These functions check a level: level_checks.cpp.
void order_of_levels(const ShapeArrays& a, LevelNodes& level);
void blocks(const ShapeArrays& a, LevelNodes& level);
void disc_extent(const ShapeArrays& a, LevelNodes& level);
void leaf_blocks(const ShapeArrays& a, LevelNodes& level);
void first_leaf_block(const ShapeArrays& a, LevelNodes& level);
void number_of_leaf_blocks(const ShapeArrays& a, LevelNodes& level);
void padding(const ShapeArrays& a, LevelNodes& level);
void numbers(const ShapeArrays& a, LevelNodes& level);
void single_discs(const ShapeArrays& a, LevelNodes& level);
void extent_of_level(const ShapeArrays& a, LevelNodes& level);
void segments_of_leaves(const ShapeArrays& a, LevelNodes& level);

// These functions check the inner nodes of a level: inner_node_checks.cpp.
void inner_nodes(const ShapeArrays& a, LevelNodes& level);
void nodes_of_blocks(const ShapeArrays& a, LevelNodes& level);
void outer_radii(const ShapeArrays& a, LevelNodes& level);

/// The limit of coordinates, radii and supports, metres: a few times the largest extent, because supports and outer
/// radii exceed the extent.
constexpr float largest_length = 1e7f;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::uint32_t top_bit = 0x80000000;

[[noreturn]] void reject(const char* array, std::size_t place, const std::string& what);
void require_size(const char* array, std::uint64_t size, std::uint64_t expected);

/// Sets the top bit of the result for floats whose magnitude is above a positive limit; negative_or_beyond() also for
/// negative floats. Plain integer operations let loops over many floats vectorise; NaN is above every limit.
inline std::uint32_t beyond(float value, float limit) {
  return std::bit_cast<std::uint32_t>(limit) - (std::bit_cast<std::uint32_t>(value) & 0x7fffffff);
}
inline std::uint32_t negative_or_beyond(float value, float limit) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (std::bit_cast<std::uint32_t>(limit) - bits) | bits;
}

inline bool is_length(float value) {
  return (beyond(value, largest_length) & top_bit) == 0;
}
inline bool is_radius(float value) {
  return (negative_or_beyond(value, largest_length) & top_bit) == 0;
}

/// Returns all bits for padding, no bits for other values.
inline std::uint32_t is_padding(float x) {
  return -static_cast<std::uint32_t>(std::bit_cast<std::uint32_t>(x) ==
                                     std::bit_cast<std::uint32_t>(infinity));
}

/// Rejects the first record for which `good` returns false. All records are visited before that one is searched for.
template <class Record, class Good>
void require_all(const char* array, std::span<const Record> records, const char* what, Good good) {
  bool all = true;
  for (const Record& record : records) all &= good(record);
  if (all) return;
  const auto found =
      std::find_if(records.begin(), records.end(), [&](const Record& record) { return !good(record); });
  reject(array, static_cast<std::size_t>(found - records.begin()), what);
}

/// Requires all discs, given as parallel arrays of x, y and radius, to have valid numbers. A disc at infinity is
/// padding.
inline void require_discs(const char* array, std::size_t place, const float* x, std::size_t count,
                          std::size_t stride) {
  const float *y = x + stride, *radius = x + 2 * stride;
  std::uint32_t bad = 0;
  for (std::size_t i = 0; i < count; ++i) bad |= beyond(x[i], largest_length) & ~is_padding(x[i]);
  for (std::size_t i = 0; i < count; ++i) bad |= beyond(y[i], largest_length);
  for (std::size_t i = 0; i < count; ++i) bad |= negative_or_beyond(radius[i], largest_length);
  if ((bad & top_bit) != 0)
    reject(array, place, "expected discs of finite numbers and radii of at least 0, found another");
}

}  // namespace bch::detail::shape_checks
