// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy/builder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "layout/base/number_class.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/shortest.hpp"
#include "layout/enclosing_disc/enclosing_disc.hpp"
#include "layout/format/contours.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"

namespace bch::detail {
namespace {

constexpr std::uint32_t none = 0xffffffff;

double widened(float value) {
  return value;
}

/// The largest number whose rounded square root is at most `root`, positive or 0.
double largest_square(double root) {
  double square = root * root;
  const auto step = [&](std::int64_t by) {
    return std::bit_cast<double>(std::bit_cast<std::int64_t>(square) + by);
  };
  while (std::sqrt(square) > root) square = step(-1);
  while (std::sqrt(step(1)) <= root) square = step(1);
  return square;
}

double square_distance(Vec2 a, Vec2 b) {
  const double x = widened(b.x) - widened(a.x), y = widened(b.y) - widened(a.y);
  return x * x + y * y;
}

Vec2 middle_of(Vec2 a, Vec2 b) {
  return {static_cast<float>(0.5 * (widened(a.x) + widened(b.x))),
          static_cast<float>(0.5 * (widened(a.y) + widened(b.y)))};
}

Vec2 centre(const Hierarchy::Node& node) {
  return {node.disc.x, node.disc.y};
}

void set_centre(Hierarchy::Node& node, Vec2 centre) {
  node.disc.x = centre.x, node.disc.y = centre.y;
}

void clear(Hierarchy& hierarchy) {
  hierarchy.nodes.clear();
  hierarchy.primitives.clear(), hierarchy.source.clear(), hierarchy.primitive_ranges.clear();
  hierarchy.of_segments = false;
}

}  // namespace

void require_extent(double max_extent) {
  if (!(max_extent >= rounding::smallest_extent && max_extent <= rounding::largest_extent))
    throw std::invalid_argument("hierarchy: expected an extent of 1e-6 to 1e6 m, found " +
                                shortest(max_extent));
}

void require_threshold(float threshold) {
  if (!(threshold > 0) || !is_finite(threshold))
    throw std::invalid_argument("hierarchy: expected a threshold above 0 m, found " + shortest(threshold));
}

void HierarchyBuilder::contour(const Outline& outline, float threshold, SplitRule rule, Hierarchy& hierarchy,
                               std::uint32_t deepest) {
  clear(hierarchy);
  const double max_extent = validate(outline);
  require_threshold(threshold);
  if (rule != SplitRule::centroid && rule != SplitRule::centre)
    throw std::invalid_argument("hierarchy: expected a split rule of 0 (centroid) or 1 (centre), found " +
                                std::to_string(static_cast<int>(rule)));
  hierarchy.max_extent = max_extent;
  begin(max_extent, rounding::outline_grid_steps * widened(outline.grid_step), widened(threshold),
        outline.points.size());
  for (std::size_t c = 0; c < outline.contours(); ++c) items_.add_contour(outline.contour(c), even_halves_);
  grow(rule == SplitRule::centre, deepest);
  publish(hierarchy);
}

void HierarchyBuilder::projected(std::span<const Vec2> vertices,
                                 std::span<const std::array<std::uint32_t, 3>> triangles,
                                 Hierarchy& hierarchy) {
  clear(hierarchy);
  if (triangles.empty()) throw std::invalid_argument("hierarchy: no triangles");
  hierarchy.max_extent = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t vertex : triangles[t]) {
      if (vertex >= vertices.size())
        throw std::invalid_argument("hierarchy: triangle " + std::to_string(t) + " names vertex " +
                                    std::to_string(vertex));
      if (!is_finite(vertices[vertex].x) || !is_finite(vertices[vertex].y))
        throw std::invalid_argument("hierarchy: vertex " + std::to_string(vertex) + " is not finite");
      hierarchy.max_extent = std::max(hierarchy.max_extent, max_extent(vertices.subspan(vertex, 1)));
    }
  require_extent(hierarchy.max_extent);
  begin(hierarchy.max_extent, 0, 0, triangles.size());
  for (const auto& [a, b, c] : triangles) items_.add_triangle({vertices[a], vertices[b], vertices[c]});
  grow(false, all_depths);
  publish(hierarchy);
}

void HierarchyBuilder::root(std::span<const Vec2> points, float grid_step, Hierarchy& hierarchy) {
  clear(hierarchy);
  if (points.empty()) throw std::invalid_argument("hierarchy: no points");
  hierarchy.max_extent = max_extent(points);
  require_extent(hierarchy.max_extent);
  if (!(grid_step >= 0) || widened(grid_step) > hierarchy.max_extent)
    throw std::invalid_argument("hierarchy: grid step " + shortest(grid_step) +
                                " m is not from 0 to the extent, " + shortest(hierarchy.max_extent) + " m");
  begin(hierarchy.max_extent, rounding::outline_grid_steps * widened(grid_step), 0, 0);
  order_.clear();
  unsolved_.push_back({add_node(), 0, 0});
  sets_.assign(1, {0, static_cast<std::uint32_t>(points.size())});
  solve(points);
  publish(hierarchy);
}

void HierarchyBuilder::begin(double max_extent, double margin, double threshold, std::size_t items) {
  margin_ = margin + rounding::query_margin * max_extent;
  threshold_ = threshold;
  // Half the diagonal of its box bounds a node's radius, but for the rounding of the centre.
  const double half = std::max(0.0, threshold * (1 - 0x1p-40) - 2 * rounding::unit_roundoff * max_extent);
  sure_square_diagonal_ = 4 * half * half;
  longest_square_length_ = largest_square(2 * threshold);
  items_.begin(items);
  even_halves_.begin(2 * threshold, max_extent);
  unsolved_.clear();
  node_count_ = 0;
}

/// Makes room for more nodes, not all of which need to be used.
inline void HierarchyBuilder::reserve(std::uint32_t nodes) {
  if (node_count_ + nodes > nodes_.size()) [[unlikely]]
    enlarge(nodes);
}

void HierarchyBuilder::enlarge(std::uint32_t nodes) {
  if (node_count_ + nodes > max_nodes_)
    throw std::length_error("hierarchy: more than " + std::to_string(max_nodes_) +
                            " nodes at a threshold of " + shortest(threshold_) + " m");
  nodes_.resize(std::min(max_nodes_, 2 * std::size_t{node_count_} + nodes + 256));
}

/// Grows the tree first, depth first, whose shape needs few discs, then computes the other discs.
void HierarchyBuilder::grow(bool through_centre, std::uint32_t deepest) {
  const std::size_t count = items_.count;
  order_.resize(count);
  scratch_.resize(std::max(scratch_.size(), 2 * count));
  first_node_.resize(std::max(first_node_.size(), count));
  pending_.resize(std::max(pending_.size(), count + 1));
  std::iota(order_.begin(), order_.end(), 0);
  PendingNode* top = pending_.data();
  *top++ = {0,
            static_cast<std::uint32_t>(count),
            order_.data(),
            scratch_.data(),
            none,
            deepest,
            measure(items_, order_)};
  while (top != pending_.data()) {
    const std::uint32_t node = node_count_;
    if (!add_node(*--top)) continue;
    const PendingNode now = *top;
    std::uint32_t* const first = order_.data() + now.begin;
    const std::uint32_t below = now.below - 1;
    if (now.end - now.begin == 2 && threshold_ > 0) {
      divide_pair(items_, now.items(), now.measure, through_centre, first);
      add_lone_segment(now.begin, below);
      nodes_[node].second_child = node_count_;
      add_lone_segment(now.begin + 1, below);
      continue;
    }
    const std::size_t first_size = divide(items_, now.items(), now.measure, through_centre, first,
                                          now.scratch, top[1].measure, top[0].measure);
    const std::uint32_t middle = now.begin + static_cast<std::uint32_t>(first_size);
    const auto set = [&](PendingNode& child, std::uint32_t begin, std::uint32_t end, std::uint32_t* list,
                         std::uint32_t* scratch) {
      child.begin = begin, child.end = end, child.list = list, child.scratch = scratch;
      child.parent = node, child.below = below;
    };
    set(top[0], middle, now.end, now.scratch, now.scratch);
    set(top[1], now.begin, middle, first, now.scratch + (now.end - middle));
    top += 2;
  }
  even_halves_.write(items_.primitives, OutwardRadii(margin_), nodes_);
  solve_discs();
}

/// Adds a node. Returns false for a leaf and for a node that is complete already.
bool HierarchyBuilder::add_node(const PendingNode& pending) {
  if (pending.parent != none && pending.parent + 1 != node_count_)
    nodes_[pending.parent].second_child = node_count_;
  const ItemList items = pending.items();
  if (items.size() == 1 && threshold_ > 0) {
    order_[pending.begin] = items[0];
    add_lone_segment(pending.begin, pending.below);
    return false;
  }
  const std::uint32_t node = add_node();
  unsolved_.push_back({node, pending.begin, pending.end});
  if (items.size() > 1 && pending.below > 0 && !is_leaf(items, pending.measure)) return true;
  for (std::size_t k = 0; k < items.size(); ++k) {
    order_[pending.begin + k] = items[k];
    first_node_[pending.begin + k] = node;
  }
  return false;
}

/// Returns whether a node is a leaf. The disc about a box holds the node's disc, whose diameter is at least
/// the box's longer side. The disc itself is computed only between these bounds.
bool HierarchyBuilder::is_leaf(ItemList items, const SplitMeasure& box) {
  const double x = box.extent(0), y = box.extent(1);
  if (0.5 * std::max(x, y) >= threshold_) return false;
  if (x * x + y * y < sure_square_diagonal_) return true;
  gather_points(items);
  return smallest_enclosing_disc(std::span(points_).first(point_count_)).radius < threshold_;
}

/// Adds a lone segment, given by its place in the order, and below it the pieces that it is halved into. The
/// midpoint that divides it is its disc's centre.
void HierarchyBuilder::add_lone_segment(std::uint32_t at, std::uint32_t below) {
  const std::uint32_t source = order_[at];
  first_node_[at] = node_count_;
  const std::uint8_t wanted = items_.halvings[source];
  if (wanted == EvenHalves::uneven)
    return add_halves(items_.primitives[source].a, items_.primitives[source].b, below);
  const int halvings = static_cast<int>(std::min<std::uint32_t>(wanted, below));
  reserve(EvenHalves::nodes(halvings));
  even_halves_.add(halvings, node_count_, source);
  node_count_ += EvenHalves::nodes(halvings);
}

/// Adds the nodes of a lone segment whose pieces are not all halved equally often.
void HierarchyBuilder::add_halves(Vec2 a, Vec2 b, std::uint32_t below) {
  std::size_t open_count = 0;
  for (;;) {
    const std::uint32_t node = add_node();
    const Vec2 middle = middle_of(a, b);
    set_centre(nodes_[node], middle);
    OutwardRadii(margin_).write(std::max(square_distance(a, middle), square_distance(b, middle)),
                                nodes_[node]);
    if (below > 0 && square_distance(a, b) > longest_square_length_ && !(middle == a) && !(middle == b)) {
      halves_[open_count++] = {node, --below, b};
      b = middle;
      continue;
    }
    if (open_count == 0) return;
    const Half& half = halves_[--open_count];
    below = half.below;
    nodes_[half.node].second_child = node_count_;
    a = centre(nodes_[half.node]);
    b = half.end;
  }
}

std::uint32_t HierarchyBuilder::add_node() {
  reserve(1);
  nodes_[node_count_].second_child = 0;
  return node_count_++;
}

/// Gathers the points of triangles, or those of segments, in which c repeats b.
void HierarchyBuilder::gather_points(ItemList items) {
  const std::size_t count = items.size();
  points_.resize(std::max(points_.size(), 3 * count));
  first_point_.resize(std::max(first_point_.size(), count));
  last_point_.resize(std::max(last_point_.size(), count));
  Vec2* const points = points_.data();
  std::uint32_t *const first = first_point_.data(), *const last = last_point_.data();
  const Hierarchy::Primitive* const primitives = items_.primitives.data();
  std::uint32_t at = 0;
  const Vec2* next = &primitives[items[0]].a;
  for (std::size_t k = 0; k < count; ++k) {
    const auto& [a, b, c] = primitives[items[k]];
    next = k + 1 < count ? &primitives[items[k + 1]].a : next;
    first[k] = at;
    points[at++] = a;
    points[at] = b;
    at += !(b == c);
    points[at] = c;
    last[k] = at;
    at += (k + 1 == count) | (std::bit_cast<std::uint64_t>(c) != std::bit_cast<std::uint64_t>(*next));
  }
  point_count_ = at;
}

void HierarchyBuilder::solve_discs() {
  gather_points(order_);
  sets_.resize(unsolved_.size());
  for (std::size_t i = 0; i < sets_.size(); ++i)
    sets_[i] = {first_point_[unsolved_[i].begin], last_point_[unsolved_[i].end - 1] + 1};
  solve(points_);
}

/// Solves the sets, which are those of the unsolved nodes.
void HierarchyBuilder::solve(std::span<const Vec2> points) {
  discs_.resize(sets_.size());
  solver_.solve(points, sets_, discs_);
  const OutwardRadii radii(margin_);
  for (std::size_t i = 0; i < discs_.size(); ++i) {
    Hierarchy::Node& node = nodes_[unsolved_[i].node];
    set_centre(node, discs_[i].centre);
    radii.write(discs_[i].square_radius, node);
  }
}

void HierarchyBuilder::publish(Hierarchy& hierarchy) {
  hierarchy.nodes.assign(nodes_.begin(), nodes_.begin() + node_count_);
}

}  // namespace bch::detail
