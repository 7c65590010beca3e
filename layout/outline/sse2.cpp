// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <emmintrin.h>

#include "layout/outline/lanes.hpp"

namespace bch::detail {
namespace {

struct Sse2 {
  using Doubles = __m128d;
  static constexpr std::size_t width = 2;
  static constexpr std::size_t bits_per_box = 1;

  struct Ends {
    Doubles ax, ay, bx, by;
  };
  struct Cells {
    __m128i min_x, min_y, max_x, max_y;

    explicit Cells(const SearchedWay& way)
        : min_x(_mm_set1_epi16(way.min_x)),
          min_y(_mm_set1_epi16(way.min_y)),
          max_x(_mm_set1_epi16(way.max_x)),
          max_y(_mm_set1_epi16(way.max_y)) {}
  };

  static __m128i low_half(const void* from) { return _mm_loadl_epi64(static_cast<const __m128i*>(from)); }
  static __m128i high_half(__m128i v) { return _mm_unpackhi_epi64(v, v); }

  static Doubles all(double value) { return _mm_set1_pd(value); }
  static void store(double* to, Doubles value) { _mm_storeu_pd(to, value); }
  template <class Mask>
  static std::uint64_t bits_of(Mask mask) {
    return static_cast<std::uint64_t>(_mm_movemask_pd((__m128d)mask));
  }

  static Ends load(const Segment* segments, const std::uint32_t* which) {
    const __m128i first = _mm_loadu_si128((const __m128i*)(segments + which[0]));
    const __m128i second = _mm_loadu_si128((const __m128i*)(segments + which[1]));
    const __m128i a = _mm_unpacklo_epi32(first, second), b = _mm_unpackhi_epi32(first, second);
    return {_mm_cvtepi32_pd(a), _mm_cvtepi32_pd(high_half(a)), _mm_cvtepi32_pd(b),
            _mm_cvtepi32_pd(high_half(b))};
  }

  static std::uint32_t meeting(const BoxBlock& block, const Cells& box) {
    const auto apart = [&](int half) {
      const auto load = [half](const std::int16_t* cells) {
        return _mm_load_si128((const __m128i*)(cells + 8 * half));
      };
      return _mm_or_si128(_mm_or_si128(_mm_cmpgt_epi16(load(block.min_x), box.max_x),
                                       _mm_cmpgt_epi16(load(block.min_y), box.max_y)),
                          _mm_or_si128(_mm_cmpgt_epi16(box.min_x, load(block.max_x)),
                                       _mm_cmpgt_epi16(box.min_y, load(block.max_y))));
    };
    return static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(apart(0), apart(1)))) ^ 0xffff;
  }
  static std::size_t boxes(std::uint32_t bits) {
    bits -= bits >> 1 & 0x5555;
    bits = (bits & 0x3333) + (bits >> 2 & 0x3333);
    bits = (bits + (bits >> 4)) & 0x0f0f;
    return (bits + (bits >> 8)) & 0x1f;
  }

  /// Corner k of two triangles and of the next two.
  struct Corners {
    __m128i first, second;

    Corners(const std::uint32_t* corners, const GridPoint* points, int k) {
      const auto load = [=](int i) { return low_half(points + corners[3 * i + k]); };
      first = _mm_unpacklo_epi64(load(0), load(1));
      second = _mm_unpacklo_epi64(load(2), load(3));
    }
  };
  /// From one corner to another.
  struct Way {
    __m128 x, y;

    Way(const Corners& from, const Corners& to) {
      const __m128 first = _mm_castsi128_ps(_mm_sub_epi32(to.first, from.first));
      const __m128 second = _mm_castsi128_ps(_mm_sub_epi32(to.second, from.second));
      x = _mm_cvtepi32_ps(_mm_castps_si128(_mm_shuffle_ps(first, second, _MM_SHUFFLE(2, 0, 2, 0))));
      y = _mm_cvtepi32_ps(_mm_castps_si128(_mm_shuffle_ps(first, second, _MM_SHUFFLE(3, 1, 3, 1))));
    }
  };
  /// A turn's two terms are products of differences, which floats hold, rounded to floats. Rounding keeps order, so the
  /// larger one is; where they are then equal, it is left open.
  static std::uint32_t sides_of_four(const std::uint32_t* corners, const GridPoint* points) {
    const Corners a(corners, points, 0);
    const Way u(a, Corners(corners, points, 1)), v(a, Corners(corners, points, 2));
    const __m128 plus = _mm_mul_ps(u.x, v.y), minus = _mm_mul_ps(u.y, v.x);
    const __m128i left = _mm_castps_si128(_mm_cmpgt_ps(plus, minus));
    const __m128i right = _mm_castps_si128(_mm_cmplt_ps(plus, minus));
    const __m128i words =
        _mm_or_si128(_mm_srli_epi32(left, 31), _mm_slli_epi32(_mm_srli_epi32(right, 31), 1));
    const __m128i halves = _mm_packs_epi32(words, words);
    return static_cast<std::uint32_t>(_mm_cvtsi128_si32(_mm_packus_epi16(halves, halves)));
  }
};

}  // namespace

void find_sides_sse2(const std::uint32_t* corners, std::size_t count, const GridPoint* points,
                     std::uint8_t* sides) noexcept {
  OutlineLanes<Sse2>::find_sides(corners, count, points, sides);
}
std::size_t find_near_sse2(const SegmentSearch& job, const SearchedWay& way) noexcept {
  return OutlineLanes<Sse2>::find_near(job, way);
}
void test_near_sse2(const SegmentSearch& job, const SearchedWay& way, std::size_t count) noexcept {
  OutlineLanes<Sse2>::test_near(job, way, count);
}

}  // namespace bch::detail
