// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <cmath>
#include <stdexcept>
#include <string>

#include "baselines/built.hpp"
#include "baselines/disc_tree.hpp"
#include "baselines/exact_tests.hpp"
#include "baselines/kind_rows.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"

// Structures of discs but for the contour hierarchy: one cylinder, and the hierarchy over projected triangles.

namespace bch::baselines {
namespace {

/// Discs over all triangles seen from above, which leaves test exactly, or leave at their discs.
struct ProjectedHierarchy {
  std::vector<Hierarchy::Node> nodes;
  std::vector<Hierarchy::Primitive> triangles;     ///< in the order of the leaves; empty: discs alone
  std::vector<Hierarchy::Range> primitive_ranges;  ///< per node: of them
  std::uint32_t height;

  std::size_t bytes() const {
    return nodes.size() * sizeof(Hierarchy::Node) +
           (triangles.empty()
                ? 0
                : nodes.size() * sizeof(Hierarchy::Range) + triangles.size() * sizeof(Hierarchy::Primitive));
  }

  template <class Counts>
  static bool meet(const ProjectedHierarchy& a, const ProjectedHierarchy& b, const Agents& agents, Pair pair,
                   std::uint32_t max_depth, Counts counts) {
    const Placement place = placement(agents, pair);
    const FloatPlacement float_place = float_placement(agents, pair);
    const DiscTree tree_a{a.nodes.data(), max_depth, a.height}, tree_b{b.nodes.data(), max_depth, b.height};
    const auto accept = [&](const NodePair& at) {
      if (at.depth_a == max_depth || at.depth_b == max_depth || a.triangles.empty())
        return is_verified(float_place, tree_a, tree_b, at, counts);
      // Triangles that meet have a point in common, which lies in all discs above them.
      counts.leaf();
      const Hierarchy::Primitive &s = a.triangles[a.primitive_ranges[at.a].begin],
                                 &t = b.triangles[b.primitive_ranges[at.b].begin];
      return triangles_meet(Triangle2{exact(s.a), exact(s.b), exact(s.c)},
                            Triangle2{place.place(t.a), place.place(t.b), place.place(t.c)});
    };
    return any_ends_overlap(float_place, tree_a, tree_b, counts, accept);
  }
};

struct Cylinder {
  Disc disc;

  std::size_t bytes() const { return sizeof(Disc); }

  template <class Counts>
  static bool meet(const Cylinder& a, const Cylinder& b, const Agents& agents, Pair pair, std::uint32_t,
                   Counts counts) {
    counts.node();
    return discs_overlap(float_placement(agents, pair), a.disc, b.disc);
  }
};

const Hierarchy& checked_hierarchy(const Body& body) {
  if (body.shape.hierarchy.nodes.empty()) throw std::invalid_argument("a hierarchy without nodes");
  return body.shape.hierarchy;
}

}  // namespace

std::unique_ptr<Structure> build_single(std::span<const Body> bodies, const BuildOptions&) {
  return build_models<Cylinder>(
      bodies, [](const Body& body) -> Cylinder { return {checked_hierarchy(body).nodes[0].disc}; });
}

std::unique_ptr<Structure> build_bch_projected(std::span<const Body> bodies, const BuildOptions& options) {
  return build_models<ProjectedHierarchy>(bodies, [&](const Body& body) -> ProjectedHierarchy {
    std::vector<Vec2> vertices;
    for (const Vec3& p : body.positions) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw std::invalid_argument("vertex " + std::to_string(vertices.size()) + " is not finite");
      vertices.push_back({p.x, p.y});
    }
    Hierarchy hierarchy = detail::projected_hierarchy(vertices, body.triangles);
    const std::uint32_t levels = detail::height(hierarchy);
    if (!options.projected_triangles) hierarchy.primitives.clear();
    return {std::move(hierarchy.nodes), std::move(hierarchy.primitives),
            std::move(hierarchy.primitive_ranges), levels};
  });
}

std::unique_ptr<Structure> build_fixed(std::span<const Body> bodies, const BuildOptions& options) {
  const Disc disc = detail::fixed_cylinder(options.fixed_radius).nodes[0].disc;
  return build_models<Cylinder>(bodies, [&](const Body&) -> Cylinder { return {disc}; });
}

}  // namespace bch::baselines
