// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include <type_traits>
#include <utility>

#include "baselines/built.hpp"
#include "baselines/kind_rows.hpp"
#include "baselines/obb_tree.hpp"
#include "baselines/placement.hpp"
#include "layout/rounding.hpp"

// The Flexible Collision Library's trees (J. Pan, S. Chitta, D. Manocha, "FCL: a general purpose library for
// collision and proximity queries", ICRA 2012), asked for a yes or no as collide() does by default: no
// contacts described, at most one found.

namespace bch::baselines {
namespace {

template <class Volume>
using Traversal =
    std::conditional_t<std::is_same_v<Volume, fcl::OBBd>, fcl::detail::MeshCollisionTraversalNodeOBB<double>,
                       fcl::detail::MeshCollisionTraversalNodeOBBRSS<double>>;

template <class Volume>
struct FclModel {
  std::shared_ptr<fcl::BVHModel<Volume>> mesh;

  std::size_t bytes() const {
    return static_cast<std::size_t>(mesh->getNumBVs()) * sizeof(fcl::BVNode<Volume>) +
           static_cast<std::size_t>(mesh->num_tris) * sizeof(fcl::Triangle) +
           static_cast<std::size_t>(mesh->num_vertices) * sizeof(fcl::Vector3d);
  }

  /// FCL has no maximum depth. Its counters are off unless one builds the traversal oneself, as collide()
  /// does inside.
  template <class Counts>
  static bool meet(const FclModel& a, const FclModel& b, const Agents& agents, Pair pair, std::uint32_t,
                   Counts counts) {
    const Placement at = placement(agents, pair);
    const fcl::Transform3d here = fcl::Transform3d::Identity();
    fcl::Transform3d there = here;
    there.linear() << at.cosine, -at.sine, 0, at.sine, at.cosine, 0, 0, 0, 1;
    there.translation() << at.x, at.y, 0;
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    if constexpr (std::is_same_v<Counts, NoCounts>) {
      fcl::collide(a.mesh.get(), here, b.mesh.get(), there, request, result);
    } else {
      Traversal<Volume> traversal;
      fcl::detail::initialize(traversal, *a.mesh, here, *b.mesh, there, request, result);
      traversal.enable_statistics = true;
      fcl::detail::collide(&traversal);
      counts.counts.nodes += static_cast<std::uint64_t>(traversal.num_bv_tests);
      counts.counts.leaves += static_cast<std::uint64_t>(traversal.num_leaf_tests);
    }
    return result.isCollision();
  }
};

template <class Volume>
FclModel<Volume> make_model(const std::vector<fcl::Vector3d>& vertices,
                            const std::vector<fcl::Triangle>& triangles) {
  if (triangles.empty()) throw std::invalid_argument("no triangles");
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!(vertices[i].norm() <= rounding::largest_reach))
      throw std::invalid_argument("vertex " + std::to_string(i) + ": (" + std::to_string(vertices[i].x()) +
                                  ", " + std::to_string(vertices[i].y()) + ", " +
                                  std::to_string(vertices[i].z()) + ")");
  auto mesh = std::make_shared<fcl::BVHModel<Volume>>();
  mesh->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  mesh->addSubModel(vertices, triangles);
  mesh->endModel();
  return {std::move(mesh)};
}

template <class Volume>
std::unique_ptr<Structure> build_full(std::span<const Body> bodies, const BuildOptions&) {
  return build_models<FclModel<Volume>>(bodies, [](const Body& body) {
    triangle_facets(body.positions, body.triangles);  // for its complaints
    std::vector<fcl::Vector3d> vertices;
    std::vector<fcl::Triangle> triangles;
    for (const Eigen::Vector3f& p : body.positions) vertices.push_back(p.cast<double>());
    for (const auto& [a, b, c] : body.triangles) triangles.emplace_back(a, b, c);
    return make_model<Volume>(vertices, triangles);
  });
}

/// Each segment becomes a wall of two triangles, 1 m high: walls meet exactly where segments do.
template <class Volume>
std::unique_ptr<Structure> build_contour(std::span<const Body> bodies, const BuildOptions&) {
  return build_models<FclModel<Volume>>(bodies, [](const Body& body) {
    const Outline& outline = body.shape.outline;
    validate(outline);
    std::vector<fcl::Vector3d> vertices;
    std::vector<fcl::Triangle> triangles;
    for (const Vec2& p : outline.points)
      for (const double z : {0.0, 1.0})
        vertices.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y), z);
    for (std::size_t c = 0; c < outline.contours(); ++c) {
      const std::size_t begin = outline.contour_begin[c], count = outline.contour(c).size();
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t from = 2 * (begin + i), to = 2 * (begin + (i + 1) % count);
        triangles.emplace_back(from, to, from + 1);
        triangles.emplace_back(to, to + 1, from + 1);
      }
    }
    return make_model<Volume>(vertices, triangles);
  });
}

constexpr Kind rows[] = {
    {"fcl_obb_full", "FCL: oriented boxes over the triangles", Truth::mesh, false, false,
     build_full<fcl::OBBd>},
    {"fcl_obbrss_full", "FCL: oriented boxes and swept spheres over the triangles", Truth::mesh, false, false,
     build_full<fcl::OBBRSSd>},
    {"fcl_obb_contour", "FCL: oriented boxes over the outline as walls", Truth::outline, false, false,
     build_contour<fcl::OBBd>},
    {"fcl_obbrss_contour", "FCL: oriented boxes and swept spheres over the outline as walls", Truth::outline,
     false, false, build_contour<fcl::OBBRSSd>},
};

}  // namespace

std::span<const Kind> fcl_kinds() {
  return rows;
}

}  // namespace bch::baselines
