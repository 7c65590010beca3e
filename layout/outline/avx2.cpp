// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <immintrin.h>

#include "layout/outline/lanes.hpp"

namespace bch::detail {
namespace {

struct Avx2 {
  using Doubles = __m256d;
  static constexpr std::size_t width = 4;
  static constexpr std::size_t bits_per_box = 2;

  struct Ends {
    Doubles ax, ay, bx, by;
  };
  struct Cells {
    __m256i min_x, min_y, max_x, max_y;

    explicit Cells(const SearchedWay& way)
        : min_x(_mm256_set1_epi16(way.min_x)),
          min_y(_mm256_set1_epi16(way.min_y)),
          max_x(_mm256_set1_epi16(way.max_x)),
          max_y(_mm256_set1_epi16(way.max_y)) {}
  };

  static Doubles all(double value) { return _mm256_set1_pd(value); }
  static void store(double* to, Doubles value) { _mm256_storeu_pd(to, value); }
  template <class Mask>
  static std::uint64_t bits_of(Mask mask) {
    return static_cast<std::uint64_t>(_mm256_movemask_pd((__m256d)mask));
  }

  static Ends load(const Segment* segments, const std::uint32_t* which) {
    const auto segment = [=](int i) { return _mm_loadu_si128((const __m128i*)(segments + which[i])); };
    const __m128i a_low = _mm_unpacklo_epi32(segment(0), segment(1));
    const __m128i a_high = _mm_unpacklo_epi32(segment(2), segment(3));
    const __m128i b_low = _mm_unpackhi_epi32(segment(0), segment(1));
    const __m128i b_high = _mm_unpackhi_epi32(segment(2), segment(3));
    return {_mm256_cvtepi32_pd(_mm_unpacklo_epi64(a_low, a_high)),
            _mm256_cvtepi32_pd(_mm_unpackhi_epi64(a_low, a_high)),
            _mm256_cvtepi32_pd(_mm_unpacklo_epi64(b_low, b_high)),
            _mm256_cvtepi32_pd(_mm_unpackhi_epi64(b_low, b_high))};
  }

  static std::uint32_t meeting(const BoxBlock& block, const Cells& box) {
    const auto load = [](const std::int16_t* cells) { return _mm256_load_si256((const __m256i*)cells); };
    const __m256i apart = _mm256_or_si256(_mm256_or_si256(_mm256_cmpgt_epi16(load(block.min_x), box.max_x),
                                                          _mm256_cmpgt_epi16(load(block.min_y), box.max_y)),
                                          _mm256_or_si256(_mm256_cmpgt_epi16(box.min_x, load(block.max_x)),
                                                          _mm256_cmpgt_epi16(box.min_y, load(block.max_y))));
    return ~static_cast<std::uint32_t>(_mm256_movemask_epi8(apart)) & 0x55555555;
  }
  static std::size_t boxes(std::uint32_t bits) { return static_cast<std::size_t>(__builtin_popcount(bits)); }

  /// Corner k of four triangles.
  static __m256i gather(const std::uint32_t* corners, const GridPoint* points, int k) {
    const auto two = [=](int t) {
      const auto load = [=](int i) { return _mm_loadl_epi64((const __m128i*)(points + corners[3 * i + k])); };
      return _mm_unpacklo_epi64(load(t), load(t + 1));
    };
    return _mm256_inserti128_si256(_mm256_castsi128_si256(two(0)), two(2), 1);
  }
  /// Computes the sides of four triangles by exact products. Floats, eight at a time, take as long, because
  /// the loads decide the time.
  static std::uint32_t sides_of_four(const std::uint32_t* corners, const GridPoint* points) {
    const __m256i a = gather(corners, points, 0);
    const __m256i u = _mm256_sub_epi32(gather(corners, points, 1), a);
    const __m256i v = _mm256_sub_epi32(gather(corners, points, 2), a);
    const __m256i plus = _mm256_mul_epi32(u, _mm256_srli_epi64(v, 32));
    const __m256i minus = _mm256_mul_epi32(_mm256_srli_epi64(u, 32), v);
    const auto negative = [](__m256i turn) {
      return static_cast<std::uint32_t>(_mm256_movemask_pd(_mm256_castsi256_pd(turn)));
    };
    const std::uint32_t left = negative(_mm256_sub_epi64(minus, plus)),
                        right = negative(_mm256_sub_epi64(plus, minus));
    // Four bits spread to the lowest bits of four bytes.
    constexpr std::uint32_t spread = 0x00204081, lowest = 0x01010101;
    return (left * spread & lowest) | (right * spread & lowest) << 1;
  }
};

}  // namespace

void find_sides_avx2(const std::uint32_t* corners, std::size_t count, const GridPoint* points,
                     std::uint8_t* sides) noexcept {
  OutlineLanes<Avx2>::find_sides(corners, count, points, sides);
}
std::size_t find_near_avx2(const SegmentSearch& job, const SearchedWay& way) noexcept {
  return OutlineLanes<Avx2>::find_near(job, way);
}
void test_near_avx2(const SegmentSearch& job, const SearchedWay& way, std::size_t count) noexcept {
  OutlineLanes<Avx2>::test_near(job, way, count);
}

}  // namespace bch::detail
