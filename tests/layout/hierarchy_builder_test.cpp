// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/welzl.hpp"
#include "layout/base/rounding.hpp"
#include "layout/culling/supports.hpp"
#include "layout/format/contours.hpp"
#include "layout/hierarchy/builder.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "layout/shape_set/bvh8.hpp"
#include "tests/support/hierarchy_checks.hpp"
#include "tests/support/test.hpp"
#include "tests/support/test_characters.hpp"

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
    hierarchy_.max_extent = detail::max_extent(outline.points);
    margin_ = detail::rounding::query_margin * hierarchy_.max_extent +
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

/// Builds what contour_hierarchy() defines, word by word: node after node by recursion, discs by Welzl's
/// algorithm. Validates nothing.
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

/// Expects the same tree over the same primitives, and discs as large up to a 1e-6 part and the rounding of
/// their centres.
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
                1e-6 * static_cast<double>(expected.disc.radius) + 0x1p-23 * hierarchy.max_extent)
        << "node " << i;
  }
}

void expect_as_reference(const Outline& outline, float threshold) {
  detail::HierarchyBuilder builder;
  Hierarchy hierarchy;
  for (const detail::SplitRule rule : {detail::SplitRule::centroid, detail::SplitRule::centre}) {
    builder.contour(outline, threshold, rule, hierarchy);
    builder.add_primitives(hierarchy);
    expect_same_tree(hierarchy, reference_hierarchy(outline, threshold, rule));
    expect_sound(hierarchy);
    expect_covers_outline(hierarchy, outline);
    expect_leaves_below(hierarchy, threshold);
  }
}

TEST(HierarchyBuilder, EqualsTheReferenceOnManyShapes) {
  for (const Shape& shape : synthetic_shapes(31, 120))
    for (const float threshold : {0.003f, 0.01f, 0.2f}) expect_as_reference(shape.outline, threshold);
}

TEST(HierarchyBuilder, EqualsTheReferenceOnPoses) {
  for (const Character& character : people())
    for (const Shape& shape : pose_shapes(character, 100)) expect_as_reference(shape.outline, 0.01f);
}

/// Points of a kind: on a line, on a circle, few distinct ones, anywhere; a power of two keeps them exact.
Outline outline_of(Random& random, int kind, double scale) {
  Outline outline;
  const std::uint32_t count = 1 + random.below(60);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = random.uniform(-1, 1), angle = random.uniform(-4, 4);
    const double y = kind == 0 ? 0.5 * x : random.uniform(-1, 1);
    Vec2 p{static_cast<float>(x * scale), static_cast<float>(y * scale)};
    if (kind == 1)
      p = {static_cast<float>(std::cos(angle) * scale), static_cast<float>(std::sin(angle) * scale)};
    if (kind == 2) p = {static_cast<float>(std::round(x) * scale), static_cast<float>(std::round(y) * scale)};
    outline.points.push_back(p);
  }
  outline.points.push_back({static_cast<float>(0.75 * scale), 0});
  outline.contour_begin.push_back(count + 1);
  return counter_clockwise(std::move(outline));
}

TEST(HierarchyBuilder, EqualsTheReferenceOnDegenerateOutlines) {
  Random random(32);
  for (const double scale : {0x1p-19, 1.0, 0x1p19})
    for (int kind = 0; kind < 4; ++kind)
      for (int i = 0; i < 40; ++i)
        expect_as_reference(outline_of(random, kind, scale),
                            static_cast<float>(scale * random.uniform(0.01, 0.5)));
}

/// Segments about as long as decides how often they are halved, away from the origin, where midpoints are rounded.
TEST(HierarchyBuilder, EqualsTheReferenceWhereRoundingDecidesOnHalves) {
  Random random(38);
  const auto near = [&](double value) {
    return static_cast<float>(value + random.uniform(-4, 4) * detail::rounding::unit_roundoff);
  };
  for (int i = 0; i < 4000; ++i) {
    const double threshold = i % 2 == 0 ? 0.01 : 1e-7, angle = random.uniform(-4, 4);
    const double length = 2 * static_cast<double>(static_cast<float>(threshold)) * (1u << random.below(5));
    const double x = random.uniform(-0.7, 0.7), y = random.uniform(-0.7, 0.7);
    Outline outline;
    outline.points = {{near(x), near(y)},
                      {near(x + length * std::cos(angle)), near(y + length * std::sin(angle))},
                      {near(x + 0.3), near(y + 0.1)}};
    if (i % 2 != 0) outline.points.pop_back();
    outline.contour_begin.push_back(static_cast<std::uint32_t>(outline.points.size()));
    expect_as_reference(counter_clockwise(outline), static_cast<float>(threshold));
  }
}

/// Every disc of every cut, bit for bit.
TEST(HierarchyBuilder, EndsAtTheDeepestDepth) {
  detail::HierarchyBuilder builder;
  Hierarchy whole, limited;
  const auto discs = [](const Hierarchy& hierarchy, std::uint32_t depth) {
    std::vector<Disc> all;
    for (const std::uint32_t node : cut(hierarchy, depth)) all.push_back(hierarchy.nodes[node].disc);
    return all;
  };
  for (const Shape& shape : synthetic_shapes(36, 60))
    for (const float threshold : {0.0005f, 0.01f}) {
      builder.contour(shape.outline, threshold, detail::SplitRule::centroid, whole);
      for (std::uint32_t deepest = 0; deepest < detail::height(whole) + 2; ++deepest) {
        builder.contour(shape.outline, threshold, detail::SplitRule::centroid, limited, deepest);
        EXPECT_TRUE(limited.primitives.empty());
        builder.add_primitives(limited);
        expect_sound(limited);
        EXPECT_EQ(detail::height(limited), std::min(deepest, detail::height(whole)));
        EXPECT_EQ(limited.max_extent, whole.max_extent);
        for (std::uint32_t depth = 0; depth <= deepest; ++depth)
          ASSERT_EQ(discs(limited, depth), discs(whole, depth)) << depth << " of " << deepest;
      }
    }
}

TEST(HierarchyBuilder, LeavesNothingHalfDone) {
  detail::HierarchyBuilder builder;
  Hierarchy hierarchy;
  const Outline outline = synthetic_shapes(33, 1)[0].outline;
  builder.contour(outline, 0.01f, detail::SplitRule::centroid, hierarchy);
  builder.add_primitives(hierarchy);
  EXPECT_THROW(builder.contour(outline, 1e-8f, detail::SplitRule::centroid, hierarchy), std::length_error);
  EXPECT_TRUE(hierarchy.nodes.empty());
  EXPECT_TRUE(hierarchy.primitives.empty());
  builder.contour(outline, 0.01f, detail::SplitRule::centroid, hierarchy);
  builder.add_primitives(hierarchy);
  expect_same_tree(hierarchy, reference_hierarchy(outline, 0.01f, detail::SplitRule::centroid));
  EXPECT_THROW(builder.contour(outline, std::numeric_limits<float>::quiet_NaN(), detail::SplitRule::centroid,
                               hierarchy),
               std::invalid_argument);
  EXPECT_TRUE(hierarchy.nodes.empty());
}

/// Against the definition in double: rounding takes at most 8 of the margin's 320 units.
TEST(Bvh8Builder, SupportsAreThoseOfTheCut) {
  detail::Bvh8Builder flattener;
  detail::Bvh8 tree;
  for (const Shape& shape : synthetic_shapes(36, 32)) {
    flattener.begin(shape.hierarchy);
    for (const std::uint32_t depth : {0u, 3u, 6u, all_depths}) {
      flattener.flatten(depth, tree);
      const detail::Supports heights = flattener.supports();
      for (std::uint32_t k = 0; k < detail::support_stride; ++k) {
        // All even directions twice over, then all odd ones.
        const std::uint32_t direction =
            2 * (k % (detail::support_directions / 2)) + k / detail::support_directions;
        const double angle = 2 * std::acos(-1.0) * direction / detail::support_directions;
        double largest = -HUGE_VAL;
        for (const std::uint32_t node : cut(shape.hierarchy, depth)) {
          const Disc& disc = shape.hierarchy.nodes[node].disc;
          largest = std::max(largest, std::cos(angle) * static_cast<double>(disc.x) +
                                          std::sin(angle) * static_cast<double>(disc.y) +
                                          static_cast<double>(disc.radius));
        }
        const double unit = detail::rounding::unit_roundoff * shape.hierarchy.max_extent;
        EXPECT_NEAR(static_cast<double>(heights[k]),
                    largest + detail::rounding::support_margin * shape.hierarchy.max_extent, 10 * unit)
            << "direction " << k;
      }
    }
  }
}

}  // namespace
}  // namespace bch::test
