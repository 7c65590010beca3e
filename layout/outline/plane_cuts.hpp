// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/geometry.hpp>

#include "layout/outline/grid_geometry.hpp"
#include "layout/outline/topology.hpp"

namespace bch::detail {

/// The way round which a triangle or a piece of one goes, seen from above; 0: it is seen edge-on, or nearly.
constexpr std::uint8_t counter_clockwise = 1, clockwise = 2;

/// Cuts the triangles of a pose into slabs by horizontal planes: slab j lies below plane j and above the one before.
///
/// A plane lies half a float step above the number that names it. So no vertex lies in it, and a point that two meshes
/// share lies in the same slab of both: inside it, or in the plane and then on cut edges of both. No case is degenerate.
///
/// A triangle that planes cut falls into pieces, convex polygons of up to five corners. Corners on planes are computed in double
/// from the edge's lower end to its upper one, the same for every triangle at the edge, and then rounded to the grid as
/// vertices are; see layout/base/rounding.hpp. On the grid a piece is the fan of triangles about its first corner.
class PlaneCuts {
 public:
  static constexpr std::uint32_t not_cut = 0x80000000;

  /// Represents a part of a piece's border that is no edge of the mesh: along a plane, or within a piece that is seen edge-on.
  struct Border {
    GridPoint a, b;
    std::uint32_t slab, node;
  };

  /// Cuts the pose in which vertex used[v] of the mesh is at positions[used[v]], and v at points[v] of a grid of `step`.
  /// Errors:  throws std::invalid_argument on a height that is not finite.
  void cut(const OutlineTopology& topology, std::span<const Vec3> positions,
           std::span<const GridPoint> points, double step, std::span<const float> planes);

  std::uint32_t slabs() const { return slabs_; }
  std::uint32_t slab(std::uint32_t vertex) const { return slab_[vertex]; }
  std::span<const std::uint32_t> cut_triangles() const { return cut_triangles_; }
  bool is_cut(std::uint32_t triangle) const { return first_node_[triangle] != not_cut; }
  /// Returns which way a cut triangle's piece in a slab goes round. Precondition: it has one there.
  std::uint8_t side(std::uint32_t triangle, std::uint32_t slab) const {
    return sides_[node(triangle, slab) - vertices_];
  }
  std::span<const Border> borders() const { return borders_; }
  Heights heights() const { return heights_; }  ///< of all vertices

  /// Returns the ends of an edge's piece in a slab, in the edge's direction. Precondition: it has one there.
  std::array<GridPoint, 2> piece(std::uint32_t a, std::uint32_t b, std::uint32_t slab) const;
  bool same_place(std::uint32_t v, std::uint32_t w) const {
    return points_[v] == points_[w] && z_[v] == z_[w];
  }

  // Which parts are connected: nodes are vertices and pieces.

  std::uint32_t node(std::uint32_t triangle, std::uint32_t slab) const {
    return first_node_[triangle] + slab;
  }
  void connect(std::uint32_t node, std::uint32_t other);
  std::size_t nodes() const { return above_.size(); }
  /// Returns the node that stands for all that are connected with one.
  std::uint32_t root(std::uint32_t node);

 private:
  void find_slabs(std::span<const float> planes);
  void cut_triangle(std::uint32_t triangle, const std::array<std::uint32_t, 3>& corners);
  void add_piece(std::span<const GridPoint> corners, std::span<const std::uint8_t> in_plane,
                 std::uint32_t slab, std::uint32_t node);
  GridPoint crossing(std::uint32_t v, std::uint32_t w, std::uint32_t plane) const;

  const std::uint32_t* used_ = nullptr;
  std::span<const Vec3> positions_;
  std::span<const GridPoint> points_;
  double steps_per_metre_ = 0;
  std::uint32_t slabs_ = 0, vertices_ = 0;
  Heights heights_;
  std::vector<float> z_;
  std::vector<double> plane_;
  std::vector<std::uint8_t> slab_;         ///< of each vertex
  std::vector<std::uint32_t> first_node_;  ///< of each triangle, less its lowest slab; or not_cut
  std::vector<std::uint32_t> cut_triangles_;
  std::vector<std::uint8_t> sides_;  ///< of each node that is a piece
  std::vector<Border> borders_;
  std::vector<std::uint32_t> above_;  ///< of each node: one that is connected with it, itself at last
};

}  // namespace bch::detail
