// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/halves.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "layout/base/rounding.hpp"

namespace bch::detail {
namespace {

/// Both coordinates side by side, in a register of every x86-64 processor.
__m128d widened(Vec2 p) {
  return _mm_setr_pd(static_cast<double>(p.x), static_cast<double>(p.y));
}

/// The larger of two squared lengths, in the lower lane.
__m128d larger_square(__m128d a, __m128d b) {
  const __m128d aa = _mm_mul_pd(a, a), bb = _mm_mul_pd(b, b);
  const __m128d sums = _mm_add_pd(_mm_unpacklo_pd(aa, bb), _mm_unpackhi_pd(aa, bb));
  return _mm_max_sd(sums, _mm_unpackhi_pd(sums, sums));
}

/// Writes the nodes of a piece, by its ends, that is still to be halved so often; the first one is `number` of all.
/// Returns: the square of the first one's radius, which remains to be written, in the lower lane.
template <int halvings>
__m128d write_piece(__m128d a, __m128d b, const OutwardRadii& radii, HierarchyNode* node,
                    std::uint32_t number) {
  const __m128 rounded = _mm_cvtpd_ps(_mm_mul_pd(_mm_set1_pd(0.5), _mm_add_pd(a, b)));
  const __m128d middle = _mm_cvtps_pd(rounded);
  _mm_storel_pi(reinterpret_cast<__m64*>(&node->disc), rounded);
  if constexpr (halvings == 0) {
    node->second_child = 0;
  } else {
    constexpr std::uint32_t second = EvenHalves::nodes(halvings - 1) + 1;
    node->second_child = number + second;
    const __m128d of_first = write_piece<halvings - 1>(a, middle, radii, node + 1, number + 1);
    const __m128d of_second = write_piece<halvings - 1>(middle, b, radii, node + second, number + second);
    radii.write(_mm_unpacklo_pd(of_first, of_second), node[1], node[second]);
  }
  return larger_square(_mm_sub_pd(a, middle), _mm_sub_pd(b, middle));
}

/// The slack for halving by length, in units of u times the reach. After three halvings a midpoint is off by
/// 2.34 u (rounding.hpp), and so is a piece's end, which is at most 2 sqrt(2) u, so that a length is off by
/// 5.7 u. A length in float is off by 2.5 u of at most 2.83 times the reach, and the limits, where lengths
/// come near them, by 2.9 u. Of a piece that is surely long 8 u remain, so that its midpoint is neither end,
/// which takes 2.9 u.
constexpr double piece_end = 2 * rounding::terms::root_2, float_length = 2.5 * 2.83, limits = 2.9,
                 remains = 8;
static_assert(piece_end >= rounding::terms::halved(EvenHalves::most_halvings) && remains >= piece_end);
constexpr double slack_in_u = 24;
static_assert(slack_in_u >= 2 * piece_end + float_length + limits + remains);

}  // namespace

void EvenHalves::begin(double longest, double reach) {
  const double slack = slack_in_u * rounding::unit_roundoff * reach;
  for (std::size_t k = 0; k < surely_long_.size(); ++k) {
    const double pieces = 1 << k;
    const auto limit = [&](double length) {
      return static_cast<float>(std::min(pieces * length, double{std::numeric_limits<float>::max()}));
    };
    surely_short_[k] = limit(longest - slack);
    surely_long_[k] = limit(longest + slack);
  }
  for (auto& of_a_kind : segments_) of_a_kind.clear();
}

void EvenHalves::write_halvings(__m128 lengths, std::uint8_t* halvings) const {
  __m128i sure = _mm_setzero_si128(), possible = sure;
  const auto count = [&](__m128i& sum, float limit) {
    sum = _mm_sub_epi32(sum, _mm_castps_si128(_mm_cmpgt_ps(lengths, _mm_set1_ps(limit))));
  };
  for (std::size_t k = 0; k < surely_long_.size(); ++k)
    count(sure, surely_long_[k]), count(possible, surely_short_[k]);
  const __m128i is_even = _mm_cmpeq_epi32(sure, possible);
  const __m128i four =
      _mm_or_si128(_mm_and_si128(is_even, sure), _mm_andnot_si128(is_even, _mm_set1_epi32(uneven)));
  const __m128i bytes = _mm_packus_epi16(_mm_packs_epi32(four, four), four);
  const int packed = _mm_cvtsi128_si32(bytes);
  __builtin_memcpy(halvings, &packed, sizeof packed);
}

void EvenHalves::write(const std::vector<Primitive>& segments, const OutwardRadii& radii,
                       std::vector<HierarchyNode>& nodes) const {
  const auto write_all = [&]<int halvings>() {
    const std::vector<Segment>& all = segments_[halvings];
    const auto write_one = [&](const Segment& segment) {
      const Primitive& whole = segments[segment.source];
      return write_piece<halvings>(widened(whole.a), widened(whole.b), radii, &nodes[segment.node],
                                   segment.node);
    };
    for (std::size_t i = 0; i < all.size(); i += 2) {
      const Segment &first = all[i], &second = i + 1 < all.size() ? all[i + 1] : first;
      radii.write(_mm_unpacklo_pd(write_one(first), write_one(second)), nodes[first.node],
                  nodes[second.node]);
    }
  };
  [&]<int... halvings>(std::integer_sequence<int, halvings...>) {
    (write_all.template operator()<halvings>(), ...);
  }
  (std::make_integer_sequence<int, most_halvings + 1>());
}

}  // namespace bch::detail
