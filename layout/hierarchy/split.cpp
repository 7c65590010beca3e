// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/split.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "layout/simd/lanes.hpp"

namespace bch::detail {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

using Simd = BaseLanes;
using Float = Simd::Float;

/// Boxes and sums of both sides of a plane while they grow. Which side an item is on is a mask, all lanes or none: on
/// the other side zeros are added, and a minimum is taken with NaN, which leaves what comes second.
class Sums {
 public:
  void add(const SplitItem& item, Simd::Mask before, Simd::Mask after) {
    const Float box = Float::load_aligned(item.box), sums = Float::load_aligned(item.sums);
    box_[0] = Simd::min(Simd::nan_where(after, box), box_[0]);
    box_[1] = Simd::min(Simd::nan_where(before, box), box_[1]);
    sums_[0] = sums_[0] + Simd::zero_unless(before, sums);
    sums_[1] = sums_[1] + Simd::zero_unless(after, sums);
  }

  void store(SplitMeasure& before, SplitMeasure& after) const {
    Simd::store(before.box, box_[0]);
    Simd::store(after.box, box_[1]);
    Simd::store(before.sums, sums_[0]);
    Simd::store(after.sums, sums_[1]);
  }

 private:
  Float box_[2] = {Float(infinity), Float(infinity)};
  Float sums_[2] = {Float(0.0f), Float(0.0f)};
};

/// Every point with a smaller coordinate is before it.
struct Plane {
  std::size_t axis;
  float at;
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
  const auto at = [&](std::size_t axis) {
    if (through_centre) return 0.5f * (whole.box[axis] - whole.box[2 + axis]);
    if (whole.sums[2] > 0) return whole.sums[axis] / whole.sums[2];
    return mean(items, list, axis);
  };
  const float planes[] = {at(0), at(1)};
  const bool y_is_longer = whole.box[1] + whole.box[3] < whole.box[0] + whole.box[2];
  const std::size_t axis = y_is_longer == across_longer;
  return {axis, planes[axis]};
}

/// Stable, and without a branch on an item's side: every item is written to both sides and offered to both sums.
std::size_t partition(const SplitItems& items, ItemList list, const Plane& plane, std::uint32_t* first_list,
                      std::uint32_t* second_list, SplitMeasure& before_plane, SplitMeasure& after_plane) {
  const float* const middle = items.middle[plane.axis].data();
  const SplitItem* const all = items.items.data();
  const Float limit(plane.at);
  Sums sums;
  std::uint32_t* first = first_list;
  for (const std::uint32_t i : list) {
    const Float at(middle[i]);
    const Simd::Mask before = at < limit;
    sums.add(all[i], before, at >= limit);
    const std::uint32_t is_before = Simd::bits(before) & 1;
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
  Sums sums;
  for (const std::uint32_t i : list) sums.add(items.items[i], Simd::Mask(true), Simd::Mask(false));
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
    const auto& middle = items.middle[plane.axis];
    const bool is_a_before = middle[a] < plane.at, is_b_before = middle[b] < plane.at;
    if (is_a_before == is_b_before) continue;
    both[0] = is_b_before ? b : a, both[1] = is_b_before ? a : b;
    return;
  }
}

}  // namespace bch::detail
