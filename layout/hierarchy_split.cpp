// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy_split.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <limits>

namespace bch {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Boxes and moments of both sides of a plane while they grow, in registers of every x86-64 processor. Which side an item
/// is on is a mask, all bits of a lane or none: on the other side zeros are added, and a minimum is taken with NaN, which
/// leaves what comes second.
class Sums {
 public:
  void add(const SplitItem& item, __m128d before, __m128d after) {
    const __m128 box = _mm_loadu_ps(item.box);
    const __m128d moment = _mm_loadu_pd(item.moment);
    box_[0] = _mm_min_ps(_mm_or_ps(_mm_castpd_ps(after), box), box_[0]);
    box_[1] = _mm_min_ps(_mm_or_ps(_mm_castpd_ps(before), box), box_[1]);
    moment_[0] = _mm_add_pd(moment_[0], _mm_and_pd(before, moment));
    moment_[1] = _mm_add_pd(moment_[1], _mm_and_pd(after, moment));
    weight_ = _mm_add_pd(weight_, _mm_and_pd(_mm_unpacklo_pd(before, after), _mm_loadu_pd(item.weight)));
  }

  void store(SplitMeasure& before, SplitMeasure& after) const {
    _mm_storeu_ps(before.box, box_[0]);
    _mm_storeu_ps(after.box, box_[1]);
    _mm_storeu_pd(before.moment, moment_[0]);
    _mm_storeu_pd(after.moment, moment_[1]);
    _mm_storel_pd(&before.weight, weight_);
    _mm_storeh_pd(&after.weight, weight_);
  }

 private:
  __m128 box_[2] = {_mm_set1_ps(infinity), _mm_set1_ps(infinity)};
  __m128d moment_[2] = {_mm_setzero_pd(), _mm_setzero_pd()}, weight_ = _mm_setzero_pd();
};

double centroid(std::span<const SplitItem> items, ItemOrder order, const SplitMeasure& measure, int axis) {
  if (measure.weight > 0) return measure.moment[axis] / measure.weight;
  double sum = 0;
  for (const std::uint32_t i : order) sum += items[i].middle[axis];
  return sum / static_cast<double>(order.size());
}

double plane(std::span<const SplitItem> items, ItemOrder order, const SplitMeasure& whole,
             bool through_centre, int axis) {
  return through_centre ? 0.5 * (whole.low(axis) + whole.high(axis)) : centroid(items, order, whole, axis);
}

/// Stable, and without a branch on an item's side: every item is written to both sides and offered to both sums.
std::size_t partition(const SplitItem* items, ItemOrder order, int axis, double plane, std::uint32_t* second,
                      SplitMeasure& before_plane, SplitMeasure& after_plane) {
  const __m128d limit = _mm_set1_pd(plane);
  Sums sums;
  std::uint32_t* first = order.data();
  std::uint32_t* const second_begin = second;
  for (const std::uint32_t i : order) {
    const SplitItem& item = items[i];
    const __m128d middle = _mm_set1_pd(item.middle[axis]), before = _mm_cmplt_pd(middle, limit);
    sums.add(item, before, _mm_cmpge_pd(middle, limit));
    const int is_before = _mm_movemask_pd(before) & 1;
    *first = i;
    *second = i;
    first += is_before;
    second += 1 - is_before;
  }
  sums.store(before_plane, after_plane);
  const std::size_t first_count = static_cast<std::size_t>(first - order.data());
  for (const std::uint32_t* i = second_begin; i != second; ++i) *first++ = *i;
  return first_count;
}

}  // namespace

SplitMeasure measure(std::span<const SplitItem> items, std::span<const std::uint32_t> order) {
  const __m128d none = _mm_setzero_pd(), all = _mm_cmpeq_pd(none, none);
  Sums sums;
  for (const std::uint32_t i : order) sums.add(items[i], all, none);
  SplitMeasure result, empty;
  sums.store(result, empty);
  return result;
}

std::size_t divide(std::span<const SplitItem> items, ItemOrder order, const SplitMeasure& whole,
                   bool through_centre, std::uint32_t* scratch, SplitMeasure& first, SplitMeasure& second) {
  const int longer = whole.longer_axis();
  for (const int axis : {longer, 1 - longer}) {
    const double at = plane(items, order, whole, through_centre, axis);
    const std::size_t count = partition(items.data(), order, axis, at, scratch, first, second);
    if (count != 0 && count != order.size()) return count;
  }
  const std::size_t half = order.size() / 2;
  first = measure(items, order.first(half));
  second = measure(items, order.subspan(half));
  return half;
}

void divide_pair(std::span<const SplitItem> items, ItemOrder order, const SplitMeasure& whole,
                 bool through_centre) {
  const int longer = whole.longer_axis();
  const SplitItem &a = items[order[0]], &b = items[order[1]];
  for (const int axis : {longer, 1 - longer}) {
    const double at = plane(items, order, whole, through_centre, axis);
    const bool is_a_before = a.middle[axis] < at, is_b_before = b.middle[axis] < at;
    if (is_a_before == is_b_before) continue;
    const std::uint32_t first = order[is_b_before], second = order[is_a_before];
    order[0] = first, order[1] = second;
    return;
  }
}

}  // namespace bch
