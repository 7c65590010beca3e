// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "kernel/body/space_frame.hpp"
#include "kernel/penetration/free_search.hpp"
#include "layout/body/body_record.hpp"
#include "layout/format/cut_discs.hpp"
#include "layout/format/shape_set_view.hpp"

// What agents are made of, for a search of free places.

namespace bch::detail {

/// Takes a record. Here and below `placed` takes spheres into A's frame.
template <class Placed>
void take_record(const float* record, const Placed& placed, FreeBody& body) {
  body.elements.clear(), body.nodes.clear();
  body.leaf_size = header_of(record).leaf_size;
  const std::uint32_t leaves = header_of(record).leaf_count;
  for (std::uint32_t slot = 0; slot < leaves * body.leaf_size; ++slot) {
    const Sphere sphere = placed(sphere_of(record, slot));
    body.elements.push_back({sphere.x, sphere.y, sphere.z, sphere.radius});
  }
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) body.nodes.push_back(placed(node_of(record, leaf)));
  body.nodes.push_back(placed(whole_of(record)));
}

/// Adds discs.
template <class Placed>
void add_discs(const CutDiscs& discs, const Placed& placed, FreeBody& body) {
  for (std::uint32_t i = 0; i < discs.count; ++i) {
    const Sphere disc = placed(Sphere{discs.x[i], discs.y[i], 0, discs.radius[i]});
    body.elements.push_back({disc.x, disc.y, 0, disc.radius});
  }
}

/// Adds the segments of an outline.
template <class Placed>
void add_segments(const ShapeSetView& shapes, std::uint32_t shape, const Placed& placed, FreeBody& body) {
  const auto end = [&](std::uint32_t i) {
    return placed(Sphere{shapes.points[i].x, shapes.points[i].y, 0, 0});
  };
  for (std::uint32_t k = shapes.shape_contours[shape].begin; k < shapes.shape_contours[shape].end; ++k) {
    const Contour& contour = shapes.contours[k];
    Sphere from = end(contour.begin);
    for (std::uint32_t i = contour.begin; i < contour.end; ++i) {
      const Sphere to = end(i + 1);
      const float x = (to.x - from.x) / 2, y = (to.y - from.y) / 2;
      body.elements.push_back({(from.x + to.x) / 2, (from.y + to.y) / 2, 0, std::sqrt(x * x + y * y), x, y});
      from = to;
    }
  }
}

/// Adds the discs inside an outline, where the set has some.
template <class Placed>
void add_inscribed(const ShapeSetView& shapes, std::uint32_t shape, const Placed& placed, FreeBody& body) {
  if (shapes.inscribed == nullptr) return;
  const DiscBlock& discs = shapes.inscribed[shape];
  std::uint32_t count = 0;
  while (count < block_width && discs.radius[count] > 0) ++count;
  add_discs({discs.x, discs.y, discs.radius, count}, placed, body);
}

/// Returns a cylinder around elements on the ground.
inline Cylinder around(std::span<const FreeElement> elements) {
  float left = elements[0].x, right = left, low = elements[0].y, high = low;
  for (const FreeElement& each : elements) {
    left = std::min(left, each.x), right = std::max(right, each.x);
    low = std::min(low, each.y), high = std::max(high, each.y);
  }
  const float x = (left + right) / 2, y = (low + high) / 2;
  float radius = 0;
  for (const FreeElement& each : elements) {
    const float dx = each.x - x, dy = each.y - y;
    radius = std::max(radius, std::sqrt(dx * dx + dy * dy) + each.radius);
  }
  return {double{x}, double{y}, double{radius}, 0, 0};
}

/// Makes leaves of elements of an outline, which come along its contours.
inline void bound_leaves(FreeBody& body) {
  // As many leaves as 16 bits count.
  body.leaf_size = 8 * static_cast<std::uint32_t>(1 + body.elements.size() / 400'000);
  while (body.elements.size() % body.leaf_size != 0) body.elements.push_back(body.elements.back());
  body.nodes.clear();
  const std::span<const FreeElement> all = body.elements;
  for (std::size_t i = 0; i < all.size(); i += body.leaf_size)
    body.nodes.push_back(around(all.subspan(i, body.leaf_size)));
  body.nodes.push_back(around(all));
}

}  // namespace bch::detail
