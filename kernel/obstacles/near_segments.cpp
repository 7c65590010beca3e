// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/obstacles/near_segments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/runtime/kernels.hpp"

namespace bch::detail {
namespace {

using Vector = ObstaclePlace::Vector;

/// Returns what sums of coordinates may be off by.
double rounding_of(const ObstaclePlace& place) noexcept {
  return 0x1p-50 * (std::abs(place.x) + std::abs(place.y));
}

/// Returns how far boxes of segments may be that are within a distance: it is enlarged by what is rounded, and by what slack adds.
double distance_of_boxes(const ObstaclePlace& place, double distance) noexcept {
  return distance * (1 + 8 * relative_slack) + rounding_of(place);
}

/// Returns a box about a disc during its displacement.
Box box_about(const ObstaclePlace& place, Vector centre, double distance, Vector displacement) noexcept {
  const auto [x, y] = centre;
  const double wide =
      distance_of_boxes(place, distance) + 0x1p-50 * (std::abs(displacement.x) + std::abs(displacement.y));
  return {x + std::min(displacement.x, 0.0) - wide, y + std::min(displacement.y, 0.0) - wide,
          x + std::max(displacement.x, 0.0) + wide, y + std::max(displacement.y, 0.0) + wide};
}

/// Sorts numbers, and keeps one of each that is there an odd number of times.
void keep_odd(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  std::size_t kept = 0;
  for (const std::uint32_t number : numbers) {
    if (kept != 0 && numbers[kept - 1] == number)
      --kept;
    else
      numbers[kept++] = number;
  }
  numbers.resize(kept);
}

/// Returns whether the segment from one point to another crosses a segment, all in one frame. A vertex on the line of that segment belongs to one side of it, for both of
/// its segments, so that the parity of a ring's crossings tells whether the segment leaves what it encloses. Neither end of it may
/// be next to the segment. `square`: that of its length; infinite: a ray.
bool crosses(Vector from, Vector displacement, double square, Vector a, Vector b) noexcept {
  const double ax = a.x - from.x, ay = a.y - from.y, bx = b.x - from.x, by = b.y - from.y;
  const double side_a = displacement.x * ay - displacement.y * ax,
               side_b = displacement.x * by - displacement.y * bx;
  if ((side_a > 0) == (side_b > 0)) return false;
  const double along_a = displacement.x * ax + displacement.y * ay,
               along_b = displacement.x * bx + displacement.y * by;
  // A mean of both, with weights of one sign.
  const double along = (along_a * side_b - along_b * side_a) / (side_b - side_a);
  return along > 0 && along < square;
}

}  // namespace

std::uint32_t NearSegments::descend(const BoxTreeView& tree) {
  if (tree.levels == 0) return 0;
  const auto count = static_cast<std::uint32_t>(boxes_.size());
  if (hits_.size() < count) hits_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) hits_[i] = {i, 0};
  std::uint32_t size = count;
  for (std::uint32_t level = tree.levels; level-- > 0;) {
    const std::size_t capacity = 8 * std::size_t{size};
    if (next_.size() < capacity) next_.resize(2 * capacity);
    size = implementation_.kernels->overlapping_boxes(tree.blocks + tree.level_begin[level], boxes_.data(),
                                                      hits_.data(), size, next_.data());
    hits_.swap(next_);
  }
  return size;
}

std::span<const BoxHit> NearSegments::overlapping(const BoxTreeView& tree, const Box& box) {
  boxes_.assign(1, box);
  const std::uint32_t size = descend(tree);
  return std::span(hits_).first(size);
}

double NearSegments::limit_of(const ObstaclePlace& place, double distance) noexcept {
  const double most = distance_of_boxes(place, distance) * (1 + 0x1p-40);
  return most * most;
}

/// What is found is enlarged by much more than what is rounded, and by much less than what others are farther away. It is more than 0, within which
/// find() finds nothing.
double NearSegments::nearest_distance(const ObstaclePlace& place, Vec2 centre) {
  constexpr double least_distance = 1e-9;  // metres
  double least = std::numeric_limits<double>::infinity();
  visit_near(place, centre, least, [&](const LocalSegment& segment) {
    least = std::min(least, segment.square_distance(double{centre.x}, double{centre.y}));
  });
  const auto [x, y] = in_world(place, centre);
  return std::max(least_distance, std::sqrt(least) * (1 + 0x1p-40) + 0x1p-46 * (std::abs(x) + std::abs(y)));
}

std::span<LocalSegment> NearSegments::find(const ObstaclePlace& place, Vec2 centre, double distance) {
  memory_.clear();
  visit_near(place, centre, limit_of(place, distance), [&](const LocalSegment& segment) {
    if (segment.touches(double{centre.x}, double{centre.y}, distance)) memory_.push_back(segment);
  });
  return sorted(memory_);
}

std::span<LocalSegment> NearSegments::find_along(const ObstaclePlace& place, Vec2 centre, double distance,
                                                 Vector displacement) {
  memory_.clear();
  const bool moves = displacement.x != 0 || displacement.y != 0;
  const Box box = box_about(place, in_world(place, centre), distance, displacement);
  for (const BoxHit& hit : overlapping(obstacles_.segment_tree, box)) {
    const LocalSegment& segment = put(place, hit.place, visited_);
    if (is_level(segment.obstacle, body_) &&
        (moves || segment.touches(double{centre.x}, double{centre.y}, distance)))
      memory_.push_back(segment);
  }
  return sorted(memory_);
}

void NearSegments::prepare(std::span<const NearQuery> queries) {
  queries_ = queries, body_ = {}, of_point_.reset();
  boxes_.clear();
  for (const auto& [place, centre, distance, body] : queries)
    boxes_.push_back(box_about(place, in_world(place, centre), distance, {0, 0}));
  const std::uint32_t size = descend(obstacles_.segment_tree);
  if (prepared_.size() <= size) prepared_.resize(std::size_t{size} + 1);
  prepared_end_.assign(queries.size() + 1, 0);
  std::uint32_t count = 0;
  for (std::uint32_t k = 0; k < size; ++k) {
    const auto& [place, centre, distance, body] = queries[hits_[k].query];
    const LocalSegment& segment = put(place, hits_[k].place, prepared_[count]);
    const bool is_near = segment.touches(double{centre.x}, double{centre.y}, distance);
    count += is_near & is_level(segment.obstacle, body);
    prepared_end_[hits_[k].query + 1] = count;
  }
  // Those of which no box was found end where the ones before do.
  for (std::size_t i = 0; i < queries.size(); ++i)
    prepared_end_[i + 1] = std::max(prepared_end_[i], prepared_end_[i + 1]);
}

std::span<LocalSegment> NearSegments::take(std::size_t query) {
  body_ = queries_[query].body, of_point_.reset();
  const std::uint32_t begin = prepared_end_[query];
  return sorted(std::span(prepared_).subspan(begin, prepared_end_[query + 1] - begin));
}

std::span<LocalSegment> NearSegments::sorted(std::span<LocalSegment> segments) {
  if (segments.size() > 1)
    std::sort(segments.begin(), segments.end(),
              [](const LocalSegment& a, const LocalSegment& b) { return a.number < b.number; });
  return found_ = segments;
}

std::span<const std::uint32_t> NearSegments::areas_containing(const ObstaclePlace& place, Vec2 point) {
  const Vector from = place.turned(point.x, point.y);
  const AgentPoint at{place.x, place.y, from.x, from.y};
  if (at == of_point_) return areas_;
  of_point_ = at;
  areas_.clear(), about_.clear();
  const double wide = rounding_of(place), x = place.x + from.x, y = place.y + from.y;
  Box ray{x - wide, y - wide, x + wide, y + wide};
  for (const auto [query, slot] : overlapping(obstacles_.area_tree, ray)) {
    if (!is_level(obstacles_.areas[slot], body_)) continue;
    about_.push_back(obstacles_.areas[slot]);
    ray.high_x = std::max(ray.high_x, obstacles_.area_boxes[slot].high_x);
  }
  if (about_.empty()) return areas_;
  std::sort(about_.begin(), about_.end());
  for (const BoxHit& hit : overlapping(obstacles_.segment_tree, ray)) {
    const WorldSegment& segment = obstacles_.segments[hit.place];
    if (std::binary_search(about_.begin(), about_.end(), segment.obstacle) &&
        crosses(from, {1, 0}, std::numeric_limits<double>::infinity(),
                {segment.ax - place.x, segment.ay - place.y}, {segment.bx - place.x, segment.by - place.y}))
      areas_.push_back(segment.obstacle);
  }
  keep_odd(areas_);
  return areas_;
}

bool AreaSide::contains(Vec2 point) {
  const Vector at = place_.turned(double{point.x}, double{point.y});
  if (!is_known_) {
    const auto areas = near_.areas_containing(place_, point);
    is_known_ = true, first_ = at;
    return first_is_contained_ = std::binary_search(areas.begin(), areas.end(), obstacle_);
  }
  const Vector displacement{at.x - first_.x, at.y - first_.y};
  const double square = displacement.x * displacement.x + displacement.y * displacement.y;
  bool is_contained = first_is_contained_;
  for (const LocalSegment& segment : segments_) {
    const WorldSegment& world = near_.obstacles().segments[segment.slot];
    is_contained ^= crosses(first_, displacement, square, {world.ax - place_.x, world.ay - place_.y},
                            {world.bx - place_.x, world.by - place_.y});
  }
  return is_contained;
}

}  // namespace bch::detail
