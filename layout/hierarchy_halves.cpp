// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy_halves.hpp"

#include <emmintrin.h>

#include <utility>

#include "layout/rounding.hpp"

namespace bch {
namespace {

/// Both coordinates side by side, in a register of every x86-64 processor.
__m128d widened(Vec2 p) {
  return _mm_setr_pd(static_cast<double>(p.x), static_cast<double>(p.y));
}

Vec2 narrowed(__m128 p) {
  return {_mm_cvtss_f32(p), _mm_cvtss_f32(_mm_shuffle_ps(p, p, 1))};
}

/// The larger of two squared lengths.
double larger_square(__m128d a, __m128d b) {
  const __m128d aa = _mm_mul_pd(a, a), bb = _mm_mul_pd(b, b);
  const __m128d sums = _mm_add_pd(_mm_unpacklo_pd(aa, bb), _mm_unpackhi_pd(aa, bb));
  return _mm_cvtsd_f64(_mm_max_sd(sums, _mm_unpackhi_pd(sums, sums)));
}

/// Where to write.
struct Rows {
  Vec2* centre;
  double* square_radius;
  std::uint32_t *second_child, *element_begin, *parent;
  Element* elements;
  std::uint32_t* sources;
};

/// A piece with its ends, narrow and wide, that is still to be halved so often; its node and first element.
template <int halvings>
void write_piece(const Rows& rows, Vec2 a, __m128d wide_a, Vec2 b, __m128d wide_b, std::uint32_t node,
                 std::uint32_t element, std::uint32_t source) {
  const __m128 rounded = _mm_cvtpd_ps(_mm_mul_pd(_mm_set1_pd(0.5), _mm_add_pd(wide_a, wide_b)));
  const __m128d wide_middle = _mm_cvtps_pd(rounded);
  const Vec2 middle = narrowed(rounded);
  rows.centre[node] = middle;
  rows.square_radius[node] = larger_square(_mm_sub_pd(wide_a, wide_middle), _mm_sub_pd(wide_b, wide_middle));
  rows.element_begin[node] = element;
  if constexpr (halvings == 0) {
    rows.second_child[node] = 0;
    rows.elements[element] = {a, b, b};
    rows.sources[element] = source;
  } else {
    constexpr std::uint32_t half = EvenHalves::elements(halvings - 1);
    const std::uint32_t first = node + 1, second = first + EvenHalves::nodes(halvings - 1);
    rows.second_child[node] = second;
    rows.parent[first] = rows.parent[second] = node;
    write_piece<halvings - 1>(rows, a, wide_a, middle, wide_middle, first, element, source);
    write_piece<halvings - 1>(rows, middle, wide_middle, b, wide_b, second, element + half, source);
  }
}

}  // namespace

/// A midpoint is off by sqrt(2) u of the reach, so a piece's end by 2 sqrt(2) u and its length by 5.7 u; lengths are rounded
/// in double. Of a piece that is surely long 10 u remain, so that its midpoint is neither end, which takes 2.9 u.
void EvenHalves::begin(double longest, double reach) {
  const double slack = 16 * rounding::unit_roundoff * reach;
  surely_short_ = longest - slack;
  surely_long_ = longest + slack;
  for (auto& of_a_kind : segments_) of_a_kind.clear();
}

int EvenHalves::halvings(double length) const {
  int sure = 0, possible = 0;
  for (int k = 0; k <= most_halvings; ++k) {
    sure += length > static_cast<double>(1 << k) * surely_long_;
    possible += length > static_cast<double>(1 << k) * surely_short_;
  }
  return sure == possible ? sure : uneven;
}

void EvenHalves::write(const std::vector<Element>& segments, HierarchyArrays& nodes,
                       std::vector<Element>& elements, std::vector<std::uint32_t>& sources) const {
  const Rows rows{nodes.centre.data(),
                  nodes.square_radius.data(),
                  nodes.second_child.data(),
                  nodes.element_begin.data(),
                  nodes.parent.data(),
                  elements.data(),
                  sources.data()};
  const auto write_all = [&]<int halvings>() {
    for (const auto [node, element, source] : segments_[halvings]) {
      const Element& segment = segments[source];
      write_piece<halvings>(rows, segment.a, widened(segment.a), segment.b, widened(segment.b), node, element,
                            source);
    }
  };
  [&]<int... halvings>(std::integer_sequence<int, halvings...>) {
    (write_all.template operator()<halvings>(), ...);
  }
  (std::make_integer_sequence<int, most_halvings + 1>());
}

}  // namespace bch
