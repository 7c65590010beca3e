// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <bch/hierarchy.hpp>

#include "layout/enclosing_disc/enclosing_discs.hpp"
#include "layout/hierarchy/halves.hpp"
#include "layout/hierarchy/paper_hierarchies.hpp"
#include "layout/hierarchy/split.hpp"

namespace bch::detail {

/// Builds one hierarchy after the other, reusing its own memory and that of the hierarchies: nothing is allocated
/// once both have had the largest size. One thread at a time may use an object.
class HierarchyBuilder {
 public:
  HierarchyBuilder() = default;
  /// Uses a given implementation of the solver of smallest enclosing discs. This processor must support it.
  explicit HierarchyBuilder(const BuildImplementation& implementation) : solver_(implementation) {}

  /// Sets the largest number of nodes of a hierarchy, 2^22 by default. A hierarchy of more nodes throws
  /// std::length_error.
  void limit_nodes(std::size_t max) noexcept { max_nodes_ = max; }

  /// Builds the hierarchy that contour_hierarchy() documents, without primitives. `rule` says where a node's items
  /// are divided (split.hpp). Nodes at depth `deepest` are leaves; this does not change cuts at smaller depths. After
  /// an exception the hierarchy has no nodes.
  void contour(const Outline& outline, float threshold, SplitRule rule, Hierarchy& hierarchy,
               std::uint32_t deepest = all_depths);

  /// Makes only the root of contour(). Its extent and its disc depend on a few points of the outline, which lie on the
  /// convex hull. `points` has to contain all of these, and may contain others. After an exception the hierarchy has
  /// no nodes.
  /// Errors:  throws std::invalid_argument if there are no points or the extent is not within rounding::smallest_extent
  ///          .. largest_extent (1e-6 to 1e6 m).
  void root(std::span<const Vec2> points, float grid_step, Hierarchy& hierarchy);

  /// Builds the hierarchy of projected_hierarchy() (paper_hierarchies.hpp), over triangles seen from above, without
  /// primitives. After an exception the hierarchy has no nodes.
  void projected(std::span<const Vec2> vertices, std::span<const std::array<std::uint32_t, 3>> triangles,
                 Hierarchy& hierarchy);

  /// Fills in the primitives of the hierarchy that contour() or projected() made in the last call of this builder.
  void add_primitives(Hierarchy& hierarchy) const;

 private:
  /// Represents a node to be made. Its items (segments or triangles) will take the places begin .. end of order_.
  /// Until then `list` has their indices: in order_ itself or, for a second child, in scratch_.
  struct PendingNode {
    std::uint32_t begin, end;
    std::uint32_t* list;
    /// Where a split of the node writes its second side: in scratch_, or, if the node is a second child, over its own
    /// `list`.
    std::uint32_t* scratch;
    std::uint32_t parent;
    std::uint32_t below;  ///< the number of levels allowed below
    SplitMeasure measure;

    ItemList items() const { return {list, end - begin}; }
  };
  /// Holds the part of a halved segment that is still to be made: the half from the centre of `node` to `end`.
  struct Half {
    std::uint32_t node;
    std::uint32_t below;
    Vec2 end;
  };
  /// Represents a node of several items whose disc is computed once the order of all items is final.
  struct Unsolved {
    std::uint32_t node;
    std::uint32_t begin, end;  ///< places in order_
  };

  void begin(double max_extent, double margin, double threshold, std::size_t items);
  void grow(bool through_centre, std::uint32_t deepest);
  bool add_node(const PendingNode& pending);
  void add_lone_segment(std::uint32_t at, std::uint32_t below);
  void add_halves(Vec2 a, Vec2 b, std::uint32_t below);
  std::uint32_t add_node();
  void reserve(std::uint32_t nodes);
  void enlarge(std::uint32_t nodes);
  bool is_leaf(ItemList items, const SplitMeasure& box);
  void gather_points(ItemList items);
  void solve_discs();
  void solve(std::span<const Vec2> points);
  void publish(Hierarchy& hierarchy);
  void add_pieces(const Hierarchy::Primitive& piece, std::uint32_t source, std::uint32_t node,
                  Hierarchy& hierarchy) const;

  double margin_ = 0, threshold_ = 0;
  double sure_square_diagonal_ = 0;   ///< a node whose box has a shorter diagonal is surely a leaf
  double longest_square_length_ = 0;  ///< longer segments are halved

  SplitItems items_;
  std::vector<std::uint32_t> order_, scratch_;
  std::vector<PendingNode> pending_;
  EvenHalves even_halves_;
  std::array<Half, 256> halves_;  ///< one per halving; fewer than 256 make both ends equal

  std::uint32_t node_count_ = 0;
  std::size_t max_nodes_ = std::size_t{1} << 22;
  std::vector<Hierarchy::Node> nodes_;
  std::vector<std::uint32_t>
      first_node_;  ///< per item of the order: its leaf, or the first node of its pieces
  std::vector<Unsolved> unsolved_;

  /// The points of the gathered items, in order. If one item ends where the next begins, that point is stored once.
  std::vector<Vec2> points_;
  std::uint32_t point_count_ = 0;
  std::vector<std::uint32_t> first_point_, last_point_;  ///< per gathered item
  std::vector<PointRange> sets_;
  std::vector<SolvedDisc> discs_;
  EnclosingDiscs solver_;
};

/// Throws std::invalid_argument on an extent outside rounding.hpp's domain.
void require_extent(double max_extent);
/// Throws std::invalid_argument unless the threshold is positive and finite.
void require_threshold(float threshold);

}  // namespace bch::detail
