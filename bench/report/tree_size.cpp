// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/report/tree_size.hpp"

#include <algorithm>

#include "baselines/obb_tree.hpp"

namespace bch::report {
namespace {

template <class Items, class Size>
TreeSize mean_of(const Items& items, Size size) {
  TreeSize mean{0, 0};
  for (const auto& item : items) {
    const TreeSize one = size(item);
    mean.nodes += one.nodes / static_cast<double>(items.size());
    mean.height += one.height / static_cast<double>(items.size());
  }
  return mean;
}

TreeSize size_of(const Hierarchy& hierarchy) {
  return {static_cast<double>(hierarchy.nodes.size()), static_cast<double>(height(hierarchy))};
}

TreeSize size_of(const Shape& shape) {
  TreeSize size = size_of(shape.hierarchy);
  for (const Shape& slab : shape.slabs) {
    const TreeSize part = size_of(slab.hierarchy);
    size = {size.nodes + part.nodes, std::max(size.height, part.height)};
  }
  return size;
}

TreeSize size_of(const baselines::ObbTree& tree) {
  return {static_cast<double>(tree.nodes.size()), static_cast<double>(tree.height)};
}

Hierarchy projected(const baselines::Body& body) {
  std::vector<Vec2> vertices;
  for (const Vec3& p : body.positions) vertices.push_back({p.x, p.y});
  return projected_hierarchy(vertices, body.triangles);
}

/// The segments of an outline as triangles without area, as trees of boxes take them.
std::vector<baselines::Facet> segments(const Outline& outline) {
  std::vector<baselines::Facet> facets;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto points = outline.contour(c);
    for (std::size_t i = 0, before = points.size() - 1; i < points.size(); before = i++) {
      const Eigen::Vector3f p(points[before].x, points[before].y, 0), q(points[i].x, points[i].y, 0);
      facets.push_back({p, q, q});
    }
  }
  return facets;
}

std::vector<baselines::Facet> flattened(std::vector<baselines::Facet> facets) {
  for (baselines::Facet& facet : facets)
    for (Eigen::Vector3f& p : facet) p.z() = 0;
  return facets;
}

std::vector<baselines::Facet> facets_of(std::string_view kind, const baselines::Body& body) {
  if (kind.starts_with("obb_contour")) return segments(body.shape.outline);
  auto triangles = baselines::triangle_facets(body.positions, body.triangles);
  return kind == "obb_projected" ? flattened(std::move(triangles)) : triangles;
}

}  // namespace

TreeSize tree_size(std::span<const Shape> shapes) {
  return mean_of(shapes, [](const Shape& shape) { return size_of(shape); });
}

TreeSize tree_size(const Contestant& contestant, std::span<const baselines::Body> bodies) {
  const std::string_view kind = contestant.kind;
  if (kind == "single" || kind == "fixed") return {1, 0};
  const auto own = [](const baselines::Body& body) { return size_of(body.shape); };
  if (contestant.centre) return mean_of(with_hierarchies(bodies, 0.01f, SplitRule::centre), own);
  if (kind == "reference") return mean_of(bodies, own);
  if (kind == "bch_projected")
    return mean_of(bodies, [](const baselines::Body& body) { return size_of(projected(body)); });
  if (kind.starts_with("obb_"))
    return mean_of(bodies, [&](const baselines::Body& body) {
      return size_of(baselines::build_obb_tree(facets_of(kind, body)));
    });
  return {};
}

}  // namespace bch::report
