// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline_winding.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <bit>

namespace bch {
namespace {

constexpr std::size_t width = 4;

/// Whether a point of the stretch's line is between the ends of the stretch.
bool between(const Place& begin, const Place& end, GridPoint point) {
  const GridVector way = begin.direction();
  const bool along_x = way.x != 0;
  const int from_begin = along_x ? compare_x(begin, point.x) : compare_y(begin, point.y);
  const int from_end = along_x ? compare_x(end, point.x) : compare_y(end, point.y);
  const bool forward = along_x ? way.x > 0 : way.y > 0;
  return forward ? from_begin <= 0 && from_end >= 0 : from_begin >= 0 && from_end <= 0;
}

}  // namespace

void ContourCover::assign(std::span<const Stretch> contour) {
  contour_ = contour;
  const std::size_t padded = (contour.size() + width - 1) / width * width + 1;
  x_.resize(std::max(x_.size(), padded));
  y_.resize(x_.size());
  for (std::size_t i = 0; i < padded; ++i) {
    const GridPoint begin = contour[i < contour.size() ? i : 0].rounded_begin;
    x_[i] = begin.x, y_[i] = begin.y;
  }
}

/// The winding number by the stretches that a ray from the point along x meets. It meets none that is below or above
/// the point, or behind it, by more than what is rounded.
bool ContourCover::covers(GridPoint point) const {
  const __m128i low = _mm_set1_epi32(point.y - 2), high = _mm_set1_epi32(point.y + 2),
                behind = _mm_set1_epi32(point.x - 2);
  const auto load = [](const std::int32_t* four) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(four));
  };
  int winding = 0;
  for (std::size_t i = 0; i < contour_.size(); i += width) {
    const __m128i y = load(&y_[i]), next_y = load(&y_[i + 1]);
    const __m128i is_high = _mm_or_si128(_mm_cmpgt_epi32(y, low), _mm_cmpgt_epi32(next_y, low)),
                  is_low = _mm_or_si128(_mm_cmplt_epi32(y, high), _mm_cmplt_epi32(next_y, high)),
                  is_ahead = _mm_or_si128(_mm_cmpgt_epi32(load(&x_[i]), behind),
                                          _mm_cmpgt_epi32(load(&x_[i + 1]), behind));
    const __m128i is_near = _mm_and_si128(_mm_and_si128(is_high, is_low), is_ahead);
    for (int open = _mm_movemask_ps(_mm_castsi128_ps(is_near)); open != 0; open &= open - 1) {
      const std::size_t k = i + static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(open)));
      if (k >= contour_.size()) break;
      const Place &begin = contour_[k].begin, &end = contour_[k + 1 < contour_.size() ? k + 1 : 0].begin;
      const std::int64_t side = cross(begin.direction(), point - begin.from);
      if (side == 0 && between(begin, end, point)) return true;
      const bool begins_above = compare_y(begin, point.y) > 0, ends_above = compare_y(end, point.y) > 0;
      if (begins_above == ends_above) continue;
      if (ends_above && side > 0) ++winding;
      if (begins_above && side < 0) --winding;
    }
  }
  return winding != 0;
}

}  // namespace bch
