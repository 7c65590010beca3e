// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/body/body_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "layout/base/heading.hpp"
#include "layout/base/rounding.hpp"
#include "layout/body/sphere_rounding.hpp"

namespace bch::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Bounds computed in double err by less than this share of the numbers that they are made of.
constexpr double rounding_share = 0x1p-48;

/// Returns the largest radius of the part of a sphere between two heights; less than 0: none of it is there.
double radius_between(double z, double radius, double low, double high) {
  const double beyond = std::max({low - z, z - high, 0.0});
  return beyond > radius ? -1 : std::sqrt(radius * radius - beyond * beyond);
}

/// Bounds the parts of a body in a band along all directions.
void write_supports(const SphereSlots& spheres, std::uint32_t slots, std::uint32_t band, double reach,
                    float* supports) {
  const double low = band == 0 ? -infinity : double{band_planes[band - 1]} - double{band_overlap};
  const double high = band + 1 == body_bands ? infinity : double{band_planes[band]} + double{band_overlap};
  for (std::uint32_t k = 0; k < support_directions; ++k) {
    const Rotation along = rotation(2 * std::numbers::pi * k / support_directions);
    double most = -infinity;
    for (std::uint32_t i = 0; i < slots; ++i) {
      const double radius = radius_between(double{spheres.z[i]}, double{spheres.radius[i]}, low, high);
      if (radius >= 0)
        most =
            std::max(most, double{spheres.x[i]} * along.cosine + double{spheres.y[i]} * along.sine + radius);
    }
    const std::uint32_t at = k % 2 * support_directions + k / 2;
    supports[at] = supports[at + support_directions / 2] =
        most == -infinity ? empty_support : static_cast<float>(most + rounding::support_margin * reach);
  }
}

void write_node(const SphereSlots& spheres, std::uint32_t first, std::uint32_t count, float* node,
                std::uint32_t stride) {
  double low[3] = {infinity, infinity, infinity}, high[3] = {-infinity, -infinity, -infinity};
  for (std::uint32_t i = first; i < first + count; ++i) {
    const double at[3] = {double{spheres.x[i]}, double{spheres.y[i]}, double{spheres.z[i]}};
    const double radius = double{spheres.radius[i]};
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], at[axis] - radius);
      high[axis] = std::max(high[axis], at[axis] + radius);
    }
  }
  node[0] = static_cast<float>((low[0] + high[0]) / 2);
  node[stride] = static_cast<float>((low[1] + high[1]) / 2);
  double farthest = 0;
  for (std::uint32_t i = first; i < first + count; ++i) {
    const double x = double{spheres.x[i]} - double{node[0]}, y = double{spheres.y[i]} - double{node[stride]};
    farthest = std::max(farthest, std::sqrt(x * x + y * y) + double{spheres.radius[i]});
  }
  node[2 * stride] = rounding::round_up(farthest * (1 + rounding_share));
  node[3 * stride] = rounding::round_down(low[2] - std::abs(low[2]) * rounding_share);
  node[4 * stride] = -rounding::round_down(-high[2] - std::abs(high[2]) * rounding_share);
}

}  // namespace

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

void write_record(const BodyLayout& layout, const SphereSlots& spheres, float* record) noexcept {
  const std::uint32_t slots = layout.slot_count(), stride = layout.node_stride();
  BodyHeader header{};
  header.sphere_count = layout.sphere_count;
  header.leaf_size = layout.leaf_size;
  header.leaf_count = layout.leaf_count();
  header.node_stride = stride;
  double reach = 0;
  for (std::uint32_t i = 0; i < slots; ++i) {
    const double x = double{spheres.x[i]}, y = double{spheres.y[i]}, z = double{spheres.z[i]};
    reach = std::max(reach, std::sqrt(x * x + y * y + z * z) + double{spheres.radius[i]});
  }
  header.reach = rounding::round_up(reach * (1 + rounding_share));
  float root[5];
  write_node(spheres, 0, slots, root, 1);
  header.x = root[0], header.y = root[1], header.radius = root[2];
  header.bottom = root[3], header.top = root[4];
  std::copy_n(reinterpret_cast<const float*>(&header), record_line, record);
  for (std::uint32_t i = 0; i < core_spheres; ++i) {
    const std::uint32_t slot = layout.core[i];
    float* const core = record + record_core + i;
    core[0] = spheres.x[slot], core[core_spheres] = spheres.y[slot];
    core[2 * core_spheres] = spheres.z[slot], core[3 * core_spheres] = spheres.radius[slot];
  }
  for (std::uint32_t band = 0; band < body_bands; ++band)
    write_supports(spheres, slots, band, double{header.reach},
                   record + record_supports + band * support_stride);
  constexpr float far_away = std::numeric_limits<float>::infinity();
  float* const nodes = record + record_nodes;
  for (std::uint32_t i = 0; i < stride; ++i) {
    if (i < header.leaf_count) {
      write_node(spheres, i * layout.leaf_size, layout.leaf_size, nodes + i, stride);
    } else {
      nodes[i] = nodes[stride + i] = nodes[3 * stride + i] = far_away;
      nodes[2 * stride + i] = 0, nodes[4 * stride + i] = -far_away;
    }
  }
  float* leaf = record + layout.record_leaves();
  for (std::uint32_t first = 0; first < slots; first += layout.leaf_size)
    for (const float* const of : {spheres.x, spheres.y, spheres.z, spheres.radius})
      leaf = std::copy_n(of + first, layout.leaf_size, leaf);
}

}  // namespace bch::detail
