// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include <type_traits>
#include <utility>

#include "baselines/built.hpp"
#include "baselines/fcl_models.hpp"
#include "baselines/kind_rows.hpp"

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
  bool in_space = false;  ///< not an outline

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
    const fcl::Transform3d here = fcl::Transform3d::Identity(),
                           there = fcl_transform(agents, pair, a.in_space);
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
std::unique_ptr<Structure> build_full(std::span<const Body> bodies, const BuildOptions&) {
  return build_models<FclModel<Volume>>(bodies, [](const Body& body) {
    return FclModel<Volume>{fcl_triangles<Volume>(body), true};
  });
}

template <class Volume, Upright upright>
std::unique_ptr<Structure> build_contour(std::span<const Body> bodies, const BuildOptions&) {
  return build_models<FclModel<Volume>>(bodies, [](const Body& body) {
    return FclModel<Volume>{fcl_outline<Volume>(body.shape.outline, upright)};
  });
}

constexpr Kind rows[] = {
    {"fcl_obb_full", "FCL: oriented boxes over the triangles", Truth::mesh, false, false,
     build_full<fcl::OBBd>},
    {"fcl_obbrss_full", "FCL: oriented boxes and swept spheres over the triangles", Truth::mesh, false, false,
     build_full<fcl::OBBRSSd>},
    {"fcl_obb_contour", "FCL: oriented boxes over the outline as walls", Truth::outline, false, false,
     build_contour<fcl::OBBd, Upright::wall>},
    {"fcl_obb_segments", "FCL: oriented boxes over one triangle a segment of the outline", Truth::outline,
     false, false, build_contour<fcl::OBBd, Upright::triangle>},
    {"fcl_obbrss_contour", "FCL: oriented boxes and swept spheres over the outline as walls", Truth::outline,
     false, false, build_contour<fcl::OBBRSSd, Upright::wall>},
};

}  // namespace

std::span<const Kind> fcl_kinds() {
  return rows;
}

}  // namespace bch::baselines
