// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <emmintrin.h>

#include "layout/outline_lanes.hpp"

namespace bch {
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
  struct Turns {
    std::uint32_t left, right;
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

  static __m128i gather(const GridPoint* points, std::uint32_t v, std::uint32_t w) {
    return _mm_unpacklo_epi64(low_half(points + v), low_half(points + w));
  }
  /// Of two triangles.
  static Turns turns_of_two(const std::uint32_t* corners, const GridPoint* points) {
    const __m128i a = gather(points, corners[0], corners[3]);
    const __m128i u = _mm_sub_epi32(gather(points, corners[1], corners[4]), a);
    const __m128i v =
        _mm_shuffle_epi32(_mm_sub_epi32(gather(points, corners[2], corners[5]), a), _MM_SHUFFLE(2, 3, 0, 1));
    const __m128d first = _mm_cvtepi32_pd(u) * _mm_cvtepi32_pd(v);
    const __m128d second = _mm_cvtepi32_pd(high_half(u)) * _mm_cvtepi32_pd(high_half(v));
    const __m128d plus = _mm_unpacklo_pd(first, second), minus = _mm_unpackhi_pd(first, second);
    return {static_cast<std::uint32_t>(_mm_movemask_pd(_mm_cmpgt_pd(plus, minus))),
            static_cast<std::uint32_t>(_mm_movemask_pd(_mm_cmplt_pd(plus, minus)))};
  }
  static Turns turns(const std::uint32_t* corners, const GridPoint* points) {
    const Turns low = turns_of_two(corners, points), high = turns_of_two(corners + 6, points);
    return {low.left | high.left << 2, low.right | high.right << 2};
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

}  // namespace bch
