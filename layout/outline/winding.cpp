// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/winding.hpp"

#include <algorithm>
#include <bit>
#include <optional>

#include "layout/simd/lanes.hpp"

namespace bch::detail {
namespace {

using Simd = BaseLanes;

/// The number of stretches that are tested together.
constexpr std::size_t width = Simd::width;
/// Stretches with a box of their own, by which most of a long contour is left aside.
constexpr std::size_t part_size = 64;
static_assert(part_size % width == 0);

/// Returns whether a point of the stretch's line is between the ends of the stretch.
bool between(const Place& begin, const Place& end, GridPoint point) {
  const GridVector direction = begin.direction();
  const bool along_x = direction.x != 0;
  const int from_begin = along_x ? compare_x(begin, point.x) : compare_y(begin, point.y);
  const int from_end = along_x ? compare_x(end, point.x) : compare_y(end, point.y);
  const bool forward = along_x ? direction.x > 0 : direction.y > 0;
  return forward ? from_begin <= 0 && from_end >= 0 : from_begin >= 0 && from_end <= 0;
}

/// A part of a contour: some of its stretches and the first of the next ones.
struct ContourPart {
  std::span<const Stretch> contour;
  std::size_t first, last;
  const std::int32_t *x, *y;  ///< where the contour's stretches begin
};

/// How often the part goes round the point, counter-clockwise, by the stretches that a ray from there along x meets;
/// nothing where the point is on it. The ray meets no stretch that is below or above the point, or behind it, by more
/// than what is rounded.
std::optional<int> winding(const ContourPart& part, GridPoint point) {
  const Simd::Ints low(point.y - 2), high(point.y + 2), behind(point.x - 2);
  const auto& contour = part.contour;
  int turns = 0;
  for (std::size_t i = part.first; i < part.last; i += width) {
    const Simd::Ints y = Simd::load(part.y + i), next_y = Simd::load(part.y + i + 1);
    const auto is_high = (y > low) | (next_y > low), is_low = (high > y) | (high > next_y),
               is_ahead = (Simd::load(part.x + i) > behind) | (Simd::load(part.x + i + 1) > behind);
    for (std::uint32_t open = Simd::bits(is_high & is_low & is_ahead); open != 0; open &= open - 1) {
      const std::size_t k = i + static_cast<std::size_t>(std::countr_zero(open));
      if (k >= part.last) break;
      const Place &begin = contour[k].begin, &end = contour[k + 1 < contour.size() ? k + 1 : 0].begin;
      const std::int64_t side = cross(begin.direction(), point - begin.from);
      if (side == 0 && between(begin, end, point)) return std::nullopt;
      const bool begins_above = compare_y(begin, point.y) > 0, ends_above = compare_y(end, point.y) > 0;
      if (begins_above == ends_above) continue;
      if (ends_above && side > 0) ++turns;
      if (begins_above && side < 0) --turns;
    }
  }
  return turns;
}

}  // namespace

void ContourCovers::clear() {
  x_.clear(), y_.clear(), boxes_.clear();
  begin_.assign(1, 0), boxes_begin_.assign(1, 0);
}

void ContourCovers::add(std::span<const Stretch> contour) {
  const std::size_t at = x_.size(), padded = (contour.size() + width - 1) / width * width + 1;
  for (std::size_t i = 0; i < padded; ++i) {
    const GridPoint begin = contour[i < contour.size() ? i : 0].rounded_begin;
    x_.push_back(begin.x), y_.push_back(begin.y);
  }
  for (std::size_t first = 0; first < contour.size(); first += part_size) {
    GridBox& box = boxes_.emplace_back(empty_box);
    // A part ends where the next one begins.
    const std::size_t end = at + std::min(first + part_size, contour.size());
    for (std::size_t i = at + first; i <= end; ++i) enlarge(box, {{x_[i], y_[i]}, {x_[i], y_[i]}});
  }
  begin_.push_back(x_.size());
  boxes_begin_.push_back(boxes_.size());
}

bool ContourCovers::covers(std::size_t i, std::span<const Stretch> contour, GridPoint point) const {
  const auto is_above = [&](std::size_t k) {
    return compare_y(contour[k < contour.size() ? k : 0].begin, point.y) > 0;
  };
  int turns = 0;
  for (std::size_t b = boxes_begin_[i]; b < boxes_begin_[i + 1]; ++b) {
    const GridBox& box = boxes_[b];
    if (box.high.y < point.y - 1 || box.low.y > point.y + 1 || box.high.x < point.x - 1) continue;
    const std::size_t first = part_size * (b - boxes_begin_[i]);
    const std::size_t last = std::min(first + part_size, contour.size());
    if (box.low.x > point.x + 1) {
      // All of the part is ahead of the point: only the sides of the ray on which it begins and ends count.
      turns += is_above(last) - is_above(first);
      continue;
    }
    const auto more = winding({contour, first, last, &x_[begin_[i]], &y_[begin_[i]]}, point);
    if (!more) return true;
    turns += *more;
  }
  return turns != 0;
}

}  // namespace bch::detail
