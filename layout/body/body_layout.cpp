// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/body_layout.hpp"

#include <algorithm>
#include <numeric>

namespace bch::detail {

BodyLayout body_layout(std::span<const Sphere> spheres) {
  BodyLayout layout;
  layout.sphere_count = static_cast<std::uint32_t>(spheres.size());
  layout.leaf_size = spheres.size() > 384 ? 8 : 4;
  auto& order = layout.sphere_in_slot;
  order.resize(spheres.size());
  std::iota(order.begin(), order.end(), 0);
  const auto coordinate = [&](std::uint32_t i, int axis) {
    const Sphere& sphere = spheres[i];
    return axis == 0 ? sphere.x : axis == 1 ? sphere.y : sphere.z;
  };
  // Halves ranges across the longest extent of their centres, at whole leaves.
  const auto halve = [&](const auto& self, std::size_t begin, std::size_t end) -> void {
    const std::size_t leaves = (end - begin + layout.leaf_size - 1) / layout.leaf_size;
    if (leaves < 2) return;
    int longest = 0;
    float extent = -1;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax_element(
          order.begin() + static_cast<std::ptrdiff_t>(begin),
          order.begin() + static_cast<std::ptrdiff_t>(end),
          [&](std::uint32_t a, std::uint32_t b) { return coordinate(a, axis) < coordinate(b, axis); });
      const float length = coordinate(*high, axis) - coordinate(*low, axis);
      if (length > extent) longest = axis, extent = length;
    }
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin),
              order.begin() + static_cast<std::ptrdiff_t>(end), [&](std::uint32_t a, std::uint32_t b) {
                const float at_a = coordinate(a, longest), at_b = coordinate(b, longest);
                return at_a != at_b ? at_a < at_b : a < b;
              });
    const std::size_t middle = begin + leaves / 2 * layout.leaf_size;
    self(self, begin, middle);
    self(self, middle, end);
  };
  halve(halve, 0, order.size());
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
