// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <limits>

#include "layout/base/rounding.hpp"
#include "layout/body/body_layout.hpp"
#include "layout/culling/supports.hpp"
#include "layout/simd/lanes.hpp"

// Bounds are computed in float, a few slots side by side, and rounded outward. With u the unit roundoff and P the extent, of which no
// coordinate and no radius is larger:
//
//     (extent)    sqrt(x^2 + y^2 + z^2) + r is off by 2 u of the root, 0.5 u for its own rounding and u of the sum:  3.5 u P
//     (box)       x - r, x + r:                                                                                     u 2 P
//     (disc)      the distance of two centres is off by u + 2 u of it, and the sum by u:                            4 u of the sum
//     (clip)      low - z, the height beyond a band, is off by u (0.5 m + P + overlap), which the slack takes away; and
//                 sqrt((r - d) (r + d)) by u + u + 0.5 u + 0.5 u of itself
//
// The margins below are these, doubled.
namespace bch::detail {
namespace {

using Simd = BaseLanes;
using Float = Simd::Float;
constexpr std::uint32_t group = 4;  ///< slots side by side
static_assert(Float::size == group);

constexpr float unit = 0x1p-24f;
constexpr float extent_error = 8 * unit, box_error = 4 * unit, disc_error = 8 * unit, clip_error = 8 * unit;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Holds a group of spheres, or of four such groups the ones in the same place.
struct Group {
  Float x, y, z, radius;
};

Group load(const SphereSlots& spheres, std::uint32_t slot) {
  return {Simd::load(spheres.x + slot), Simd::load(spheres.y + slot), Simd::load(spheres.z + slot),
          Simd::load(spheres.radius + slot)};
}

float largest(Float values) {
  return -Simd::least(-values);
}

Float length(Float x, Float y) {
  return xsimd::sqrt(x * x + y * y);
}

float extent_of(const SphereSlots& spheres, std::uint32_t slots) {
  Float most(0.0f);
  for (std::uint32_t i = 0; i < slots; i += group) {
    const Group s = load(spheres, i);
    most = Simd::max(xsimd::sqrt(s.x * s.x + s.y * s.y + s.z * s.z) + s.radius, most);
  }
  const float max_extent = largest(most);
  return max_extent + extent_error * max_extent;
}

/// Holds low and high ends of boxes, one a lane.
struct Boxes {
  Float low[3] = {Float(infinity), Float(infinity), Float(infinity)};
  Float high[3] = {Float(-infinity), Float(-infinity), Float(-infinity)};

  void add(const Group& s) {
    const Float at[] = {s.x, s.y, s.z};
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = xsimd::min(low[axis], at[axis] - s.radius);
      high[axis] = xsimd::max(high[axis], at[axis] + s.radius);
    }
  }
  Float middle(int axis) const { return Float(0.5f) * (low[axis] + high[axis]); }
};

/// Writes the disc and the heights that hold the whole body.
void bound_all(const SphereSlots& spheres, std::uint32_t slots, BodyHeader& header) {
  Boxes boxes;
  for (std::uint32_t i = 0; i < slots; i += group) boxes.add(load(spheres, i));
  const auto middle = [&](int axis) {
    return 0.5f * (Simd::least(boxes.low[axis]) + largest(boxes.high[axis]));
  };
  header.x = middle(0), header.y = middle(1);
  Float farthest(0.0f);
  for (std::uint32_t i = 0; i < slots; i += group) {
    const Group s = load(spheres, i);
    farthest = Simd::max(length(s.x - Float(header.x), s.y - Float(header.y)) + s.radius, farthest);
  }
  const float radius = largest(farthest);
  header.radius = radius + disc_error * radius;
  const float margin = box_error * header.max_extent;
  header.bottom = Simd::least(boxes.low[2]) - margin;
  header.top = largest(boxes.high[2]) + margin;
}

/// Writes the nodes of leaves of `parts` groups each, four leaves at a time.
template <std::uint32_t parts>
void bound_leaves(const SphereSlots& spheres, std::uint32_t leaves, std::uint32_t stride, float max_extent,
                  float* nodes) {
  const Float margin(box_error * max_extent), disc_margin(disc_error);
  for (std::uint32_t first = 0; first < leaves; first += group) {
    Group columns[group * parts];  ///< the spheres in the same place of the four leaves
    for (std::uint32_t part = 0; part < parts; ++part) {
      const auto turn = [&](const float* field, Float(&to)[4]) {
        Float rows[4];
        for (std::uint32_t leaf = 0; leaf < group; ++leaf)
          rows[leaf] = Simd::load(field + (std::min(first + leaf, leaves - 1) * parts + part) * group);
        Simd::transpose(rows, to);
      };
      Float x[4], y[4], z[4], radius[4];
      turn(spheres.x, x), turn(spheres.y, y), turn(spheres.z, z), turn(spheres.radius, radius);
      for (std::uint32_t k = 0; k < group; ++k) columns[part * group + k] = {x[k], y[k], z[k], radius[k]};
    }
    Boxes boxes;
    for (const Group& s : columns) boxes.add(s);
    const Float x = boxes.middle(0), y = boxes.middle(1);
    Float farthest(0.0f);
    for (const Group& s : columns) farthest = Simd::max(length(s.x - x, s.y - y) + s.radius, farthest);
    Simd::store(nodes + first, x), Simd::store(nodes + stride + first, y);
    Simd::store(nodes + 2 * stride + first, farthest + disc_margin * farthest);
    Simd::store(nodes + 3 * stride + first, boxes.low[2] - margin);
    Simd::store(nodes + 4 * stride + first, boxes.high[2] + margin);
  }
  for (std::uint32_t i = leaves; i < stride; ++i) {
    nodes[i] = nodes[stride + i] = nodes[3 * stride + i] = infinity;
    nodes[2 * stride + i] = 0, nodes[4 * stride + i] = -infinity;
  }
}

/// Bounds the parts of a body in a band along all directions.
void write_supports(const SphereSlots& spheres, std::uint32_t slots, std::uint32_t band, float max_extent,
                    float* to) {
  const Float low(band == 0 ? -infinity : band_planes[band - 1] - band_overlap);
  const Float high(band + 1 == body_bands ? infinity : band_planes[band] + band_overlap);
  const Float slack(4 * unit * (1 + max_extent)), error(clip_error), zero(0.0f);
  // The parts of spheres in the band are discs as seen from above; whole registers may be read behind them.
  alignas(64) float x[max_spheres + record_line], y[max_spheres + record_line],
      radius[max_spheres + record_line];
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < slots; i += group) {
    const Group s = load(spheres, i);
    const Float beyond = xsimd::max(xsimd::max(low - s.z, s.z - high) - slack, zero);
    const Float square = (s.radius - beyond) * (s.radius + beyond);
    alignas(16) float clipped[group];
    const Float root = xsimd::sqrt(xsimd::max(square, zero));
    Simd::store(clipped, root + error * root);
    const std::uint32_t in_band = Simd::bits(beyond <= s.radius);
    for (std::uint32_t k = 0; k < group; ++k) {
      x[count] = spheres.x[i + k], y[count] = spheres.y[i + k], radius[count] = clipped[k];
      count += in_band >> k & 1;
    }
  }
  if (count == 0) {
    std::fill_n(to, support_stride, empty_support);
    return;
  }
  const Supports heights = supports(x, y, radius, count, double{max_extent});
  std::copy(heights.begin(), heights.end(), to);
}

}  // namespace

void write_record(const BodyLayout& layout, const SphereSlots& spheres, float* record) noexcept {
  const std::uint32_t slots = layout.slot_count(), stride = layout.node_stride();
  BodyHeader header{};
  header.sphere_count = layout.sphere_count;
  header.leaf_size = layout.leaf_size;
  header.leaf_count = layout.leaf_count();
  header.node_stride = stride;
  header.max_extent = extent_of(spheres, slots);
  bound_all(spheres, slots, header);
  std::copy_n(reinterpret_cast<const float*>(&header), record_line, record);
  for (std::uint32_t i = 0; i < core_spheres; ++i) {
    const std::uint32_t slot = layout.core[i];
    float* const core = record + record_core + i;
    core[0] = spheres.x[slot], core[core_spheres] = spheres.y[slot];
    core[2 * core_spheres] = spheres.z[slot], core[3 * core_spheres] = spheres.radius[slot];
  }
  for (std::uint32_t band = 0; band < body_bands; ++band)
    write_supports(spheres, slots, band, header.max_extent, record + record_supports + band * support_stride);
  (layout.leaf_size == group ? bound_leaves<1> : bound_leaves<2>)(spheres, header.leaf_count, stride,
                                                                  header.max_extent, record + record_nodes);
  float* leaf = record + layout.record_leaves();
  for (std::uint32_t first = 0; first < slots; first += layout.leaf_size)
    for (const float* const of : {spheres.x, spheres.y, spheres.z, spheres.radius})
      leaf = std::copy_n(of + first, layout.leaf_size, leaf);
}

}  // namespace bch::detail
