// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <fcl/geometry/bvh/BVH_model.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <bch/outline.hpp>

#include "baselines/obb_tree.hpp"
#include "baselines/placement.hpp"
#include "baselines/structure.hpp"
#include "layout/base/rounding.hpp"
#include "layout/character/eigen.hpp"

// What all queries of the Flexible Collision Library are asked about.

namespace bch::baselines {

/// Returns the placement of the second agent, seen from the one with the lower index; on one ground with it, or in space.
inline fcl::Transform3d fcl_transform(const Agents& agents, Pair pair, bool in_space) {
  const Placement at = in_space ? placement_in_space(agents, pair) : placement(agents, pair);
  fcl::Transform3d there = fcl::Transform3d::Identity();
  there.linear() << at.cosine, -at.sine, 0, at.sine, at.cosine, 0, 0, 0, 1;
  there.translation() << at.x, at.y, at.z;
  return there;
}

template <class Volume>
std::shared_ptr<fcl::BVHModel<Volume>> fcl_mesh(const std::vector<fcl::Vector3d>& vertices,
                                                const std::vector<fcl::Triangle>& triangles) {
  if (triangles.empty()) throw std::invalid_argument("no triangles");
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!(vertices[i].norm() <= detail::rounding::largest_extent))
      throw std::invalid_argument("vertex " + std::to_string(i) + ": (" + std::to_string(vertices[i].x()) +
                                  ", " + std::to_string(vertices[i].y()) + ", " +
                                  std::to_string(vertices[i].z()) + ")");
  auto mesh = std::make_shared<fcl::BVHModel<Volume>>();
  mesh->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  mesh->addSubModel(vertices, triangles);
  mesh->endModel();
  return mesh;
}

/// Holds a body's triangles in space.
template <class Volume>
std::shared_ptr<fcl::BVHModel<Volume>> fcl_triangles(const Body& body) {
  triangle_facets(body.positions, body.triangles);  // for its complaints
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (const Vec3& p : body.positions) vertices.push_back(detail::to_eigen(p).cast<double>());
  for (const auto& [a, b, c] : body.triangles) triangles.emplace_back(a, b, c);
  return fcl_mesh<Volume>(vertices, triangles);
}

/// Selects what stands on each segment, 1 m high. Both meet exactly where segments do, and are as far apart.
enum class Upright {
  wall,      ///< two triangles
  triangle,  ///< half of the wall, which is enough
};

template <class Volume>
std::shared_ptr<fcl::BVHModel<Volume>> fcl_outline(const Outline& outline, Upright upright) {
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
      if (upright == Upright::wall) triangles.emplace_back(to, to + 1, from + 1);
    }
  }
  return fcl_mesh<Volume>(vertices, triangles);
}

}  // namespace bch::baselines
