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

/// Places the segment in a slot in the frame of an agent.
/// Returns: whether it is within a distance of a point there, but for its slack.
bool is_near(const ObstaclePlace& place, Vec2 centre, double distance, const WorldSegment* segments,
             std::uint32_t slot, LocalSegment& to) noexcept {
  const WorldSegment& world = segments[slot];
  const double dx = world.ax - place.x, dy = world.ay - place.y;
  const double from = dx * world.x + dy * world.y;
  const Vector along = place.turned_back(world.x, world.y);
  to = {along.x,
        along.y,
        dy * world.x - dx * world.y,
        from,
        from + world.length,
        slack_share * (std::abs(dx) + std::abs(dy) + world.length),
        slot,
        world.number,
        world.obstacle};
  return to.touches(double{centre.x}, double{centre.y}, distance);
}

/// Returns how far boxes of segments may be that are within a distance: it is enlarged by what is rounded, and by what slack adds.
double distance_of_boxes(const ObstaclePlace& place, double distance) noexcept {
  return distance * (1 + 8 * slack_share) + rounding_of(place);
}

Vector in_world(const ObstaclePlace& place, Vec2 point) noexcept {
  const auto [x, y] = place.turned(double{point.x}, double{point.y});
  return {place.x + x, place.y + y};
}

/// Returns a box about a disc on its way.
Box box_about(const ObstaclePlace& place, Vec2 centre, double distance, Vector way) noexcept {
  const auto [x, y] = in_world(place, centre);
  const double wide = distance_of_boxes(place, distance) + 0x1p-50 * (std::abs(way.x) + std::abs(way.y));
  return {x + std::min(way.x, 0.0) - wide, y + std::min(way.y, 0.0) - wide, x + std::max(way.x, 0.0) + wide,
          y + std::max(way.y, 0.0) + wide};
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

/// Returns the distance within which find() finds what has a square distance. It is more than that by much more than what is rounded, and by
/// much less than what others are farther away; and more than 0, within which find() finds nothing. Far ends of the segment round more,
/// and find() adds their slack.
double distance_of_nearest(double square, Vector from) noexcept {
  constexpr double least_distance = 1e-9;  // metres
  return std::max(least_distance,
                  std::sqrt(square) * (1 + 0x1p-40) + 0x1p-46 * (std::abs(from.x) + std::abs(from.y)));
}

}  // namespace

bool crosses(Vector from, Vector way, double square, Vector a, Vector b) noexcept {
  const double ax = a.x - from.x, ay = a.y - from.y, bx = b.x - from.x, by = b.y - from.y;
  const double side_a = way.x * ay - way.y * ax, side_b = way.x * by - way.y * bx;
  if ((side_a > 0) == (side_b > 0)) return false;
  const double along_a = way.x * ax + way.y * ay, along_b = way.x * bx + way.y * by;
  // A mean of both, with weights of one sign.
  const double along = (along_a * side_b - along_b * side_a) / (side_b - side_a);
  return along > 0 && along < square;
}

std::uint32_t NearSegments::descend(const BoxTreeView& tree) {
  if (tree.levels == 0) return 0;
  const auto count = static_cast<std::uint32_t>(boxes_.size());
  if (hits_.size() < count) hits_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) hits_[i] = {i, 0};
  std::uint32_t size = count;
  for (std::uint32_t level = tree.levels; level-- > 0;) {
    const std::size_t room = 8 * std::size_t{size};
    if (next_.size() < room) next_.resize(2 * room);
    size = implementation_.kernels->overlapping_boxes(tree.blocks + tree.level_begin[level], boxes_.data(),
                                                      hits_.data(), size, next_.data());
    hits_.swap(next_);
  }
  return size;
}

std::span<const std::uint32_t> NearSegments::query(const BoxTreeView& tree, const Box& box,
                                                   std::vector<std::uint32_t>& slots) {
  boxes_.assign(1, box);
  const std::uint32_t size = descend(tree);
  slots.clear();
  for (std::uint32_t k = 0; k < size; ++k) slots.push_back(hits_[k].place);
  return slots;
}

std::span<LocalSegment> NearSegments::find_on_way(const ObstaclePlace& place, Vec2 centre, double distance,
                                                  Vector way) {
  boxes_.assign(1, box_about(place, centre, distance, way));
  const std::uint32_t size = keep_level(descend(obstacles_.segment_tree), body_);
  if (memory_.size() <= size) memory_.resize(std::size_t{size} + 1);
  const bool moves = way.x != 0 || way.y != 0;
  std::size_t count = 0;
  for (std::uint32_t k = 0; k < size; ++k)
    count += is_near(place, centre, distance, obstacles_.segments, hits_[k].place, memory_[count]) | moves;
  return sorted(std::span(memory_).first(count));
}

template <class Take>
void NearSegments::visit_near(Vector from, const double& limit, const Take& take) {
  nearest_boxes_.visit(obstacles_.segment_tree, from.x, from.y, limit, [&](std::uint32_t slot) {
    if (body_.empty() || is_level(obstacles_.segments[slot].obstacle, body_.front())) take(slot);
  });
}

double NearSegments::nearest_distance(const ObstaclePlace& place, Vec2 centre) {
  const Vector from = in_world(place, centre);
  double least = std::numeric_limits<double>::infinity();
  visit_near(from, least, [&](std::uint32_t slot) {
    least = std::min(least, obstacles_.segments[slot].square_distance(from.x, from.y));
  });
  return distance_of_nearest(least, from);
}

double NearSegments::nearest_distance(const ObstaclePlace& place, Vec2 centre,
                                      std::span<const std::uint32_t> areas) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Vector from = in_world(place, centre);
  squares_.assign(areas.size(), infinity);
  std::size_t missing = areas.size();
  double limit = infinity;
  visit_near(from, limit, [&](std::uint32_t slot) {
    const WorldSegment& segment = obstacles_.segments[slot];
    const auto area = std::lower_bound(areas.begin(), areas.end(), segment.obstacle);
    if (area == areas.end() || *area != segment.obstacle || !(segment.length > 0)) return;
    double& least = squares_[static_cast<std::size_t>(area - areas.begin())];
    const bool is_first = least == infinity;
    least = std::min(least, segment.square_distance(from.x, from.y));
    missing -= is_first;
    // With many areas the limit is set once: it is near enough then, and looking for the largest number takes time.
    if (missing == 0 && (is_first || areas.size() == 1))
      limit = *std::max_element(squares_.begin(), squares_.end());
  });
  double most = 0;
  for (const double square : squares_)
    if (square < infinity) most = std::max(most, square);
  return distance_of_nearest(most, from);
}

std::span<LocalSegment> NearSegments::find(const ObstaclePlace& place, Vec2 centre, double distance) {
  const double most = distance_of_boxes(place, distance) * (1 + 0x1p-40), limit = most * most;
  std::size_t count = 0;
  visit_near(in_world(place, centre), limit, [&](std::uint32_t slot) {
    if (memory_.size() <= count) memory_.resize(2 * count + 8);
    count += is_near(place, centre, distance, obstacles_.segments, slot, memory_[count]);
  });
  return sorted(std::span(memory_).first(count));
}

void NearSegments::prepare(std::span<const NearQuery> queries, std::span<const StandingBody> bodies) {
  bodies_ = bodies, body_ = {}, asked_.reset();
  boxes_.clear();
  for (const NearQuery& query : queries)
    boxes_.push_back(box_about(query.place, query.centre, query.distance, {0, 0}));
  const std::uint32_t size = keep_level(descend(obstacles_.segment_tree), bodies);
  if (prepared_.size() <= size) prepared_.resize(std::size_t{size} + 1);
  prepared_end_.assign(queries.size() + 1, 0);
  std::uint32_t count = 0;
  for (std::uint32_t k = 0; k < size; ++k) {
    const auto& [place, centre, distance] = queries[hits_[k].query];
    count += is_near(place, centre, distance, obstacles_.segments, hits_[k].place, prepared_[count]);
    prepared_end_[hits_[k].query + 1] = count;
  }
  // Those of which no box was found end where the ones before do.
  for (std::size_t i = 0; i < queries.size(); ++i)
    prepared_end_[i + 1] = std::max(prepared_end_[i], prepared_end_[i + 1]);
}

std::span<LocalSegment> NearSegments::take(std::size_t query) {
  if (!bodies_.empty()) body_ = bodies_.subspan(query, 1), asked_.reset();
  const std::uint32_t begin = prepared_end_[query];
  return sorted(std::span(prepared_).subspan(begin, prepared_end_[query + 1] - begin));
}

std::uint32_t NearSegments::keep_level(std::uint32_t size, std::span<const StandingBody> bodies) noexcept {
  if (bodies.empty()) return size;
  std::uint32_t kept = 0;
  for (std::uint32_t k = 0; k < size; ++k) {
    const BoxHit hit = hits_[k];
    hits_[kept] = hit;
    kept += is_level(obstacles_.segments[hit.place].obstacle, bodies[hit.query]);
  }
  return kept;
}

std::span<LocalSegment> NearSegments::sorted(std::span<LocalSegment> segments) {
  if (segments.size() > 1)
    std::sort(segments.begin(), segments.end(),
              [](const LocalSegment& a, const LocalSegment& b) { return a.number < b.number; });
  return found_ = segments;
}

std::span<const std::uint32_t> NearSegments::areas_that_hold(const ObstaclePlace& place, Vec2 point) {
  const Vector from = place.turned(point.x, point.y);
  const QueryName asked{place.x, place.y, from.x, from.y};
  if (asked == asked_) return areas_;
  asked_ = asked;
  areas_.clear(), about_.clear();
  const double wide = rounding_of(place), x = place.x + from.x, y = place.y + from.y;
  Box ray{x - wide, y - wide, x + wide, y + wide};
  for (const std::uint32_t slot : query(obstacles_.area_tree, ray, slots_)) {
    about_.push_back(obstacles_.areas[slot]);
    ray.high_x = std::max(ray.high_x, obstacles_.area_boxes[slot].high_x);
  }
  if (!body_.empty())
    std::erase_if(about_, [&](std::uint32_t area) { return !is_level(area, body_.front()); });
  if (about_.empty()) return areas_;
  std::sort(about_.begin(), about_.end());
  for (const std::uint32_t slot : query(obstacles_.segment_tree, ray, slots_)) {
    const WorldSegment& segment = obstacles_.segments[slot];
    if (std::binary_search(about_.begin(), about_.end(), segment.obstacle) &&
        crosses(from, {1, 0}, std::numeric_limits<double>::infinity(),
                {segment.ax - place.x, segment.ay - place.y}, {segment.bx - place.x, segment.by - place.y}))
      areas_.push_back(segment.obstacle);
  }
  keep_odd(areas_);
  return areas_;
}

}  // namespace bch::detail
