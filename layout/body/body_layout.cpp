// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/body_layout.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

#include "layout/base/number_class.hpp"
#include "layout/base/shortest.hpp"
#include "layout/body/leaf_order.hpp"

namespace bch::detail {

void require_spheres(std::span<const Sphere> spheres, const std::string& whose) {
  const auto refuse = [&](const std::string& expected, const std::string& found) {
    throw std::invalid_argument(whose + ": expected " + expected + ", found " + found);
  };
  if (spheres.empty() || spheres.size() > max_spheres)
    refuse("1 to " + std::to_string(max_spheres) + " spheres", std::to_string(spheres.size()));
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const Sphere& s = spheres[i];
    if (!is_finite(s.x) || !is_finite(s.y) || !is_finite(s.z) || !is_finite(s.radius) || s.radius < 0)
      refuse("finite spheres with radii of at least 0",
             std::string("(") + shortest(s.x) + ", " + shortest(s.y) + ", " + shortest(s.z) + ", radius " +
                 shortest(s.radius) + ") as sphere " + std::to_string(i));
  }
}

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
