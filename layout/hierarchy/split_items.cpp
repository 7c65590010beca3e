// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/split_items.hpp"

#include <emmintrin.h>

#include <algorithm>

namespace bch::detail {
namespace {

constexpr std::size_t width = 4;

/// Coordinates of four points in a row.
struct Four {
  __m128 x, y;

  explicit Four(const Vec2* points) {
    const __m128 low = _mm_loadu_ps(&points[0].x), high = _mm_loadu_ps(&points[2].x);
    x = _mm_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0));
    y = _mm_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1));
  }
};

__m128 negated(__m128 value) {
  return _mm_xor_ps(value, _mm_set1_ps(-0.0f));
}

/// Lane k of each register becomes item k's fields, from a given one on.
void store_fields(float* fields, __m128 a, __m128 b, __m128 c, __m128 d) {
  constexpr std::size_t stride = sizeof(SplitItem) / sizeof(float);
  _MM_TRANSPOSE4_PS(a, b, c, d);
  _mm_store_ps(fields, a);
  _mm_store_ps(fields + stride, b);
  _mm_store_ps(fields + 2 * stride, c);
  _mm_store_ps(fields + 3 * stride, d);
}

}  // namespace

void SplitItems::begin(std::size_t most) {
  count = 0;
  const std::size_t room = most + width;
  if (items.size() >= room) return;
  items.resize(room), primitives.resize(room), halvings.resize(room);
  for (auto& of_axis : middle) of_axis.resize(room);
}

void SplitItems::add_contour(std::span<const Vec2> points, const EvenHalves& halves) {
  ring_.assign(points.begin(), points.end());
  ring_.insert(ring_.end(), width + 1, points[0]);
  for (std::size_t i = 0; i < points.size(); i += width) {
    const Vec2* const ends = ring_.data() + i;
    const std::size_t at = count + i;
    const Four a(ends), b(ends + 1);
    const __m128 x = _mm_sub_ps(b.x, a.x), y = _mm_sub_ps(b.y, a.y);
    const __m128 length = _mm_sqrt_ps(_mm_add_ps(_mm_mul_ps(x, x), _mm_mul_ps(y, y)));
    const __m128 half = _mm_set1_ps(0.5f);
    const __m128 middle_x = _mm_mul_ps(half, _mm_add_ps(a.x, b.x)),
                 middle_y = _mm_mul_ps(half, _mm_add_ps(a.y, b.y));
    store_fields(items[at].box, _mm_min_ps(a.x, b.x), _mm_min_ps(a.y, b.y), negated(_mm_max_ps(a.x, b.x)),
                 negated(_mm_max_ps(a.y, b.y)));
    store_fields(items[at].sums, _mm_mul_ps(length, middle_x), _mm_mul_ps(length, middle_y), length,
                 _mm_setzero_ps());
    _mm_storeu_ps(&middle[0][at], middle_x);
    _mm_storeu_ps(&middle[1][at], middle_y);
    halves.write_halvings(length, &halvings[at]);
    for (std::size_t k = 0; k < width; ++k) primitives[at + k] = {ends[k], ends[k + 1], ends[k + 1]};
  }
  count += points.size();
}

void SplitItems::add_triangle(const Primitive& triangle) {
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
