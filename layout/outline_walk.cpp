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
  follow(first_direction(start, {-1, 0}), contour);
  const GridVector first_way = contour[first].begin.direction();
  while (contour.size() <= most) {
    const Stretch now = contour.back();
    find_near(now.begin, now.rounded_begin);
    Turn turn = first_crossing(now.begin);
    if (!turn.found) {
      const GridPoint end = now.begin.to;
      turn = first_direction(end, now.begin.from - end);
      if (end == start && same_direction(turn.to.direction(), first_way)) return;
    }
    follow(turn, contour);
  }
  throw std::logic_error("outline: the walk from (" + std::to_string(start.x) + ", " +
                         std::to_string(start.y) + ") on the grid does not return");
}

void OutlineWalk::follow(const Turn& turn, std::vector<Stretch>& contour) {
  contour.push_back({turn.to, rounded(turn.to)});
  touched_[topology_->island[candidates_->vertex(turn.segment)]] = 1;
}

/// Collects candidates near the way from a place to the end of its line. Most are neither crossing nor ending,
/// and there is no telling which: the lists are written without a branch.
///
/// Only a segment with one end on the right of the line and the other not leads there. With O the line's start,
/// D its direction, r and l these ends, the line is met at D' x (l - O) / D x (l - r), where D' = r - l.
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

/// The first way to the right after `here` and before the end of its line.
OutlineWalk::Turn OutlineWalk::first_crossing(const Place& here) const {
  Turn first{{}, 0, false};
  Fraction nearest;
  const GridVector way = here.direction();
  for (std::size_t i = 0; i < crossing_count_; ++i) {
    const auto [a, b] = segments_[crossing_[i]];
    const std::int64_t side_a = cross(way, a - here.from), side_b = cross(way, b - here.from);
    const GridPoint left = side_a < 0 ? b : a, right = side_a < 0 ? a : b;
    const std::int64_t from_left = std::max(side_a, side_b), whole = from_left - std::min(side_a, side_b);
    const std::int64_t along = cross(right - left, left - here.from);
    if (along <= 0 || along >= whole) continue;
    const Fraction at(along, whole);
    if (compare(at, here.at) <= 0) continue;
    const int order = first.found ? compare(at, nearest) : -1;
    if (order > 0 || (order == 0 && cross(right - left, first.to.direction()) <= 0)) continue;
    nearest = at;
    first = {{left, right, {from_left, whole}}, crossing_[i], true};
  }
  return first;
}

/// Of all ways that candidates offer from a grid point, the first counter-clockwise from `back`.
OutlineWalk::Turn OutlineWalk::first_direction(GridPoint at, GridVector back) const {
  Turn first{{}, 0, false};
  const auto consider = [&](GridPoint end, std::uint32_t segment) {
    if (end == at || (first.found && !swept_before(back, end - at, first.to.direction()))) return;
    first = {{at, end, {}}, segment, true};
  };
  for (std::size_t i = 0; i < ending_count_; ++i) {
    const auto [a, b] = segments_[ending_[i]];
    if (cross(b - a, at - a) != 0) continue;
    consider(a, ending_[i]);
    consider(b, ending_[i]);
  }
  return first;
}

}  // namespace bch
