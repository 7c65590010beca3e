// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/split_items.hpp"

#include <algorithm>

#include "layout/simd/lanes.hpp"

namespace bch::detail {
namespace {

using Simd = BaseLanes;
using Float = Simd::Float;
constexpr std::size_t width = Simd::width;

struct Points {
  Float x, y;

  explicit Points(const Vec2* first) {
    Simd::load_pairs([=](std::size_t i) { return first + i; }, x, y);
  }
};

/// Lane k of each register becomes item k's fields, from a given one on.
void store_fields(float* fields, Float a, Float b, Float c, Float d) {
  constexpr std::size_t stride = sizeof(SplitItem) / sizeof(float);
  Float of_item[4];
  Simd::transpose({a, b, c, d}, of_item);
  for (std::size_t k = 0; k < width; ++k) of_item[k].store_aligned(fields + k * stride);
}

}  // namespace

void SplitItems::begin(std::size_t most) {
  count = 0;
  const std::size_t capacity = most + width;
  if (items.size() >= capacity) return;
  primitives.resize(capacity), halvings.resize(capacity);
  for (auto& of_axis : middle) of_axis.resize(capacity);
  items.resize(capacity);  // the last one, which tells that the others have room
}

void SplitItems::add_contour(std::span<const Vec2> points, const EvenHalves& halves) {
  ring_.assign(points.begin(), points.end());
  ring_.insert(ring_.end(), width + 1, points[0]);
  for (std::size_t i = 0; i < points.size(); i += width) {
    const Vec2* const ends = ring_.data() + i;
    const std::size_t at = count + i;
    const Points a(ends), b(ends + 1);
    const Float x = b.x - a.x, y = b.y - a.y, length = xsimd::sqrt(x * x + y * y), half(0.5f);
    const Float middle_x = half * (a.x + b.x), middle_y = half * (a.y + b.y);
    store_fields(items[at].box, Simd::min(a.x, b.x), Simd::min(a.y, b.y), -Simd::max(a.x, b.x),
                 -Simd::max(a.y, b.y));
    store_fields(items[at].sums, length * middle_x, length * middle_y, length, Float(0.0f));
    Simd::store(&middle[0][at], middle_x);
    Simd::store(&middle[1][at], middle_y);
    float lengths[width];
    Simd::store(lengths, length);
    halves.write_halvings(lengths, &halvings[at]);
    for (std::size_t k = 0; k < width; ++k) primitives[at + k] = {ends[k], ends[k + 1], ends[k + 1]};
  }
  count += points.size();
}

void SplitItems::add_triangle(const Hierarchy::Primitive& triangle) {
  const auto& [a, b, c] = triangle;
  SplitItem& item = items[count];
  item.sums[2] = 3, item.sums[3] = 0;
  const auto set = [&](std::size_t axis, float at_a, float at_b, float at_c) {
    item.box[axis] = std::min({at_a, at_b, at_c});
    item.box[2 + axis] = -std::max({at_a, at_b, at_c});
    item.sums[axis] = at_a + at_b + at_c;
    middle[axis][count] = item.sums[axis] / 3;
  };
  set(0, a.x, b.x, c.x);
  set(1, a.y, b.y, c.y);
  primitives[count++] = triangle;
}

}  // namespace bch::detail
