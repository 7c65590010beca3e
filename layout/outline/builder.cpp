// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/outline_builder.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "layout/base/build_implementation.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/number_class.hpp"
#include "layout/outline/candidates.hpp"
#include "layout/outline/contour_index.hpp"
#include "layout/outline/grid_snap.hpp"
#include "layout/outline/topology.hpp"
#include "layout/outline/walk.hpp"
#include "layout/outline/winding.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr GridPoint beyond{std::numeric_limits<std::int32_t>::max(), 0};

GridPoint first_of(GridPoint a, GridPoint b) {
  return lexicographically_less(b, a) ? b : a;
}

/// A box around a contour, whose corners are rounded by less than a step.
GridBox box_around(std::span<const Stretch> contour) {
  GridBox box = empty_box;
  for (const Stretch& stretch : contour) enlarge(box, {stretch.rounded_begin, stretch.rounded_begin});
  return {{box.low.x - 1, box.low.y - 1}, {box.high.x + 1, box.high.y + 1}};
}

Heights heights_of(std::span<const Vec3> positions, std::span<const std::uint32_t> vertices) {
  Heights all{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  for (const std::uint32_t v : vertices) {
    const float z = positions[v].z;
    if (!is_finite(z))
      throw std::invalid_argument("outline: the height of vertex " + std::to_string(v) + " is not finite");
    all = {std::min(all.bottom, z), std::max(all.top, z)};
  }
  return all;
}

}  // namespace

/// What is known of the mesh, and the scratch of a pose.
struct OutlineBuilder::State {
  State(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertex_count,
        std::span<const Vec3> bind_pose, const BuildImplementation& implementation)
      : vertices(vertex_count),
        topology(outline_topology(triangles, vertex_count, bind_pose)),
        points(topology.used.size()),
        candidates(topology, implementation.loops.outline),
        walk(implementation.loops.outline) {
    const std::size_t components = topology.component_vertex.size();
    leftmost.reserve(components), outside.reserve(components), places.reserve(components);
    later.reserve(components);
  }

  template <class Position>
  void build(std::span<const Position> positions, Outline& outline);
  void walk_all();
  void find_outside();
  void walk_outside();
  bool is_in_later_contour(GridPoint point) const;
  std::span<const Stretch> contour(std::size_t i) const {
    return std::span(stretches).subspan(contour_begin[i], contour_begin[i + 1] - contour_begin[i]);
  }
  void walk_from(GridPoint start) {
    walk.walk(start, stretches);
    contour_begin.push_back(stretches.size());
  }
  void write(double step, Outline& outline) const;

  std::size_t vertices;
  OutlineTopology topology;
  std::vector<GridPoint> points;
  OutlineCandidates candidates;
  CandidateList list;
  OutlineWalk walk;
  std::vector<Stretch> stretches;
  std::vector<std::size_t> contour_begin;
  std::vector<std::uint32_t> outside;  ///< components to walk around, unless they touch each other
  std::vector<GridPoint> leftmost;     ///< of a component's candidates
  std::vector<GridPoint> places;       ///< where outside's components begin
  ContourCovers covers;                ///< of all contours, where any component is outside the first
  ContourIndex later;                  ///< over all but the first
};

template <class Position>
void OutlineBuilder::State::build(std::span<const Position> positions, Outline& outline) {
  if (positions.size() != vertices)
    throw std::invalid_argument("outline: " + std::to_string(positions.size()) + " positions for " +
                                std::to_string(vertices) + " vertices");
  const double step = snap_to_grid(positions, topology.used, points);
  candidates.find(topology, points, list);
  if (list.segments().empty())
    throw std::invalid_argument("outline: every triangle is a point when seen from above");
  walk_all();
  write(step, outline);
}

/// Finds all contours. A component is connected and no contour crosses it, so unless a contour has come along
/// it, it is as a whole inside or outside, and any of its points tells. Of pieces that touch, the one with
/// the leftmost vertex comes first.
void OutlineBuilder::State::walk_all() {
  stretches.clear();
  contour_begin.assign(1, 0);
  walk.begin(list);
  walk_from(list.boxes().first_end(list.segments().data()));

  find_outside();
  if (!outside.empty()) walk_outside();
}

void OutlineBuilder::State::walk_outside() {
  places.clear();
  for (const std::uint32_t component : outside) places.push_back(leftmost[component]);
  later.begin(places);
  for (std::size_t i = 0; i < outside.size(); ++i) {
    if (walk.touched(outside[i]) || is_in_later_contour(places[i])) continue;
    const std::size_t found = covers.size();
    walk_from(places[i]);
    covers.add(contour(found));
    later.add(i, found, box_around(contour(found)));
  }
}

/// Fills outside, in the order of the components' leftmost vertices.
void OutlineBuilder::State::find_outside() {
  outside.clear();
  const std::span<const GridPoint> component_points = list.component_points();
  for (std::uint32_t component = 0; component < component_points.size(); ++component)
    if (!walk.touched(component)) outside.push_back(component);
  if (outside.empty()) return;
  covers.clear();
  covers.add(contour(0));
  std::erase_if(outside, [&](std::uint32_t component) {
    return covers.covers(0, contour(0), component_points[component]);
  });
  if (outside.empty()) return;

  leftmost.assign(component_points.size(), beyond);
  const std::span<const Segment> segments = list.segments();
  for (std::size_t i = 0; i < segments.size(); ++i) {
    GridPoint& first = leftmost[list.component(i)];
    first = first_of(first, first_of(segments[i].a, segments[i].b));
  }
  // Components without candidates are points, or see other components named for the edges they share.
  std::erase_if(outside, [&](std::uint32_t component) { return leftmost[component] == beyond; });
  std::sort(outside.begin(), outside.end(), [&](std::uint32_t a, std::uint32_t b) {
    return lexicographically_less(leftmost[a], leftmost[b]);
  });
}

bool OutlineBuilder::State::is_in_later_contour(GridPoint point) const {
  return later.any(point, [&](std::size_t c) { return covers.covers(c, contour(c), point); });
}

/// Writes corners, that is, where a stretch has another direction than the one before; corners that are
/// rounded to one point are one.
void OutlineBuilder::State::write(double step, Outline& outline) const {
  outline.points.clear();
  outline.contour_begin.assign(1, 0);
  outline.grid_step = static_cast<float>(step);
  for (std::size_t c = 0; c + 1 < contour_begin.size(); ++c) {
    const std::span<const Stretch> around = contour(c);
    GridPoint last = around[0].rounded_begin;
    const auto add = [&](GridPoint p) {
      outline.points.push_back({static_cast<float>(p.x * step), static_cast<float>(p.y * step)});
    };
    add(last);
    for (std::size_t i = 1; i < around.size(); ++i) {
      const GridPoint p = around[i].rounded_begin;
      if (p == last || same_direction(around[i - 1].begin.direction(), around[i].begin.direction())) continue;
      add(last = p);
    }
    if (last == around[0].rounded_begin) outline.points.pop_back();
    outline.contour_begin.push_back(static_cast<std::uint32_t>(outline.points.size()));
  }
}

OutlineBuilder::OutlineBuilder(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices,
                               std::span<const Vec3> bind_pose)
    : OutlineBuilder(triangles, vertices, bind_pose, best_build_implementation()) {}

OutlineBuilder::OutlineBuilder(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices,
                               std::span<const Vec3> bind_pose, const BuildImplementation& implementation) {
  const FloatingPointStateGuard floats;
  state_ = std::make_unique<State>(triangles, vertices, bind_pose, implementation);
}

OutlineBuilder::OutlineBuilder(OutlineBuilder&&) noexcept = default;
OutlineBuilder& OutlineBuilder::operator=(OutlineBuilder&&) noexcept = default;
OutlineBuilder::~OutlineBuilder() = default;

void OutlineBuilder::build(std::span<const Vec2> positions, Outline& outline) {
  const FloatingPointStateGuard floats;
  state_->build(positions, outline);
}

Heights OutlineBuilder::build(std::span<const Vec3> positions, Outline& outline) {
  const FloatingPointStateGuard floats;
  state_->build(positions, outline);
  return heights_of(positions, state_->topology.used);
}

}  // namespace bch
