// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/outline_builder.hpp>

namespace bch::detail {

/// Finds what outline() returns, of one mesh in pose after pose. Only one thread may use an object at a time.
class MeshOutliner {
 public:
  /// Prepares the mesh. `bind_pose`: as OutlineBuilder takes it.
  /// Errors:  throws std::invalid_argument as OutlineBuilder does, and on heights that are NaN or do not ascend.
  MeshOutliner(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const Vec3> bind_pose,
               const OutlineOptions& options);

  /// Returns the outline of a pose.
  /// Errors:  throws std::invalid_argument as OutlineBuilder::build() does, and on a height that is not finite where some cut.
  Outline outline(std::span<const Vec3> positions);

 private:
  OutlineBuilder builder_;  ///< of the whole mesh; what is cut in a pose is a mesh of its own
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  Heights between_;
  bool holes_;
};

}  // namespace bch::detail
