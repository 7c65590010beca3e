// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "layout/enclosing_disc.hpp"
#include "layout/rounding.hpp"

namespace bch {
namespace {

constexpr std::size_t most_nodes = std::size_t{1} << 22;

/// An element on its way down, with the doubled coordinates of the point that decides its side.
struct Item {
  Element element;
  std::uint32_t source;
  double x, y;  ///< midpoint of a segment, centroid of a triangle
  double weight;
};

/// A way to divide a node's items. Both functions may reorder them.
struct Rules {
  double threshold;  ///< a node of a smaller radius is a leaf; 0: only single elements are
  bool halve;        ///< lone segments longer than twice the threshold
  /// Where to cut along an axis (0: x, 1: y).
  double (*plane)(std::span<const Item> items, int axis);
};

double coordinate(const Vec2& p, int axis) {
  return axis == 0 ? p.x : p.y;
}
double coordinate(const Item& item, int axis) {
  return axis == 0 ? item.x : item.y;
}

std::pair<double, double> extent(std::span<const Item> items, int axis) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Item& item : items)
    for (const Vec2& p : {item.element.a, item.element.b, item.element.c}) {
      low = std::min(low, coordinate(p, axis));
      high = std::max(high, coordinate(p, axis));
    }
  return {low, high};
}

double plane_through_centroid(std::span<const Item> items, int axis) {
  double sum = 0, weight = 0;
  for (const Item& item : items) {
    sum += item.weight * coordinate(item, axis);
    weight += item.weight;
  }
  if (weight > 0) return sum / weight;
  for (const Item& item : items) sum += coordinate(item, axis);
  return sum / static_cast<double>(items.size());
}

double plane_through_centre(std::span<const Item> items, int axis) {
  const auto [low, high] = extent(items, axis);
  return 0.5 * (low + high);
}

double plane_through_vertex_mean(std::span<const Item> items, int axis) {
  double sum = 0;
  for (const Item& item : items)
    sum += coordinate(item.element.a, axis) + coordinate(item.element.b, axis) +
           coordinate(item.element.c, axis);
  return sum / (3 * static_cast<double>(items.size()));
}

/// Reorders the items so that neither side is empty; returns the size of the first.
std::size_t divide(std::span<Item> items, const Rules& rules) {
  const auto [x_low, x_high] = extent(items, 0);
  const auto [y_low, y_high] = extent(items, 1);
  const int longer = x_high - x_low >= y_high - y_low ? 0 : 1;
  for (const int axis : {longer, 1 - longer}) {
    const double plane = rules.plane(items, axis);
    const auto middle = std::stable_partition(
        items.begin(), items.end(), [&](const Item& item) { return coordinate(item, axis) < plane; });
    if (middle != items.begin() && middle != items.end())
      return static_cast<std::size_t>(middle - items.begin());
  }
  return items.size() / 2;
}

double length(const Element& segment) {
  const double x = static_cast<double>(segment.b.x) - static_cast<double>(segment.a.x);
  const double y = static_cast<double>(segment.b.y) - static_cast<double>(segment.a.y);
  return std::sqrt(x * x + y * y);
}

Item segment_item(Vec2 a, Vec2 b, std::uint32_t source) {
  const Element segment{a, b, b};
  return {segment, source, 0.5 * (static_cast<double>(a.x) + static_cast<double>(b.x)),
          0.5 * (static_cast<double>(a.y) + static_cast<double>(b.y)), length(segment)};
}

/// The halves of a lone segment, unless it is short enough or its midpoint cannot be told from an end.
std::optional<std::pair<Item, Item>> halves(const Item& item, const Rules& rules) {
  const auto [a, b, c] = item.element;
  if (!rules.halve || !(length(item.element) > 2 * rules.threshold)) return std::nullopt;
  const Vec2 middle{static_cast<float>(item.x), static_cast<float>(item.y)};
  if (middle == a || middle == b) return std::nullopt;
  return std::pair{segment_item(a, middle, item.source), segment_item(middle, b, item.source)};
}

class Builder {
 public:
  Builder(std::vector<Item> items, const Rules& rules, double reach, double grid_margin)
      : items_(std::move(items)), rules_(rules), margin_(grid_margin + rounding::query_margin * reach) {
    hierarchy_.reach = reach;
  }

  Hierarchy build() {
    open_.push_back({0, items_.size(), {}, {}});
    while (!open_.empty()) {
      const Open open = open_.back();
      open_.pop_back();
      add_node(open);
    }
    close_ranges();
    set_bounds();
    return std::move(hierarchy_);
  }

 private:
  /// A node still to be made: items of the list, or half of a lone segment.
  struct Open {
    std::size_t begin, end;
    std::optional<Item> lone;
    std::optional<std::uint32_t>
        second_child_of;  ///< the node to be told this one's index, if it is not the next
  };

  void add_node(Open open) {
    if (hierarchy_.nodes.size() >= most_nodes)
      throw std::length_error("hierarchy: more than 2^22 nodes at a threshold of " +
                              std::to_string(rules_.threshold) + " m");
    const auto index = static_cast<std::uint32_t>(hierarchy_.nodes.size());
    if (open.second_child_of) hierarchy_.nodes[*open.second_child_of].second_child = index;
    const std::span<Item> items =
        open.lone ? std::span(&*open.lone, 1) : std::span(items_).subspan(open.begin, open.end - open.begin);

    const EnclosingDisc tight = enclosing_disc(items);
    HierarchyNode node;
    node.disc = {tight.centre.x, tight.centre.y, rounding::round_up(tight.radius * (1 + 0x1p-50) + margin_)};
    node.element_begin = static_cast<std::uint32_t>(hierarchy_.elements.size());
    hierarchy_.nodes.push_back(node);

    if (tight.radius < rules_.threshold) return add_elements(items);
    if (items.size() > 1) {
      const std::size_t middle = open.begin + divide(items, rules_);
      open_.push_back({middle, open.end, {}, index});
      open_.push_back({open.begin, middle, {}, {}});
    } else if (const auto halved = halves(items[0], rules_)) {
      open_.push_back({0, 0, halved->second, index});
      open_.push_back({0, 0, halved->first, {}});
    } else {
      add_elements(items);
    }
  }

  EnclosingDisc enclosing_disc(std::span<const Item> items) {
    points_.clear();
    for (const Item& item : items)
      points_.insert(points_.end(), {item.element.a, item.element.b, item.element.c});
    return smallest_enclosing_disc(points_);
  }

  void add_elements(std::span<const Item> items) {
    for (const Item& item : items) {
      hierarchy_.elements.push_back(item.element);
      hierarchy_.source.push_back(item.source);
    }
  }

  void close_ranges() {
    auto& nodes = hierarchy_.nodes;
    const std::vector<std::uint32_t> end = subtree_ends(nodes);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      nodes[i].element_end = end[i] < nodes.size() ? nodes[end[i]].element_begin
                                                   : static_cast<std::uint32_t>(hierarchy_.elements.size());
  }

  void set_bounds() {
    auto& nodes = hierarchy_.nodes;
    const std::vector<std::uint32_t> end = subtree_ends(nodes);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      double bound = nodes[i].disc.radius;
      for (std::size_t below = i + 1; below < end[i]; ++below) {
        const double x = static_cast<double>(nodes[below].disc.x) - static_cast<double>(nodes[i].disc.x);
        const double y = static_cast<double>(nodes[below].disc.y) - static_cast<double>(nodes[i].disc.y);
        bound = std::max(bound, std::sqrt(x * x + y * y) + static_cast<double>(nodes[below].disc.radius));
      }
      // A leaf prunes nothing: its bound is its disc, so that a traversal may test bounds throughout.
      nodes[i].bound =
          nodes[i].is_leaf()
              ? nodes[i].disc.radius
              : rounding::round_up(bound * (1 + 0x1p-50) + rounding::nesting_margin * hierarchy_.reach);
    }
  }

  std::vector<Item> items_;
  Rules rules_;
  double margin_;
  Hierarchy hierarchy_;
  std::vector<Open> open_;
  std::vector<Vec2> points_;
};

void require_reach(double reach) {
  if (!(reach >= rounding::smallest_reach && reach <= rounding::largest_reach))
    throw std::invalid_argument("hierarchy: reach " + std::to_string(reach) + " m is outside 1e-6 to 1e6 m");
}

}  // namespace

Hierarchy contour_hierarchy(const Outline& outline, float threshold, SplitRule rule) {
  validate(outline);
  if (!(threshold > 0) || !std::isfinite(threshold))
    throw std::invalid_argument("hierarchy: threshold " + std::to_string(threshold) +
                                " m is not positive and finite");
  std::vector<Item> items;
  items.reserve(outline.points.size());
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto points = outline.contour(c);
    for (std::size_t i = 0; i < points.size(); ++i)
      items.push_back(segment_item(points[i], points[i + 1 < points.size() ? i + 1 : 0],
                                   outline.contour_begin[c] + static_cast<std::uint32_t>(i)));
  }
  const Rules rules{static_cast<double>(threshold), true,
                    rule == SplitRule::centroid ? plane_through_centroid : plane_through_centre};
  return Builder(std::move(items), rules, reach(outline.points),
                 rounding::outline_grid_steps * static_cast<double>(outline.grid_step))
      .build();
}

Hierarchy projected_hierarchy(std::span<const Vec2> vertices,
                              std::span<const std::array<std::uint32_t, 3>> triangles) {
  if (triangles.empty()) throw std::invalid_argument("hierarchy: no triangles");
  std::vector<Item> items;
  items.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t vertex : triangles[t])
      if (vertex >= vertices.size())
        throw std::invalid_argument("hierarchy: triangle " + std::to_string(t) + " names vertex " +
                                    std::to_string(vertex));
    const Element e{vertices[triangles[t][0]], vertices[triangles[t][1]], vertices[triangles[t][2]]};
    const auto mean = [&](int axis) {
      return (coordinate(e.a, axis) + coordinate(e.b, axis) + coordinate(e.c, axis)) / 3;
    };
    items.push_back({e, static_cast<std::uint32_t>(t), mean(0), mean(1), 1});
  }
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (!std::isfinite(vertices[v].x) || !std::isfinite(vertices[v].y))
      throw std::invalid_argument("hierarchy: vertex " + std::to_string(v) + " is not finite");
  const double size = reach(vertices);
  require_reach(size);
  return Builder(std::move(items), {0, false, plane_through_vertex_mean}, size, 0).build();
}

Hierarchy fixed_cylinder(float radius) {
  const double size = radius;
  require_reach(size);
  Hierarchy hierarchy;
  hierarchy.reach = size;
  HierarchyNode root;
  root.disc = {0, 0, rounding::round_up(size * (1 + rounding::query_margin))};
  root.bound = root.disc.radius;
  hierarchy.nodes.push_back(root);
  return hierarchy;
}

std::vector<std::uint32_t> subtree_ends(std::span<const HierarchyNode> nodes) {
  std::vector<std::uint32_t> end(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;)
    end[i] = nodes[i].is_leaf() ? static_cast<std::uint32_t>(i + 1) : end[nodes[i].second_child];
  return end;
}

std::vector<std::uint32_t> cut(const Hierarchy& hierarchy, std::uint32_t depth) {
  std::vector<std::uint32_t> nodes;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open = {{0, 0}};  // node, depth
  while (!open.empty()) {
    const auto [index, level] = open.back();
    open.pop_back();
    const HierarchyNode& node = hierarchy.nodes[index];
    if (node.is_leaf() || level == depth) {
      nodes.push_back(index);
      continue;
    }
    open.push_back({node.second_child, level + 1});
    open.push_back({index + 1, level + 1});
  }
  return nodes;
}

std::uint32_t height(const Hierarchy& hierarchy) {
  std::vector<std::uint32_t> depth(hierarchy.nodes.size());
  std::uint32_t deepest = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    deepest = std::max(deepest, depth[i]);
    if (hierarchy.nodes[i].is_leaf()) continue;
    depth[i + 1] = depth[hierarchy.nodes[i].second_child] = depth[i] + 1;
  }
  return deepest;
}

}  // namespace bch
