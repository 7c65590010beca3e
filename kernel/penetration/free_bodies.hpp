// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernel/body/space_frame.hpp"
#include "kernel/penetration/free_pair.hpp"
#include "layout/body/body_record.hpp"
#include "layout/format/cut_discs.hpp"
#include "layout/format/shape_set_view.hpp"

// What agents are made of, for a search of free places.

namespace bch::detail {

/// Takes a record. `placed` takes spheres into A's frame.
template <class Placed>
void take_record(const float* record, const Placed& placed, FreeBody& body) {
  const std::uint32_t leaves = header_of(record).leaf_count, size = header_of(record).leaf_size;
  body.begin(leaves * size, size);
  for (std::uint32_t slot = 0; slot < leaves * size; ++slot) {
    const Sphere sphere = placed(sphere_of(record, slot));
    body.add({sphere.x, sphere.y, sphere.z, sphere.radius});
  }
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) body.add_node(placed(node_of(record, leaf)));
  body.add_node(placed(whole_of(record)));
}

/// Begins a body whose leaves are made of consecutive elements, in registers: as many leaves as 16 bits count.
inline void begin_leaves(std::size_t elements, FreeBody& body) {
  body.begin(elements, 8 * static_cast<std::uint32_t>(1 + elements / 400'000));
}

/// Takes discs of A's frame.
inline void take_discs(const CutDiscs& discs, const Transform& to_a, FreeBody& body) {
  begin_leaves(discs.count, body);
  for (std::uint32_t i = 0; i < discs.count; ++i) {
    const auto [x, y] = to_a.apply(discs.x[i], discs.y[i]);
    body.add({x, y, 0, discs.radius[i]});
  }
}

/// Takes the segments of an outline.
inline void take_segments(const Kernels& kernels, const ShapeSetView& shapes, std::uint32_t shape,
                          const Transform& to_a, FreeBody& body) {
  const auto [first, last] = shapes.shape_contours[shape];
  const auto count = [&](std::uint32_t k) { return shapes.contours[k].end - shapes.contours[k].begin; };
  std::size_t segments = 0;
  for (std::uint32_t k = first; k < last; ++k) segments += count(k);
  begin_leaves(segments, body);
  for (std::uint32_t k = first; k < last; ++k)
    body.add_segments(kernels, shapes.points + shapes.contours[k].begin, count(k), to_a);
}

/// Returns the discs inside an outline; none where the set has none.
inline CutDiscs inscribed_discs(const ShapeSetView& shapes, std::uint32_t shape) {
  if (shapes.inscribed == nullptr) return {};
  const DiscBlock& discs = shapes.inscribed[shape];
  std::uint32_t count = 0;
  while (count < block_width && discs.radius[count] > 0) ++count;
  return {discs.x, discs.y, discs.radius, count};
}

}  // namespace bch::detail
