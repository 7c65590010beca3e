// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy_builder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "layout/enclosing_disc.hpp"
#include "layout/hierarchy_bounds.hpp"
#include "layout/rounding.hpp"

namespace bch {
namespace {

constexpr std::size_t most_nodes = std::size_t{1} << 22;
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

}  // namespace

void require_reach(double reach) {
  if (!(reach >= rounding::smallest_reach && reach <= rounding::largest_reach))
    throw std::invalid_argument("hierarchy: reach " + std::to_string(reach) + " m is outside 1e-6 to 1e6 m");
}

void HierarchyBuilder::contour(const Outline& outline, float threshold, SplitRule rule,
                               Hierarchy& hierarchy) {
  hierarchy.nodes.clear();
  validate(outline);
  if (!(threshold > 0) || !std::isfinite(threshold))
    throw std::invalid_argument("hierarchy: threshold " + std::to_string(threshold) +
                                " m is not positive and finite");
  hierarchy.reach = reach(outline.points);
  begin(hierarchy.reach, rounding::outline_grid_steps * widened(outline.grid_step), widened(threshold));
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto points = outline.contour(c);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) add_segment(points[i], points[i + 1]);
    add_segment(points.back(), points.front());
  }
  grow(rule == SplitRule::centre);
  publish(hierarchy);
}

void HierarchyBuilder::projected(std::span<const Vec2> vertices,
                                 std::span<const std::array<std::uint32_t, 3>> triangles,
                                 Hierarchy& hierarchy) {
  hierarchy.nodes.clear();
  if (triangles.empty()) throw std::invalid_argument("hierarchy: no triangles");
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t vertex : triangles[t])
      if (vertex >= vertices.size())
        throw std::invalid_argument("hierarchy: triangle " + std::to_string(t) + " names vertex " +
                                    std::to_string(vertex));
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (!std::isfinite(vertices[v].x) || !std::isfinite(vertices[v].y))
      throw std::invalid_argument("hierarchy: vertex " + std::to_string(v) + " is not finite");
  hierarchy.reach = reach(vertices);
  require_reach(hierarchy.reach);
  begin(hierarchy.reach, 0, 0);
  for (const auto& [a, b, c] : triangles) add_triangle({vertices[a], vertices[b], vertices[c]});
  grow(false);
  publish(hierarchy);
}

void HierarchyBuilder::begin(double reach, double margin, double threshold) {
  margin_ = margin + rounding::query_margin * reach;
  threshold_ = threshold;
  // Half the diagonal of its box bounds a node's radius, but for the rounding of the centre.
  const double half = std::max(0.0, threshold * (1 - 0x1p-40) - 2 * rounding::unit_roundoff * reach);
  sure_square_diagonal_ = 4 * half * half;
  longest_square_length_ = largest_square(2 * threshold);
  items_.clear();
  item_elements_.clear();
  unsolved_.clear();
  node_count_ = element_count_ = 0;
}

void HierarchyBuilder::add_segment(Vec2 a, Vec2 b) {
  SplitItem item;
  item.weight = std::sqrt(square_distance(a, b));
  const auto set = [&](int axis, float at_a, float at_b) {
    item.low[axis] = std::min(at_a, at_b);
    item.high[axis] = std::max(at_a, at_b);
    item.middle[axis] = 0.5 * (widened(at_a) + widened(at_b));
    item.moment[axis] = item.weight * item.middle[axis];
  };
  set(0, a.x, b.x);
  set(1, a.y, b.y);
  items_.push_back(item);
  item_elements_.push_back({a, b, b});
}

void HierarchyBuilder::add_triangle(const Element& triangle) {
  const auto& [a, b, c] = triangle;
  SplitItem item;
  item.weight = 3;
  const auto set = [&](int axis, float at_a, float at_b, float at_c) {
    item.low[axis] = std::min({at_a, at_b, at_c});
    item.high[axis] = std::max({at_a, at_b, at_c});
    item.moment[axis] = widened(at_a) + widened(at_b) + widened(at_c);
    item.middle[axis] = item.moment[axis] / 3;
  };
  set(0, a.x, b.x, c.x);
  set(1, a.y, b.y, c.y);
  items_.push_back(item);
  item_elements_.push_back(triangle);
}

/// First the tree, depth first, whose shape needs few discs, then the other discs, then what follows from
/// both.
void HierarchyBuilder::grow(bool through_centre) {
  order_.resize(items_.size());
  scratch_.resize(items_.size());
  std::iota(order_.begin(), order_.end(), 0);
  open_.assign(1, {0, static_cast<std::uint32_t>(items_.size()), none});
  while (!open_.empty()) {
    const Open open = open_.back();
    open_.pop_back();
    if (open.second_child_of != none) nodes_.second_child[open.second_child_of] = node_count_;
    add_node(open, through_centre);
  }
  solve_discs();
}

void HierarchyBuilder::add_node(Open open, bool through_centre) {
  const std::span order = std::span(order_).subspan(open.begin, open.end - open.begin);
  if (order.size() == 1 && threshold_ > 0) {
    const Element& segment = item_elements_[order[0]];
    return add_halves(segment.a, segment.b, order[0]);
  }
  const std::uint32_t node = add_node();
  unsolved_.push_back({node, open.begin, open.end});
  const SplitMeasure box = measure(items_, order);
  if (order.size() == 1 || is_leaf(order, box)) {
    for (const std::uint32_t item : order) add_element(item_elements_[item], item);
    return;
  }
  const auto middle =
      open.begin + static_cast<std::uint32_t>(divide(items_, order, box, through_centre, scratch_));
  open_.push_back({middle, open.end, node});
  open_.push_back({open.begin, middle, none});
}

/// The disc about a box holds its node's, whose diameter is at least the box's longer side: the disc itself
/// decides only between.
bool HierarchyBuilder::is_leaf(std::span<const std::uint32_t> order, const SplitMeasure& box) {
  const double x = box.extent(0), y = box.extent(1);
  if (0.5 * std::max(x, y) >= threshold_) return false;
  if (x * x + y * y < sure_square_diagonal_) return true;
  gather_points(order);
  return smallest_enclosing_disc(points_).radius < threshold_;
}

/// A lone segment and, below, what it is halved into. The midpoint that divides it is its disc's centre.
void HierarchyBuilder::add_halves(Vec2 a, Vec2 b, std::uint32_t source) {
  std::size_t open_count = 0;
  for (;;) {
    const std::uint32_t node = add_node();
    const Vec2 middle{static_cast<float>(0.5 * (widened(a.x) + widened(b.x))),
                      static_cast<float>(0.5 * (widened(a.y) + widened(b.y)))};
    nodes_.centre[node] = middle;
    nodes_.square_radius[node] = std::max(square_distance(a, middle), square_distance(b, middle));
    if (square_distance(a, b) > longest_square_length_ && !(middle == a) && !(middle == b)) {
      halves_[open_count++] = {node, b};
      b = middle;
      continue;
    }
    add_element({a, b, b}, source);
    if (open_count == 0) return;
    const Half& half = halves_[--open_count];
    nodes_.second_child[half.node] = node_count_;
    a = nodes_.centre[half.node];
    b = half.end;
  }
}

std::uint32_t HierarchyBuilder::add_node() {
  if (node_count_ == nodes_.centre.size()) {
    if (node_count_ == most_nodes)
      throw std::length_error("hierarchy: more than 2^22 nodes at a threshold of " +
                              std::to_string(threshold_) + " m");
    nodes_.resize(std::min(most_nodes, 2 * std::size_t{node_count_} + 256));
  }
  nodes_.second_child[node_count_] = 0;
  nodes_.element_begin[node_count_] = element_count_;
  return node_count_++;
}

void HierarchyBuilder::add_element(const Element& element, std::uint32_t source) {
  if (element_count_ == elements_.size()) {
    elements_.resize(2 * elements_.size() + 256);
    sources_.resize(elements_.size());
  }
  elements_[element_count_] = element;
  sources_[element_count_++] = source;
}

void HierarchyBuilder::gather_points(std::span<const std::uint32_t> order) {
  points_.resize(3 * order.size());
  last_point_.resize(order.size());
  first_point_.resize(order.size());
  std::uint32_t count = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto& [a, b, c] = item_elements_[order[k]];
    first_point_[k] = count;
    points_[count++] = a;
    points_[count] = b;
    count += !(b == c);
    points_[count] = c;
    last_point_[k] = count;
    count += k + 1 == order.size() || !(c == item_elements_[order[k + 1]].a);
  }
  points_.resize(count);
}

void HierarchyBuilder::solve_discs() {
  gather_points(order_);
  sets_.clear();
  for (const Unsolved& node : unsolved_)
    sets_.push_back({first_point_[node.begin], last_point_[node.end - 1] + 1});
  discs_.resize(sets_.size());
  solver_.solve(points_, sets_, discs_);
  for (std::size_t i = 0; i < discs_.size(); ++i) {
    nodes_.centre[unsolved_[i].node] = discs_[i].centre;
    nodes_.square_radius[unsolved_[i].node] = discs_[i].square_radius;
  }
}

void HierarchyBuilder::publish(Hierarchy& hierarchy) {
  hierarchy.elements.assign(elements_.begin(), elements_.begin() + element_count_);
  hierarchy.source.assign(sources_.begin(), sources_.begin() + element_count_);
  publish_nodes(nodes_, node_count_, margin_, hierarchy);
}

}  // namespace bch
