// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy_split.hpp"

#include <algorithm>

namespace bch {
namespace {

double centroid(std::span<const SplitItem> items, ItemOrder order, const SplitMeasure& measure, int axis) {
  if (measure.weight > 0) return measure.moment[axis] / measure.weight;
  double sum = 0;
  for (const std::uint32_t i : order) sum += items[i].middle[axis];
  return sum / static_cast<double>(order.size());
}

/// Stable, and without a branch on an item's side: every item is written to both sides.
std::size_t partition(std::span<const SplitItem> items, ItemOrder order, int axis, double plane,
                      std::uint32_t* second) {
  std::size_t first_count = 0, second_count = 0;
  for (const std::uint32_t item : order) {
    const bool before = items[item].middle[axis] < plane;
    order[first_count] = item;
    second[second_count] = item;
    first_count += before;
    second_count += !before;
  }
  std::copy_n(second, second_count, order.begin() + static_cast<std::ptrdiff_t>(first_count));
  return first_count;
}

}  // namespace

SplitMeasure measure(std::span<const SplitItem> items, std::span<const std::uint32_t> order) {
  const SplitItem& first = items[order[0]];
  SplitMeasure result{{first.low[0], first.low[1]}, {first.high[0], first.high[1]}};
  for (const std::uint32_t i : order) {
    const SplitItem& item = items[i];
    for (int axis = 0; axis < 2; ++axis) {
      result.low[axis] = std::min(result.low[axis], item.low[axis]);
      result.high[axis] = std::max(result.high[axis], item.high[axis]);
      result.moment[axis] += item.moment[axis];
    }
    result.weight += item.weight;
  }
  return result;
}

std::size_t divide(std::span<const SplitItem> items, ItemOrder order, const SplitMeasure& measure,
                   bool through_centre, std::vector<std::uint32_t>& scratch) {
  if (scratch.size() < order.size()) scratch.resize(order.size());
  const int longer = measure.longer_axis();
  for (const int axis : {longer, 1 - longer}) {
    const double plane =
        through_centre
            ? 0.5 * (static_cast<double>(measure.low[axis]) + static_cast<double>(measure.high[axis]))
            : centroid(items, order, measure, axis);
    const std::size_t first = partition(items, order, axis, plane, scratch.data());
    if (first != 0 && first != order.size()) return first;
  }
  return order.size() / 2;
}

}  // namespace bch
