// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/reference_hierarchy.hpp"

#include <gtest/gtest.h>

#include "baselines/welzl.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/contours.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"

namespace bch::test {
namespace {

struct Segment {
  Vec2 a, b;
  std::uint32_t source;

  double middle(int axis) const { return 0.5 * (coordinate(a, axis) + coordinate(b, axis)); }
  /// What decides sides is in float, the middle too.
  float weight() const {
    const float x = b.x - a.x, y = b.y - a.y;
    return std::sqrt(x * x + y * y);
  }
  float side(int axis) const { return static_cast<float>(middle(axis)); }
  double length() const {
    const double x = coordinate(b, 0) - coordinate(a, 0), y = coordinate(b, 1) - coordinate(a, 1);
    return std::sqrt(x * x + y * y);
  }
  static double coordinate(Vec2 p, int axis) { return axis == 0 ? p.x : p.y; }
};
using Segments = std::vector<Segment>;

class Reference {
 public:
  Reference(const Outline& outline, double threshold, detail::SplitRule rule)
      : threshold_(threshold), rule_(rule) {
    hierarchy_.reach = detail::reach(outline.points);
    margin_ = detail::rounding::query_margin * hierarchy_.reach +
              detail::rounding::outline_grid_steps * static_cast<double>(outline.grid_step);
  }

  void add(const Segments& segments) {
    auto& nodes = hierarchy_.nodes;
    const std::size_t index = nodes.size();
    const double radius = add_node(segments);
    if (radius < threshold_ || !divisible(segments)) {
      for (const auto& [a, b, source] : segments) {
        hierarchy_.primitives.push_back({a, b, b});
        hierarchy_.source.push_back(source);
      }
    } else {
      const auto [first, second] = segments.size() > 1 ? divide(segments) : halve(segments[0]);
      add(first);
      nodes[index].second_child = static_cast<std::uint32_t>(nodes.size());
      add(second);
    }
    hierarchy_.primitive_ranges[index].end = static_cast<std::uint32_t>(hierarchy_.primitives.size());
  }

  Hierarchy hierarchy_;

 private:
  double add_node(const Segments& segments) {
    std::vector<Vec2> points;
    for (const Segment& segment : segments) points.insert(points.end(), {segment.a, segment.b});
    const auto disc = welzl_(points);
    const auto x = static_cast<float>(disc.x), y = static_cast<float>(disc.y);
    double radius = 0;
    for (const Vec2 p : points) {
      const double dx = static_cast<double>(p.x) - static_cast<double>(x),
                   dy = static_cast<double>(p.y) - static_cast<double>(y);
      radius = std::max(radius, std::sqrt(dx * dx + dy * dy));
    }
    Hierarchy::Node node;
    node.disc = {x, y, detail::rounding::round_up(radius + margin_)};
    hierarchy_.primitive_ranges.push_back({static_cast<std::uint32_t>(hierarchy_.primitives.size()), 0});
    hierarchy_.nodes.push_back(node);
    return radius;
  }

  static Vec2 middle(const Segment& segment) {
    return {static_cast<float>(segment.middle(0)), static_cast<float>(segment.middle(1))};
  }

  bool divisible(const Segments& segments) const {
    if (segments.size() > 1) return true;
    const Vec2 m = middle(segments[0]);
    return segments[0].length() > 2 * threshold_ && !(m == segments[0].a) && !(m == segments[0].b);
  }

  static std::pair<Segments, Segments> halve(const Segment& segment) {
    const auto& [a, b, source] = segment;
    return {{{a, middle(segment), source}}, {{middle(segment), b, source}}};
  }

  static std::pair<double, double> extent(const Segments& segments, int axis) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const auto& [a, b, source] : segments)
      for (const Vec2 p : {a, b}) {
        low = std::min(low, Segment::coordinate(p, axis));
        high = std::max(high, Segment::coordinate(p, axis));
      }
    return {low, high};
  }

  float plane(const Segments& segments, int axis) const {
    const auto [low, high] = extent(segments, axis);
    if (rule_ == detail::SplitRule::centre) return static_cast<float>(0.5 * (low + high));
    float sum = 0, weight = 0, plain = 0;
    for (const Segment& segment : segments) {
      sum += segment.weight() * segment.side(axis);
      weight += segment.weight();
      plain += segment.side(axis);
    }
    return weight > 0 ? sum / weight : plain / static_cast<float>(segments.size());
  }

  std::pair<Segments, Segments> divide(const Segments& segments) const {
    const auto size = [&](int axis) {
      const auto [low, high] = extent(segments, axis);
      return static_cast<float>(high) - static_cast<float>(low);
    };
    const int longer = size(0) >= size(1) ? 0 : 1;
    for (const int axis : {longer, 1 - longer}) {
      Segments first, second;
      const float at = plane(segments, axis);
      for (const Segment& segment : segments) (segment.side(axis) < at ? first : second).push_back(segment);
      if (!first.empty() && !second.empty()) return {first, second};
    }
    const auto half = segments.begin() + static_cast<std::ptrdiff_t>(segments.size() / 2);
    return {{segments.begin(), half}, {half, segments.end()}};
  }

  double threshold_, margin_;
  detail::SplitRule rule_;
  bench::Welzl welzl_;
};

}  // namespace

Hierarchy reference_hierarchy(const Outline& outline, float threshold, detail::SplitRule rule) {
  Segments segments;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto points = outline.contour(c);
    for (std::size_t i = 0; i < points.size(); ++i)
      segments.push_back({points[i], points[(i + 1) % points.size()],
                          outline.contour_begin[c] + static_cast<std::uint32_t>(i)});
  }
  Reference reference(outline, static_cast<double>(threshold), rule);
  reference.add(segments);
  return reference.hierarchy_;
}

void expect_same_tree(const Hierarchy& hierarchy, const Hierarchy& reference) {
  ASSERT_EQ(hierarchy.nodes.size(), reference.nodes.size());
  EXPECT_EQ(hierarchy.source, reference.source);
  ASSERT_EQ(hierarchy.primitives.size(), reference.primitives.size());
  for (std::size_t i = 0; i < hierarchy.primitives.size(); ++i) {
    EXPECT_EQ(hierarchy.primitives[i].a, reference.primitives[i].a);
    EXPECT_EQ(hierarchy.primitives[i].b, reference.primitives[i].b);
  }
  for (std::size_t i = 0; i < hierarchy.nodes.size(); ++i) {
    const Hierarchy::Node &node = hierarchy.nodes[i], &expected = reference.nodes[i];
    ASSERT_EQ(node.second_child, expected.second_child) << "node " << i;
    ASSERT_EQ(hierarchy.primitive_ranges[i].begin, reference.primitive_ranges[i].begin) << "node " << i;
    ASSERT_EQ(hierarchy.primitive_ranges[i].end, reference.primitive_ranges[i].end) << "node " << i;
    EXPECT_NEAR(node.disc.radius, expected.disc.radius,
                1e-6 * static_cast<double>(expected.disc.radius) + 0x1p-23 * hierarchy.reach)
        << "node " << i;
  }
}

}  // namespace bch::test
