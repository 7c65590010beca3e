// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline_walk.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace bch {
namespace {

/// A face bounded by n segments has O(n alpha(n)) stretches (Pollack, Sharir, Sifrony, "Separating two simple
/// polygons by a sequence of translations", 1988), with alpha(n) <= 4 for any n that fits a computer.
constexpr std::size_t most_stretches_per_segment = 256;

/// Where a segment with one end on the right of a line and the other not meets it. With O the line's start, D
/// its direction, r and l these ends and D' = r - l: at D' x (l - O) / D x (l - r) of the line, and at
/// D x (l - O) / D x (l - r) of the way from l to r.
struct Crossing {
  Crossing(const Place& line, const Segment& segment) {
    const auto [a, b] = segment;
    const std::int64_t side_a = cross(line.direction(), a - line.from),
                       side_b = cross(line.direction(), b - line.from);
    left = side_a < 0 ? b : a, right = side_a < 0 ? a : b;
    from_left = std::max(side_a, side_b);
    whole = from_left - std::min(side_a, side_b);
    along = cross(way(), left - line.from);
  }
  GridVector way() const { return right - left; }

  GridPoint left, right;
  std::int64_t from_left, along, whole;
};

}  // namespace

OutlineWalk::OutlineWalk(const OutlineTopology& topology, OutlineCandidates& candidates)
    : topology_(&topology),
      candidates_(&candidates),
      near_(topology.manifold.size() + topology.uses.size() + BoxTree::width),
      crossing_(near_.size()),
      ending_(near_.size()),
      touched_(topology.island_vertex.size()) {}

void OutlineWalk::begin_pose() {
  segments_ = candidates_->segments();
  std::fill(touched_.begin(), touched_.end(), std::uint8_t{0});
}

void OutlineWalk::walk(GridPoint start, std::vector<Stretch>& contour) {
  const std::size_t first = contour.size(), most = first + most_stretches_per_segment * segments_.size();
  find_near({start, start, {}}, start);
  take_first_direction(start, {-1, 0}, contour.emplace_back());
  while (contour.size() <= most) {
    contour.emplace_back();  // filled in place: copies would wait for what has just been written in parts
    const Stretch& now = contour[contour.size() - 2];
    Stretch& next = contour.back();
    find_near(now.begin, now.rounded_begin);
    if (take_first_crossing(now.begin, next)) continue;
    const GridPoint end = now.begin.to;
    take_first_direction(end, now.begin.from - end, next);
    if (end == start && same_direction(next.begin.direction(), contour[first].begin.direction()))
      return contour.pop_back();
  }
  throw std::logic_error("outline: the walk from (" + std::to_string(start.x) + ", " +
                         std::to_string(start.y) + ") on the grid does not return");
}

/// Collects candidates near the way from a place to the end of its line. Most are neither crossing nor ending,
/// and there is no telling which: the lists are written without a branch.
void OutlineWalk::find_near(const Place& here, GridPoint rounded_here) {
  const GridPoint from = rounded_here, to = here.to;
  const CoarseBox box({std::min(from.x - 1, to.x), std::min(from.y - 1, to.y)},
                      {std::max(from.x + 1, to.x), std::max(from.y + 1, to.y)});
  const std::size_t count = candidates_->boxes().find_meeting(box, near_.data());
  const std::uint32_t* near = near_.data();
  std::uint32_t *crossing = crossing_.data(), *ending = ending_.data();
  const Segment* segments = segments_.data();
  const GridVector way = here.direction();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [a, b] = segments[near[i]];
    const GridVector from_a = here.from - a, from_b = here.from - b, to_a = a - to, to_b = b - to;
    const std::int64_t side_a = cross(from_a, way), side_b = cross(from_b, way);
    *crossing = near[i];
    crossing += (side_a < 0) != (side_b < 0);
    *ending = near[i];
    ending += (to_a.x * to_b.x <= 0) & (to_a.y * to_b.y <= 0);
  }
  crossing_count_ = static_cast<std::size_t>(crossing - crossing_.data());
  ending_count_ = static_cast<std::size_t>(ending - ending_.data());
}

/// Fills `next` with the first way to the right after `here` and before the end of its line, if there is one.
bool OutlineWalk::take_first_crossing(const Place& here, Stretch& next) {
  constexpr std::uint32_t none = 0xffffffff;
  std::uint32_t first = none;
  Fraction nearest;
  for (std::size_t i = 0; i < crossing_count_; ++i) {
    const Crossing crossing(here, segments_[crossing_[i]]);
    if (crossing.along <= 0 || crossing.along >= crossing.whole) continue;
    const Fraction at(crossing.along, crossing.whole);
    if (compare(at, here.at) <= 0) continue;
    const int order = first != none ? compare(at, nearest) : -1;
    if (order > 0) continue;
    if (order == 0 && cross(crossing.way(), Crossing(here, segments_[first]).way()) <= 0) continue;
    nearest = at;
    first = crossing_[i];
  }
  if (first == none) return false;
  const Crossing crossing(here, segments_[first]);
  next.begin.from = crossing.left;
  next.begin.to = crossing.right;
  next.begin.at = {crossing.from_left, crossing.whole};
  next.rounded_begin = rounded(next.begin);
  touch(first);
  return true;
}

/// Fills `next` with the first way counter-clockwise from `back` of all that candidates offer from a grid point.
void OutlineWalk::take_first_direction(GridPoint at, GridVector back, Stretch& next) {
  GridPoint first = at;
  std::uint32_t first_segment = 0;
  const auto consider = [&](GridPoint end, std::uint32_t segment) {
    if (end == at || (!(first == at) && !swept_before(back, end - at, first - at))) return;
    first = end;
    first_segment = segment;
  };
  for (std::size_t i = 0; i < ending_count_; ++i) {
    const auto [a, b] = segments_[ending_[i]];
    if (cross(b - a, at - a) != 0) continue;
    consider(a, ending_[i]);
    consider(b, ending_[i]);
  }
  next.begin.from = next.rounded_begin = at;
  next.begin.to = first;
  next.begin.at = {};
  touch(first_segment);
}

void OutlineWalk::touch(std::uint32_t segment) {
  touched_[topology_->island[candidates_->vertex(segment)]] = 1;
}

}  // namespace bch
