// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/reference.hpp"

#include <algorithm>

#include "baselines/oracle.hpp"
#include "layout/heading.hpp"

namespace bch::baselines {
namespace {

/// Where B is, seen from A.
struct Relative {
  float cosine, sine, x, y;
};

Relative relative(const Agents& agents, std::uint32_t a, std::uint32_t b) {
  const UnitVector u = unit_vector(agents.heading[a]);
  const UnitVector v = unit_vector(agents.heading[b]);
  const float dx = static_cast<float>(agents.x[b] - agents.x[a]);
  const float dy = static_cast<float>(agents.y[b] - agents.y[a]);
  return {u.cosine * v.cosine + u.sine * v.sine, u.cosine * v.sine - u.sine * v.cosine,
          u.cosine * dx + u.sine * dy, u.cosine * dy - u.sine * dx};
}

bool overlap(const Relative& place, Vec2 a, float radius_a, Vec2 b, float radius_b) {
  const float x = place.x + (place.cosine * b.x - place.sine * b.y) - a.x;
  const float y = place.y + (place.sine * b.x + place.cosine * b.y) - a.y;
  const float radius_sum = radius_a + radius_b;
  return x * x + y * y <= radius_sum * radius_sum;
}

bool any_overlap(const Relative& place, std::span<const Disc> a, std::span<const Disc> b) {
  for (const Disc& p : a)
    for (const Disc& q : b)
      if (overlap(place, {p.x, p.y}, p.radius, {q.x, q.y}, q.radius)) return true;
  return false;
}

/// A node as a traversal down to a depth sees it.
struct Visit {
  std::uint32_t node, depth;
};

class Traversal {
 public:
  Traversal(const Relative& place, const Hierarchy& a, std::uint32_t depth_a, const Hierarchy& b,
            std::uint32_t depth_b)
      : place_(place), a_{a.nodes.data(), depth_a}, b_{b.nodes.data(), depth_b} {}

  bool run() {
    open_.push_back({{0, 0}, {0, 0}});
    while (!open_.empty()) {
      const auto [a, b] = open_.back();
      open_.pop_back();
      const float radius_a = a_.radius(a), radius_b = b_.radius(b);
      const Disc &disc_a = a_.nodes[a.node].disc, &disc_b = b_.nodes[b.node].disc;
      if (!overlap(place_, {disc_a.x, disc_a.y}, radius_a, {disc_b.x, disc_b.y}, radius_b)) continue;
      const bool end_a = a_.ends_at(a), end_b = b_.ends_at(b);
      if (end_a && end_b) return true;
      if (end_b || (!end_a && radius_a >= radius_b)) {
        open_.push_back({a_.second(a), b});
        open_.push_back({a_.first(a), b});
      } else {
        open_.push_back({a, b_.second(b)});
        open_.push_back({a, b_.first(b)});
      }
    }
    return false;
  }

 private:
  struct Tree {
    const HierarchyNode* nodes;
    std::uint32_t depth;

    bool ends_at(Visit v) const { return v.depth == depth || nodes[v.node].is_leaf(); }
    float radius(Visit v) const { return ends_at(v) ? nodes[v.node].disc.radius : nodes[v.node].bound; }
    Visit first(Visit v) const { return {v.node + 1, v.depth + 1}; }
    Visit second(Visit v) const { return {nodes[v.node].second_child, v.depth + 1}; }
  };

  Relative place_;
  Tree a_, b_;
  std::vector<std::pair<Visit, Visit>> open_;
};

}  // namespace

Reference::Reference(std::span<const Shape> shapes, const ShapeSetPlan& plan)
    : shapes_(shapes), level_count_(static_cast<std::uint32_t>(plan.depths.size())) {
  for (const Shape& shape : shapes)
    for (const std::uint32_t depth : plan.depths) {
      Level level{depth, {}};
      for (const std::uint32_t node : cut(shape.hierarchy, depth))
        level.discs.push_back(shape.hierarchy.nodes[node].disc);
      levels_.push_back(std::move(level));
    }
}

const Reference::Level& Reference::level(const Agents& agents, std::uint32_t agent) const {
  const std::uint32_t index = agents.level.empty() ? level_count_ - 1 : agents.level[agent];
  return levels_[std::size_t{agents.shape[agent]} * level_count_ + index];
}

bool Reference::boundary(const Agents& agents, Pair pair, Method method) const {
  const auto [a, b] = std::minmax(pair.first, pair.second);
  const Relative place = relative(agents, a, b);
  const Level &level_a = level(agents, a), &level_b = level(agents, b);
  if (method == Method::brute_force) return any_overlap(place, level_a.discs, level_b.discs);
  return Traversal(place, shapes_[agents.shape[a]].hierarchy, level_a.depth,
                   shapes_[agents.shape[b]].hierarchy, level_b.depth)
      .run();
}

bool Reference::solid(const Agents& agents, Pair pair, Method method) const {
  if (boundary(agents, pair, method)) return true;
  const auto [a, b] = pair;
  return Oracle(shapes_[agents.shape[a]].outline, shapes_[agents.shape[b]].outline,
                exact_placement(agents, a, b))
      .nested();
}

}  // namespace bch::baselines
