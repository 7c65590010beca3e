// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/body_layout.hpp"

#include <algorithm>
#include <numeric>

#include "layout/body/leaf_order.hpp"

namespace bch::detail {

BodyLayout body_layout(std::span<const std::vector<Sphere>> poses) {
  const std::vector<Sphere>& spheres = poses.front();
  BodyLayout layout;
  layout.sphere_count = static_cast<std::uint32_t>(spheres.size());
  layout.leaf_size = spheres.size() > 192 ? 8 : 4;
  const auto& order = layout.sphere_in_slot = leaf_order(poses, layout.leaf_size);
  std::vector<std::uint32_t> by_size(order.size());
  std::iota(by_size.begin(), by_size.end(), 0);
  std::stable_sort(by_size.begin(), by_size.end(), [&](std::uint32_t a, std::uint32_t b) {
    return spheres[order[a]].radius > spheres[order[b]].radius;
  });
  for (std::uint32_t i = 0; i < core_spheres; ++i)
    layout.core[i] = by_size[std::min<std::size_t>(i, by_size.size() - 1)];
  return layout;
}

}  // namespace bch::detail
