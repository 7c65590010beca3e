// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/union_outline.hpp"

#include <vector>

#include "layout/outline/builder.hpp"

namespace bch {

Outline union_outline(std::span<const Eigen::Vector3f> positions,
                      std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<Eigen::Vector3f> flat;  // heights do not matter, not even whether they are numbers
  flat.reserve(positions.size());
  for (const Eigen::Vector3f& p : positions) flat.emplace_back(p.x(), p.y(), 0.0f);
  Outline outline;
  OutlineBuilder(triangles, flat.size(), flat).build(flat, outline);
  return outline;
}

}  // namespace bch
