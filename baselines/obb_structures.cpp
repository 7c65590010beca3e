// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <utility>

#include "baselines/built.hpp"
#include "baselines/exact_tests.hpp"
#include "baselines/kind_rows.hpp"
#include "baselines/obb_overlap.hpp"
#include "baselines/traversal_stack.hpp"

// Trees of oriented boxes over three kinds of facets, with the exact test of each kind in the leaves.

namespace bch::baselines {
namespace {

/// Triangles in space.
struct SolidTriangles {
  static bool meet(const Facet& a, const Facet& b, const Placement& at) noexcept {
    Triangle3 s, t;
    for (std::size_t i = 0; i < 3; ++i) {
      s[i] = {static_cast<double>(a[i].x()), static_cast<double>(a[i].y()), static_cast<double>(a[i].z())};
      const Point2 p = at.place(static_cast<double>(b[i].x()), static_cast<double>(b[i].y()));
      t[i] = {p.x, p.y, static_cast<double>(b[i].z())};
    }
    return triangles_meet(s, t);
  }
};

/// Triangles seen from above.
struct FlatTriangles {
  static bool meet(const Facet& a, const Facet& b, const Placement& at) noexcept {
    Triangle2 s, t;
    for (std::size_t i = 0; i < 3; ++i) {
      s[i] = {static_cast<double>(a[i].x()), static_cast<double>(a[i].y())};
      t[i] = at.place(static_cast<double>(b[i].x()), static_cast<double>(b[i].y()));
    }
    return triangles_meet(s, t);
  }
};

/// Segments of the outline.
struct OutlineSegments {
  static bool meet(const Facet& a, const Facet& b, const Placement& at) noexcept {
    const auto fixed = [](const Eigen::Vector3f& p) {
      return Point2{static_cast<double>(p.x()), static_cast<double>(p.y())};
    };
    const auto placed = [&](const Eigen::Vector3f& p) {
      return at.place(static_cast<double>(p.x()), static_cast<double>(p.y()));
    };
    return segments_meet({fixed(a[0]), fixed(a[1])}, {placed(b[0]), placed(b[1])});
  }
};

template <class Facets>
struct ObbModel {
  ObbTree tree;

  std::size_t bytes() const { return tree.bytes(); }

  template <class Counts>
  static bool meet(const ObbModel& a, const ObbModel& b, const Agents& agents, Pair pair,
                   std::uint32_t max_depth, Counts counts) {
    const Placement at = placement(agents, pair);
    TraversalStack open(std::size_t{a.tree.height} + b.tree.height + 1);
    open.push({0, 0, 0, 0});
    PlacedBox placed;
    std::uint32_t placed_node = 0xffffffff;
    while (!open.empty()) {
      const NodePair visit = open.pop();
      const ObbNode &node_a = a.tree.nodes[visit.a], &node_b = b.tree.nodes[visit.b];
      if (visit.b != placed_node) {
        placed = place(at, node_b);
        placed_node = visit.b;
      }
      counts.node();
      if (!boxes_overlap(node_a, placed)) continue;
      const bool cut_a = visit.depth_a == max_depth, cut_b = visit.depth_b == max_depth;
      const bool end_a = cut_a || node_a.is_leaf(), end_b = cut_b || node_b.is_leaf();
      if (end_a && end_b) {
        if (cut_a || cut_b) return true;
        counts.leaf();
        if (Facets::meet(a.tree.facets[node_a.facet()], b.tree.facets[node_b.facet()], at)) return true;
      } else if (end_b || (!end_a && node_a.half[0] >= node_b.half[0])) {
        open.push({node_a.link, visit.b, visit.depth_a + 1, visit.depth_b});
        open.push({visit.a + 1, visit.b, visit.depth_a + 1, visit.depth_b});
      } else {
        open.push({visit.a, node_b.link, visit.depth_a, visit.depth_b + 1});
        open.push({visit.a, visit.b + 1, visit.depth_a, visit.depth_b + 1});
      }
    }
    return false;
  }
};

}  // namespace

std::unique_ptr<Structure> build_obb_full(std::span<const Body> bodies, const BuildOptions&) {
  return build_models<ObbModel<SolidTriangles>>(bodies, [](const Body& body) -> ObbModel<SolidTriangles> {
    return {build_obb_tree(triangle_facets(body.positions, body.triangles))};
  });
}

std::unique_ptr<Structure> build_obb_contour(std::span<const Body> bodies, const BuildOptions&) {
  return build_models<ObbModel<OutlineSegments>>(bodies, [](const Body& body) -> ObbModel<OutlineSegments> {
    const Outline& outline = body.shape.outline;
    validate(outline);
    std::vector<Facet> facets;
    for (std::size_t c = 0; c < outline.contours(); ++c) {
      const auto points = outline.contour(c);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec2 p = points[i], q = points[(i + 1) % points.size()];
        facets.push_back(
            {Eigen::Vector3f(p.x, p.y, 0), Eigen::Vector3f(q.x, q.y, 0), Eigen::Vector3f(q.x, q.y, 0)});
      }
    }
    return {build_obb_tree(std::move(facets))};
  });
}

std::unique_ptr<Structure> build_obb_projected(std::span<const Body> bodies, const BuildOptions&) {
  return build_models<ObbModel<FlatTriangles>>(bodies, [](const Body& body) -> ObbModel<FlatTriangles> {
    std::vector<Facet> facets = triangle_facets(body.positions, body.triangles);
    for (Facet& facet : facets)
      for (Eigen::Vector3f& p : facet) p.z() = 0;
    return {build_obb_tree(std::move(facets))};
  });
}

}  // namespace bch::baselines
