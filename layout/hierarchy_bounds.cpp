// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy_bounds.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <bit>

#include "layout/rounding.hpp"

namespace bch {
namespace {

/// Radii with their margin, two at a time.
void set_radii(HierarchyArrays& arrays, std::uint32_t count, double margin) {
  const __m128d outward = _mm_set1_pd(1 + 0x1p-50), added = _mm_set1_pd(margin);
  for (std::uint32_t i = 0; i < count; i += 2) {
    const __m128d root = _mm_sqrt_pd(_mm_loadu_pd(&arrays.square_radius[i]));
    const __m128d exact = _mm_add_pd(_mm_mul_pd(root, outward), added);
    const __m128 nearest = _mm_cvtpd_ps(exact);
    // As rounding::round_up(): a comparison that holds is -1.
    const __m128 below = _mm_castpd_ps(_mm_cmplt_pd(_mm_cvtps_pd(nearest), exact));
    const __m128i step = _mm_castps_si128(_mm_shuffle_ps(below, below, _MM_SHUFFLE(2, 0, 2, 0)));
    const __m128i radius = _mm_sub_epi32(_mm_castps_si128(nearest), step);
    _mm_storel_epi64(reinterpret_cast<__m128i*>(&arrays.radius[i]), radius);
    _mm_storel_epi64(reinterpret_cast<__m128i*>(&arrays.bound[i]), radius);
  }
}

/// By instructions that may alias what they read, as those of doubles may not.
__m128 load(const Vec2& low, const Vec2& high) {
  return _mm_loadh_pi(_mm_loadl_pi(_mm_setzero_ps(), reinterpret_cast<const __m64*>(&low)),
                      reinterpret_cast<const __m64*>(&high));
}

/// From every node to its parent and its grandparent, two nodes at a time.
void set_distances(HierarchyArrays& arrays, std::uint32_t count) {
  const Vec2* const centre = arrays.centre.data();
  const std::uint32_t* const parent = arrays.parent.data();
  const auto squares = [&](std::uint32_t i) {
    const std::uint32_t above = parent[i];
    const __m128 d = _mm_sub_ps(load(centre[above], centre[parent[above]]), load(centre[i], centre[i]));
    return _mm_mul_ps(d, d);
  };
  for (std::uint32_t i = 0; i < count; i += 2) {
    const __m128 a = squares(i), b = squares(i + 1);
    const __m128 sum = _mm_add_ps(_mm_shuffle_ps(a, b, _MM_SHUFFLE(2, 0, 2, 0)),
                                  _mm_shuffle_ps(a, b, _MM_SHUFFLE(3, 1, 3, 1)));
    _mm_storeu_ps(&arrays.distance[2 * std::size_t{i}], _mm_sqrt_ps(sum));
  }
}

}  // namespace

void HierarchyArrays::resize(std::size_t nodes) {
  centre.resize(nodes), square_radius.resize(nodes);
  second_child.resize(nodes), element_begin.resize(nodes), parent.resize(nodes);
  radius.resize(nodes), bound.resize(nodes), distance.resize(2 * nodes);
}

/// Bounds from children's discs and grandchildren's bounds: 0.3 % over the tightest, where children's bounds alone
/// would make it 2 %. Each step rounds outward: its terms in float are off by 5 u. Backwards, so that a node's bound is
/// final when it is its turn.
void publish_nodes(HierarchyArrays& arrays, std::uint32_t count, double margin, Hierarchy& hierarchy) {
  constexpr float outward = 1 + 0x1p-21f;
  if (arrays.centre.size() < count + 2) arrays.resize(count + 2);
  // One past the last node stands above the root; loops over pairs may read the next.
  arrays.parent[0] = arrays.parent[count] = arrays.parent[count + 1] = count;
  arrays.centre[count] = arrays.centre[0];
  arrays.element_begin[count] = static_cast<std::uint32_t>(hierarchy.elements.size());
  set_radii(arrays, count, margin);
  set_distances(arrays, count);

  const double slack = rounding::nesting_margin * hierarchy.reach;
  hierarchy.nodes.resize(count);
  HierarchyNode* const nodes = hierarchy.nodes.data();
  const std::uint32_t* const parent = arrays.parent.data();
  const std::uint32_t* const element_begin = arrays.element_begin.data();
  const float* const distance = arrays.distance.data();
  float* const bounds = arrays.bound.data();
  const auto raise = [&](std::uint32_t node, float needed) {
    bounds[node] = std::max(bounds[node], needed * outward);
  };
  for (std::uint32_t i = count; i-- > 0;) {
    const float radius = arrays.radius[i], below = bounds[i];
    raise(parent[i], distance[2 * std::size_t{i}] + radius);
    raise(parent[parent[i]], distance[2 * std::size_t{i} + 1] + below);
    const float bound = rounding::round_up(static_cast<double>(below) + slack);
    const Vec2 centre = arrays.centre[i];
    // A leaf prunes nothing: its bound is its disc, so that a traversal may test bounds throughout. Chosen by bits,
    // because whether a node is a leaf is a coin toss.
    const std::uint32_t second = arrays.second_child[i];
    const std::uint32_t inner = second == 0 ? 0 : ~std::uint32_t{0};
    const auto choose = [inner](std::uint32_t of_inner, std::uint32_t of_leaf) {
      return (of_inner & inner) | (of_leaf & ~inner);
    };
    nodes[i] = {{centre.x, centre.y, radius},
                std::bit_cast<float>(
                    choose(std::bit_cast<std::uint32_t>(bound), std::bit_cast<std::uint32_t>(radius))),
                second,
                element_begin[i],
                choose(nodes[second].element_end, element_begin[i + 1])};
  }
}

}  // namespace bch
