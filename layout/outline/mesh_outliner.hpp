// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/outline_builder.hpp>

namespace bch::detail {

/// Finds the outlines of outline() for one mesh in pose after pose. Only one thread may use an object at a time.
class MeshOutliner {
 public:
  /// Prepares the mesh. `bind_pose` is that of OutlineBuilder.
  /// Errors:  throws std::invalid_argument as OutlineBuilder does, and if heights are NaN or do not ascend.
  MeshOutliner(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const Vec3> bind_pose,
               const OutlineOptions& options);

  /// Returns the outline of a pose.
  /// Errors:  throws std::invalid_argument as OutlineBuilder::build() does, and, if heights clip, if a height is not
  ///          finite.
  Outline outline(std::span<const Vec3> positions);

 private:
  OutlineBuilder builder_;  ///< of the whole mesh; a clipped mesh gets a builder of its own
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  Heights between_;
  bool holes_;
};

}  // namespace bch::detail
