// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/obstacles/body_query.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/collide/containment.hpp"
#include "kernel/obstacles/shape_tree.hpp"
#include "kernel/runtime/kernels.hpp"
#include "kernel/simd/ancestor_test.hpp"
#include "kernel/simd/leaf_segments.hpp"
#include "kernel/simd/tree_nodes.hpp"
#include "layout/base/number_class.hpp"
#include "layout/base/rounding.hpp"

namespace bch::detail {
namespace {

/// Returns how far to search for what is nearest to a body: not at all farther than it is, if that is known well enough. What is far is
/// searched for one by one.
double first_distance(DistanceBounds nearest) noexcept {
  constexpr double least_distance = 0.5, step = 0.05;  // metres
  if (is_infinite(nearest.most)) return step;
  return std::max(step, std::min(nearest.most, std::max(least_distance, 2 * nearest.least)));
}

bool is_touched(std::span<const LocalSegment> segments, float x, float y, float radius) noexcept {
  return any_touches(segments.data(), segments.size(), double{x}, double{y}, double{radius});
}

/// Returns whether an area holds what is in a leaf whose disc is touched. `disc`: its place among the nodes.
bool leaf_is_contained(const ShapeSetView& shapes, const ShapeTree<void>& own, std::uint32_t disc,
                       bool has_segments, std::span<const LocalSegment> segments, AreaSide& area) {
  if (has_segments) {
    const LeafSegments<void> leaves{shapes.leaf_segments};
    const auto list = leaves.segments(own.tree, disc);
    for (std::uint32_t i = 0; i < list.count; ++i)
      if (area.contains(shapes.points[list.point(i)])) return true;
    if (list.count != 0) return false;
  }
  if (own.tree.count == 1) return false;
  AncestorPath<void> path;
  path.begin(own.nodes, own.tree, disc);
  for (;;) {
    const float* const node = own.nodes + std::size_t{path.node[0]} * inner_floats;
    if (!is_touched(segments, node[0], node[1], node[2]) && area.contains({node[0], node[1]})) return true;
    path.step(own.nodes, 1);
    if (path.node[1] == path.node[0]) return false;
    path.node[0] = path.node[1];
  }
}

}  // namespace

void BodyQuery::prepare(std::uint32_t begin, std::uint32_t end, double limit, SearchMode mode) {
  choose(begin, end, limit, mode);
  queries_.clear(), bodies_.clear();
  const bool by_height = obstacles().heights != nullptr && shapes_.heights != nullptr;
  for (std::size_t i = 0; i < chosen_count_; ++i) {
    const auto [agent, searched] = chosen_[i];
    const ObstaclePlace place{agents_.x[agent], agents_.y[agent], rotation(agents_.heading[agent])};
    const std::uint32_t shape = agents_.shape[agent];
    bodies_.push_back({shapes_, place, shape, level_of(agent), searched, i});
    queries_.push_back({place, bodies_.back().centre(), bodies_.back().outer_radius() + searched, {}});
    if (by_height) queries_.back().body = {heights(shape, limit), agents_.z.empty() ? 0 : agents_.z[agent]};
  }
  near_.prepare(queries_);
}

Heights BodyQuery::heights(std::uint32_t shape, double limit) const noexcept {
  const auto [bottom, top] = shapes_.heights[shape];
  if (!in_space_) return {bottom, top};
  return {rounding::round_down(double{bottom} - limit), -rounding::round_down(-double{top} - limit)};
}

/// The distance of an agent's position tells who can be left out: those who have no segment near them, and are too large for an area to hold
/// them. There is no branch that depends on the answer, so that the next agents' numbers are on their way.
void BodyQuery::choose(std::uint32_t begin, std::uint32_t end, double limit, SearchMode mode) {
  begin_ = begin;
  place_.resize(end - begin + std::size_t{1});
  chosen_.resize(end - begin + std::size_t{1});
  std::size_t count = 0;
  for (std::uint32_t agent = begin; agent < end; ++agent) {
    place_[agent - begin] = count;
    const DistanceBounds nearest = obstacles().distance_grid.bounds(agents_.x[agent], agents_.y[agent]);
    const double searched = mode == SearchMode::touching ? 0 : std::min(limit, first_distance(nearest));
    const auto index = static_cast<std::uint32_t>(agents_.root(agent, shapes_.level_count));
    const Root& root = shapes_.roots[index];
    const double to_centre = std::abs(double{root.x}) + std::abs(double{root.y});
    const bool is_far = to_centre + outer_radius(shapes_, index) + limit < nearest.least;
    chosen_[count] = {agent, searched};
    count += !(is_far & is_too_large_for_areas(root));
  }
  place_.back() = chosen_count_ = count;
}

bool BodyQuery::touches(const PlacedBody& body, std::span<const LocalSegment> segments) const noexcept {
  return implementation_.kernels->touches(arguments(body, segments));
}

NearestObstacle BodyQuery::nearest(std::uint32_t agent, double limit, double stop_below, bool inside) {
  const PlacedBody* const body = this->body(agent);
  NearestObstacle nearest{.gap = std::min(limit, farthest_gap), .body = body};
  if (body == nullptr) return nearest;
  ObstacleGap best{nearest.gap, no_disc, no_disc, no_disc, nullptr};
  const auto visit = [&](std::span<const LocalSegment> segments) {
    best.segment = nullptr;
    implementation_.kernels->find_gap(arguments(*body, segments), stop_below, best);
    if (best.segment != nullptr)
      nearest = {best.gap, best.point, best.disc, body, *best.segment, true, best.gap <= stop_below};
  };
  visit(near_body(*body));
  if (!nearest.is_within) nearest.is_within = inside && is_inside(*body);
  if (!nearest.is_within) search_outward(*body, stop_below, nearest, visit);
  return nearest;
}

/// Where no segment touches a node, everything below it is on the side of the border on which its centre is. Where they touch a leaf's disc and
/// not the outline in it, the points of that tell. Where discs decide, a node above a touched leaf may be untouched: blocks do not have all
/// nodes.
bool BodyQuery::area_contains(const PlacedBody& body, std::span<const LocalSegment> segments,
                              std::uint32_t obstacle) {
  if (obstacles().is_area[obstacle] == 0) return false;
  const ShapeTree<void> own(shapes_, body.root_index());
  const Tree& tree = own.tree;
  AreaSide area(near_, body.place, segments, obstacle);
  const bool has_segments = exact_leaves_ && tree.segments != no_segments;
  const Root& root = body.root();
  if (!is_touched(segments, root.x, root.y, root.radius)) return area.contains(body.centre());
  const auto visit = [&](std::uint32_t node, OpenBlock& block) {
    const Discs discs = TreeNodes<void>::discs(own.nodes, node, tree.stride);
    for (unsigned lane = 0; lane < block_width; ++lane) {
      const float x = discs.x[lane], y = discs.y()[lane];
      if (!(x < __builtin_inff())) continue;
      if (!is_touched(segments, x, y, discs.radius()[lane])) {
        if (area.contains({x, y})) return true;
      } else if (node < leaf_bit) {
        block.lanes |= 1u << lane;
      } else if (leaf_is_contained(shapes_, own, (node & ~leaf_bit) + lane, has_segments, segments, area)) {
        return true;
      }
    }
    return false;
  };
  return own.walk(visit, [](const OpenBlock& block) { return block.first(); });
}

bool BodyQuery::outline_contains(const PlacedBody& body,
                                 std::span<const LocalSegment> segments) const noexcept {
  if (shapes_.shape_contours == nullptr) return false;
  const ContourRange contours = shapes_.shape_contours[body.shape];
  for (const LocalSegment& segment : segments) {
    if (obstacles().begins_polyline[segment.number] == 0) continue;
    const WorldSegment& world = obstacles().segments[segment.slot];
    const auto [x, y] = body.place.turned_back(world.ax - body.place.x, world.ay - body.place.y);
    for (std::uint32_t i = contours.begin; i < contours.end; ++i)
      if (contour_contains(shapes_.points, shapes_.contours[i], {x, y})) return true;
  }
  return false;
}

bool BodyQuery::has_segment_of(std::uint32_t obstacle) noexcept {
  // Those of an obstacle have consecutive numbers.
  const auto found = near_.found();
  const auto first =
      std::lower_bound(found.begin(), found.end(), obstacle,
                       [](const LocalSegment& segment, std::uint32_t of) { return segment.obstacle < of; });
  return first != found.end() && first->obstacle == obstacle;
}

bool BodyQuery::is_inside(const PlacedBody& body) {
  const auto contains = [&](std::span<const LocalSegment> segments, std::uint32_t obstacle) {
    return area_contains(body, segments, obstacle);
  };
  return near_.any_obstacle(contains) || visit_areas_beyond(body, [](std::uint32_t) { return false; }) ||
         outline_contains(body, near_.found());
}

}  // namespace bch::detail
