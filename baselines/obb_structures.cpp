// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <utility>

#include "baselines/box_traversal.hpp"
#include "baselines/built.hpp"
#include "baselines/exact_tests.hpp"
#include "baselines/kind_rows.hpp"
#include "baselines/obb_overlap.hpp"
#include "baselines/rectangle_tree.hpp"

// Trees of oriented boxes over three kinds of facets, with the exact test of each kind in the leaves.

namespace bch::baselines {
namespace {

Vec2 ground(const Eigen::Vector3f& p) {
  return {p.x(), p.y()};
}

/// Triangles in space.
struct SolidTriangles {
  static constexpr auto placed = placement_in_space;
  static bool meet(const Facet& a, const Facet& b, const Placement& at) noexcept {
    Triangle3 s, t;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point2 p = exact(ground(a[i])), q = at.place(ground(b[i]));
      s[i] = {p.x, p.y, static_cast<double>(a[i].z())};
      t[i] = {q.x, q.y, at.z + static_cast<double>(b[i].z())};
    }
    return triangles_meet(s, t);
  }
};

/// Triangles seen from above.
struct FlatTriangles {
  static constexpr auto placed = placement;
  static bool meet(const Facet& a, const Facet& b, const Placement& at) noexcept {
    Triangle2 s, t;
    for (std::size_t i = 0; i < 3; ++i) {
      s[i] = exact(ground(a[i]));
      t[i] = at.place(ground(b[i]));
    }
    return triangles_meet(s, t);
  }
};

/// Segments of the outline.
struct OutlineSegments {
  static constexpr auto placed = placement;
  static bool meet(const Facet& a, const Facet& b, const Placement& at) noexcept {
    return segments_meet({exact(ground(a[0])), exact(ground(a[1]))},
                         {at.place(ground(b[0])), at.place(ground(b[1]))});
  }
};

/// The same, as the tree of rectangles holds them.
struct FlatSegments {
  static constexpr auto placed = placement;
  static bool meet(const RectangleTree::Segment& a, const RectangleTree::Segment& b,
                   const Placement& at) noexcept {
    return segments_meet({exact(a.a), exact(a.b)}, {at.place(b.a), at.place(b.b)});
  }
};

template <class Tree, class Facets>
struct BoxModel {
  Tree tree;

  std::size_t bytes() const { return tree.bytes(); }

  template <class Counts>
  static bool meet(const BoxModel& a, const BoxModel& b, const Agents& agents, Pair pair,
                   std::uint32_t max_depth, Counts counts) {
    using Node = typename decltype(Tree::nodes)::value_type;
    const Placement at = Facets::placed(agents, pair);
    const BoxHierarchy<Node> tree_a{a.tree.nodes.data(), a.tree.height},
        tree_b{b.tree.nodes.data(), b.tree.height};
    return any_facets_meet(at, tree_a, tree_b, max_depth, counts, [&](std::uint32_t p, std::uint32_t q) {
      return Facets::meet(a.tree.facets[p], b.tree.facets[q], at);
    });
  }
};

template <class Facets>
using ObbModel = BoxModel<ObbTree, Facets>;
using RectangleModel = BoxModel<RectangleTree, FlatSegments>;

}  // namespace

std::vector<Facet> projected_facets(std::span<const Vec3> positions,
                                    std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<Facet> facets = triangle_facets(positions, triangles);
  for (Facet& facet : facets)
    for (Eigen::Vector3f& p : facet) p.z() = 0;
  return facets;
}

std::vector<Facet> contour_facets(const Outline& outline) {
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
  return facets;
}

std::unique_ptr<Structure> build_obb_full(std::span<const Body> bodies, const BuildOptions&) {
  return build_models<ObbModel<SolidTriangles>>(bodies, [](const Body& body) -> ObbModel<SolidTriangles> {
    return {build_obb_tree(triangle_facets(body.positions, body.triangles))};
  });
}

std::unique_ptr<Structure> build_obb_contour(std::span<const Body> bodies, const BuildOptions&) {
  return build_models<ObbModel<OutlineSegments>>(bodies, [](const Body& body) -> ObbModel<OutlineSegments> {
    return {build_obb_tree(contour_facets(body.shape.outline))};
  });
}

std::unique_ptr<Structure> build_obb_contour_2d(std::span<const Body> bodies, const BuildOptions&) {
  return build_models<RectangleModel>(bodies, [](const Body& body) -> RectangleModel {
    return {RectangleTree(build_obb_tree(contour_facets(body.shape.outline)))};
  });
}

std::unique_ptr<Structure> build_obb_projected(std::span<const Body> bodies, const BuildOptions&) {
  return build_models<ObbModel<FlatTriangles>>(bodies, [](const Body& body) -> ObbModel<FlatTriangles> {
    return {build_obb_tree(projected_facets(body.positions, body.triangles))};
  });
}

}  // namespace bch::baselines
