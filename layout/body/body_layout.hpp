// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <bch/body_set.hpp>

#include "layout/body/body_record.hpp"

namespace bch::detail {

/// Holds what the bodies of one model have in common.
struct BodyLayout {
  std::uint32_t sphere_count = 0;
  std::uint32_t leaf_size = 4;
  std::vector<std::uint32_t> sphere_in_slot;  ///< the number of the sphere in each slot; as many as spheres
  std::array<std::uint32_t, core_spheres> core =
      {};  ///< slots of the spheres that most collisions meet first

  std::uint32_t leaf_count() const noexcept { return (sphere_count + leaf_size - 1) / leaf_size; }
  std::uint32_t slot_count() const noexcept { return leaf_count() * leaf_size; }
  std::uint32_t node_stride() const noexcept {
    return (leaf_count() + record_line - 1) / record_line * record_line;
  }
  std::uint32_t record_leaves() const noexcept { return record_nodes + 5 * node_stride(); }
  /// Returns the floats of a record: whole lines.
  std::size_t record_size() const noexcept {
    return (record_leaves() + std::size_t{4} * slot_count() + record_line - 1) / record_line * record_line;
  }
};

/// Checks the spheres of a body: their number, and each one.
/// Errors:  throws std::invalid_argument, in the name of `whose`.
void require_spheres(std::span<const Sphere> spheres, const std::string& whose);

/// Returns the layout of bodies like one that is given in some poses: spheres that are near each other share a leaf, and the largest are the
/// core.
BodyLayout body_layout(std::span<const std::vector<Sphere>> poses);

/// Holds the spheres of a body by slots, side by side; slots behind the last sphere repeat it.
struct SphereSlots {
  const float *x, *y, *z, *radius;
};

/// Writes the record of a body.
void write_record(const BodyLayout& layout, const SphereSlots& spheres, float* record) noexcept;

}  // namespace bch::detail
