// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/split.hpp"

#include <emmintrin.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bch::detail {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Boxes and sums of both sides of a plane while they grow, in registers of every x86-64 processor. Which side an item
/// is on is a mask, all bits of a lane or none: on the other side zeros are added, and a minimum is taken with NaN, which
/// leaves what comes second.
class Sums {
 public:
  void add(const SplitItem& item, __m128 before, __m128 after) {
    const __m128 box = _mm_load_ps(item.box), sums = _mm_load_ps(item.sums);
    box_[0] = _mm_min_ps(_mm_or_ps(after, box), box_[0]);
    box_[1] = _mm_min_ps(_mm_or_ps(before, box), box_[1]);
    sums_[0] = _mm_add_ps(sums_[0], _mm_and_ps(before, sums));
    sums_[1] = _mm_add_ps(sums_[1], _mm_and_ps(after, sums));
  }

  void store(SplitMeasure& before, SplitMeasure& after) const {
    _mm_storeu_ps(before.box, box_[0]);
    _mm_storeu_ps(after.box, box_[1]);
    _mm_storeu_ps(before.sums, sums_[0]);
    _mm_storeu_ps(after.sums, sums_[1]);
  }

 private:
  __m128 box_[2] = {_mm_set1_ps(infinity), _mm_set1_ps(infinity)};
  __m128 sums_[2] = {_mm_setzero_ps(), _mm_setzero_ps()};
};

/// Every point with a smaller coordinate is before it; in every lane.
struct Plane {
  int axis;
  __m128 at;
};

/// Returns the mean of all items' middles, for items whose lengths cannot serve as weights.
float mean(const SplitItems& items, ItemList list, std::size_t axis) {
  float sum = 0;
  for (const std::uint32_t i : list) sum += items.middle[axis][i];
  return sum / static_cast<float>(list.size());
}

/// Returns the plane across the longer axis, or across the other one. Both axes are computed, because which
/// is longer is known as late as the planes, and cannot be predicted.
Plane plane(const SplitItems& items, ItemList list, const SplitMeasure& whole, bool through_centre,
            bool across_longer) {
  const __m128 box = _mm_loadu_ps(whole.box), sums = _mm_loadu_ps(whole.sums);
  const __m128 minus_high = _mm_movehl_ps(box, box);
  __m128 planes;
  if (through_centre)
    planes = _mm_mul_ps(_mm_set1_ps(0.5f), _mm_sub_ps(box, minus_high));
  else if (whole.sums[2] > 0)
    planes = _mm_div_ps(sums, _mm_shuffle_ps(sums, sums, _MM_SHUFFLE(2, 2, 2, 2)));
  else
    planes = _mm_setr_ps(mean(items, list, 0), mean(items, list, 1), 0, 0);
  const __m128 minus_extents = _mm_add_ps(box, minus_high);
  const __m128 of_y = _mm_shuffle_ps(minus_extents, minus_extents, _MM_SHUFFLE(1, 1, 1, 1)),
               of_x = _mm_shuffle_ps(minus_extents, minus_extents, _MM_SHUFFLE(0, 0, 0, 0));
  const __m128 is_y = across_longer ? _mm_cmplt_ps(of_y, of_x) : _mm_cmpnlt_ps(of_y, of_x);
  const __m128 x = _mm_shuffle_ps(planes, planes, _MM_SHUFFLE(0, 0, 0, 0)),
               y = _mm_shuffle_ps(planes, planes, _MM_SHUFFLE(1, 1, 1, 1));
  return {_mm_movemask_ps(is_y) & 1, _mm_or_ps(_mm_and_ps(is_y, y), _mm_andnot_ps(is_y, x))};
}

/// Stable, and without a branch on an item's side: every item is written to both sides and offered to both sums.
std::size_t partition(const SplitItems& items, ItemList list, const Plane& plane, std::uint32_t* first_list,
                      std::uint32_t* second_list, SplitMeasure& before_plane, SplitMeasure& after_plane) {
  const float* const middle = items.middle[static_cast<std::size_t>(plane.axis)].data();
  const SplitItem* const all = items.items.data();
  const __m128 limit = plane.at;
  Sums sums;
  std::uint32_t* first = first_list;
  for (const std::uint32_t i : list) {
    const __m128 at = _mm_set1_ps(middle[i]), before = _mm_cmplt_ps(at, limit);
    sums.add(all[i], before, _mm_cmpge_ps(at, limit));
    const int is_before = _mm_movemask_ps(before) & 1;
    *first = i;
    *second_list = i;
    first += is_before;
    second_list += 1 - is_before;
  }
  sums.store(before_plane, after_plane);
  return static_cast<std::size_t>(first - first_list);
}

}  // namespace

SplitMeasure measure(const SplitItems& items, ItemList list) {
  const __m128 none = _mm_setzero_ps(), all = _mm_cmpeq_ps(none, none);
  Sums sums;
  for (const std::uint32_t i : list) sums.add(items.items[i], all, none);
  SplitMeasure result, empty;
  sums.store(result, empty);
  return result;
}

std::size_t divide(const SplitItems& items, ItemList list, const SplitMeasure& whole, bool through_centre,
                   std::uint32_t* first_list, std::uint32_t* second_list, SplitMeasure& first,
                   SplitMeasure& second) {
  for (const bool across_longer : {true, false}) {
    const Plane at = plane(items, list, whole, through_centre, across_longer);
    const std::size_t count = partition(items, list, at, first_list, second_list, first, second);
    if (count != 0 && count != list.size()) return count;
    // What the list stood in may have been written to; all of it went to one side.
    list = {count == 0 ? second_list : first_list, list.size()};
  }
  const std::size_t half = list.size() / 2;
  first = measure(items, list.first(half));
  second = measure(items, list.subspan(half));
  std::copy_n(list.begin(), half, first_list);
  std::copy(list.begin() + static_cast<std::ptrdiff_t>(half), list.end(), second_list);
  return half;
}

void divide_pair(const SplitItems& items, ItemList list, const SplitMeasure& whole, bool through_centre,
                 std::uint32_t* both) {
  const std::uint32_t a = list[0], b = list[1];
  both[0] = a, both[1] = b;
  for (const bool across_longer : {true, false}) {
    const Plane plane = detail::plane(items, list, whole, through_centre, across_longer);
    const auto& middle = items.middle[static_cast<std::size_t>(plane.axis)];
    const float at = _mm_cvtss_f32(plane.at);
    const bool is_a_before = middle[a] < at, is_b_before = middle[b] < at;
    if (is_a_before == is_b_before) continue;
    both[0] = is_b_before ? b : a, both[1] = is_b_before ? a : b;
    return;
  }
}

}  // namespace bch::detail
