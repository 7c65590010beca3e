// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <bch/obstacles.hpp>

#include "kernel/obstacles/segment.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"

namespace bch {

using namespace detail;

namespace {

[[noreturn]] void reject(const std::string& why) {
  throw std::invalid_argument("obstacles: " + why);
}

void require_offsets(std::span<const std::uint64_t> offsets, std::size_t values, const char* name,
                     const char* what) {
  if (offsets.empty() || offsets.front() != 0 || offsets.back() != values)
    reject("expected " + std::string(name) + " from 0 to the " + std::to_string(values) + " " + what +
           ", found others");
  for (std::size_t i = 1; i < offsets.size(); ++i)
    if (offsets[i] < offsets[i - 1])
      reject("expected ascending " + std::string(name) + ", found " + std::to_string(offsets[i]) + " after " +
             std::to_string(offsets[i - 1]));
}

/// Returns the heights of an obstacle; those of an empty span are infinite.
WorldHeights heights_of(const ObstacleArrays& in, std::size_t obstacle) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  return {in.bottom.empty() ? -infinite : in.bottom[obstacle], in.top.empty() ? infinite : in.top[obstacle]};
}

void require_heights(const ObstacleArrays& in, std::size_t obstacles) {
  const auto check_size = [&](std::span<const double> heights, const char* name) {
    if (!heights.empty() && heights.size() != obstacles)
      reject("expected " + std::to_string(obstacles) + " values of " + name + ", one per obstacle, found " +
             std::to_string(heights.size()));
  };
  check_size(in.bottom, "bottom");
  check_size(in.top, "top");
  if (in.bottom.empty() && in.top.empty()) return;
  for (std::size_t i = 0; i < obstacles; ++i) {
    const auto [bottom, top] = heights_of(in, i);
    if (!(bottom <= top))
      reject("obstacle " + std::to_string(i) + ": expected a bottom below the top, found " +
             shortest(bottom) + " to " + shortest(top) + " m");
  }
}

void require_valid(const ObstacleArrays& in) {
  if (in.x.size() != in.y.size())
    reject("expected " + std::to_string(in.x.size()) + " values of y, as many as of x, found " +
           std::to_string(in.y.size()));
  require_offsets(in.polyline_offsets, in.x.size(), "polyline offsets", "points");
  const std::size_t polylines = in.polyline_offsets.size() - 1;
  if (!in.obstacle_offsets.empty())
    require_offsets(in.obstacle_offsets, polylines, "obstacle offsets", "polylines");
  const std::size_t obstacles = in.obstacle_offsets.empty() ? polylines : in.obstacle_offsets.size() - 1;
  if (!in.is_area.empty() && in.is_area.size() != obstacles)
    reject("expected " + std::to_string(obstacles) + " values of is_area, one per obstacle, found " +
           std::to_string(in.is_area.size()));
  require_heights(in, obstacles);
  const auto good = [](double length) { return std::abs(length) <= rounding::largest_position; };
  for (std::size_t i = 0; i < in.x.size(); ++i)
    if (!good(in.x[i]) || !good(in.y[i]))
      reject("point " + std::to_string(i) + ": expected a position within +-1e9 m, found (" +
             shortest(in.x[i]) + ", " + shortest(in.y[i]) + ")");
  if (in.x.size() + polylines + obstacles >= std::numeric_limits<std::int32_t>::max())
    throw std::length_error(
        "obstacles: expected fewer than 2^31 points, polylines and obstacles, found more");
}

WorldSegment segment_of(double ax, double ay, double bx, double by, std::uint32_t number,
                        std::uint32_t obstacle) {
  const double x = bx - ax, y = by - ay, length = std::sqrt(x * x + y * y);
  // Squares of what is shorter lose bits.
  if (!(length > 1e-150)) return {ax, ay, bx, by, 1, 0, 0, number, obstacle};
  return {ax, ay, bx, by, x / length, y / length, length, number, obstacle};
}

/// Returns the box of a segment, enlarged by what LocalSegment::slack can add for its length.
Box box_of(const WorldSegment& s) {
  const double slack = 8 * relative_slack * s.length;
  return {std::min(s.ax, s.bx) - slack, std::min(s.ay, s.by) - slack, std::max(s.ax, s.bx) + slack,
          std::max(s.ay, s.by) + slack};
}

/// Twice the area that a ring encloses, about its first point; negative where it is clockwise.
double twice_area(std::span<const double> x, std::span<const double> y) {
  double area = 0;
  for (std::size_t i = 1; i + 1 < x.size(); ++i)
    area += (x[i] - x[0]) * (y[i + 1] - y[0]) - (x[i + 1] - x[0]) * (y[i] - y[0]);
  return area;
}

/// Segments by their numbers, and what is known of each.
struct Segments {
  std::vector<WorldSegment> ends;
  std::vector<std::uint8_t> begins_polyline;
  std::vector<std::int16_t> outside;

  void reserve(std::size_t size) { ends.reserve(size), begins_polyline.reserve(size), outside.reserve(size); }
  void add_polyline(std::span<const double> x, std::span<const double> y, std::uint32_t of, bool is_ring,
                    bool is_hole) {
    if (x.empty()) return;
    const bool left_is_outside = (twice_area(x, y) < 0) != is_hole;
    const std::size_t first = ends.size();
    const auto add = [&](std::size_t a, std::size_t b) {
      ends.push_back(segment_of(x[a], y[a], x[b], y[b], static_cast<std::uint32_t>(ends.size()), of));
      begins_polyline.push_back(ends.size() == first + 1);
      outside.push_back(is_ring ? (left_is_outside ? 1 : -1) : 0);
    };
    for (std::size_t i = 1; i < x.size(); ++i) add(i - 1, i);
    const std::size_t last = x.size() - 1;
    if (last == 0 || (is_ring && (x[0] != x[last] || y[0] != y[last]))) add(last, 0);
  }
};

}  // namespace

struct ObstacleSet::State {
  State(Segments&& segments, std::vector<std::uint8_t>&& areas, std::vector<WorldHeights>&& heights);

  std::vector<std::uint8_t> begins_polyline, is_area;
  std::vector<WorldHeights> heights;  ///< by obstacle; empty: all are infinite
  std::vector<std::int16_t> outside;
  std::vector<std::uint32_t> obstacle_of;
  std::vector<std::uint32_t> areas;  ///< in the order of the tree of areas, after it is made
  std::vector<Box> area_boxes;
  BoxTreeMemory segment_tree, area_tree;
  std::vector<WorldSegment> ends;  ///< by slot
  DistanceGridMemory distance_grid;
  ObstacleView view;

 private:
  static std::vector<Box> boxes_of(const Segments& segments);
  static std::vector<WorldSegment> in_order(const Segments& segments, const BoxTreeMemory& tree);
  /// Finds the areas that have segments, and returns their boxes.
  std::vector<Box> find_areas(const Segments& segments);
};

std::vector<Box> ObstacleSet::State::boxes_of(const Segments& segments) {
  std::vector<Box> boxes;
  boxes.reserve(segments.ends.size());
  for (const WorldSegment& segment : segments.ends) boxes.push_back(box_of(segment));
  return boxes;
}

std::vector<WorldSegment> ObstacleSet::State::in_order(const Segments& segments, const BoxTreeMemory& tree) {
  std::vector<WorldSegment> ends;
  ends.reserve(tree.order.size());
  for (const std::uint32_t number : tree.order) ends.push_back(segments.ends[number]);
  return ends;
}

std::vector<Box> ObstacleSet::State::find_areas(const Segments& segments) {
  for (std::size_t i = 0; i < segments.ends.size(); ++i) {
    if (is_area[segments.ends[i].obstacle] == 0) continue;
    const Box box = box_of(segments.ends[i]);
    if (areas.empty() || areas.back() != segments.ends[i].obstacle)
      areas.push_back(segments.ends[i].obstacle), area_boxes.push_back(box);
    Box& all = area_boxes.back();
    all = {std::min(all.low_x, box.low_x), std::min(all.low_y, box.low_y), std::max(all.high_x, box.high_x),
           std::max(all.high_y, box.high_y)};
  }
  return area_boxes;
}

ObstacleSet::State::State(Segments&& segments, std::vector<std::uint8_t>&& is_area_of,
                          std::vector<WorldHeights>&& heights_of_all)
    : is_area(std::move(is_area_of)),
      heights(std::move(heights_of_all)),
      segment_tree(boxes_of(segments)),
      area_tree(find_areas(segments)),
      ends(in_order(segments, segment_tree)),
      distance_grid(segment_tree.view, ends) {
  for (const WorldSegment& segment : segments.ends) obstacle_of.push_back(segment.obstacle);
  std::vector<std::uint32_t> sorted_areas;
  std::vector<Box> sorted_boxes;
  for (const std::uint32_t i : area_tree.order)
    sorted_areas.push_back(areas[i]), sorted_boxes.push_back(area_boxes[i]);
  areas = std::move(sorted_areas), area_boxes = std::move(sorted_boxes);
  begins_polyline = std::move(segments.begins_polyline);
  outside = std::move(segments.outside);
  double widest = 0;
  for (const Box& box : area_boxes)
    widest = std::max(widest, std::min(box.high_x - box.low_x, box.high_y - box.low_y));
  view = {.segment_tree = segment_tree.view,
          .area_tree = area_tree.view,
          .distance_grid = distance_grid.view,
          .segments = ends.data(),
          .is_area = is_area.data(),
          .heights = heights.empty() ? nullptr : heights.data(),
          .begins_polyline = begins_polyline.data(),
          .outside = outside.data(),
          .widest_area = widest,
          .areas = areas.data(),
          .area_boxes = area_boxes.data(),
          .segment_count = static_cast<std::uint32_t>(ends.size()),
          .obstacle_count = static_cast<std::uint32_t>(is_area.size())};
}

ObstacleSet::ObstacleSet(const ObstacleArrays& in) {
  const FloatingPointStateGuard floats;
  require_valid(in);
  const std::size_t polylines = in.polyline_offsets.size() - 1;
  const bool alone = in.obstacle_offsets.empty();
  std::vector<std::uint8_t> is_area(alone ? polylines : in.obstacle_offsets.size() - 1);
  Segments segments;
  segments.reserve(in.x.size() + polylines);
  for (std::uint32_t o = 0; o < is_area.size(); ++o) {
    is_area[o] = !in.is_area.empty() && in.is_area[o] != 0;
    const std::size_t first = alone ? o : in.obstacle_offsets[o],
                      end = alone ? o + 1 : in.obstacle_offsets[o + 1];
    const std::size_t first_segment = segments.ends.size();
    for (std::size_t p = first; p < end; ++p) {
      const std::size_t begin = in.polyline_offsets[p], size = in.polyline_offsets[p + 1] - begin;
      segments.add_polyline(in.x.subspan(begin, size), in.y.subspan(begin, size), o, is_area[o] != 0,
                            segments.ends.size() != first_segment);
    }
  }
  std::vector<WorldHeights> heights;
  if (!in.bottom.empty() || !in.top.empty())
    for (std::size_t o = 0; o < is_area.size(); ++o) heights.push_back(heights_of(in, o));
  state_ = std::make_unique<State>(std::move(segments), std::move(is_area), std::move(heights));
}

ObstacleSet::ObstacleSet(ObstacleSet&&) noexcept = default;
ObstacleSet& ObstacleSet::operator=(ObstacleSet&&) noexcept = default;
ObstacleSet::~ObstacleSet() = default;

std::uint32_t ObstacleSet::obstacle_count() const noexcept {
  return state_->view.obstacle_count;
}

std::uint32_t ObstacleSet::segment_count() const noexcept {
  return state_->view.segment_count;
}

std::uint32_t ObstacleSet::obstacle_of(std::uint32_t segment) const {
  return state_->obstacle_of.at(segment);
}

const ObstacleView& ObstacleSet::view() const noexcept {
  return state_->view;
}

}  // namespace bch
