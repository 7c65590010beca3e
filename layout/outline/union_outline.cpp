// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/outline_builder.hpp>

#include <vector>

namespace bch {

using namespace detail;

Outline union_outline(std::span<const Vec3> positions,
                      std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<Vec3> flat;  // heights do not matter, not even whether they are numbers
  flat.reserve(positions.size());
  for (const Vec3& p : positions) flat.push_back({p.x, p.y, 0});
  Outline outline;
  OutlineBuilder(triangles, flat.size(), flat).build(flat, outline);
  return outline;
}

}  // namespace bch
