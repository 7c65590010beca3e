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

/// Builds one hierarchy after the other and reuses its memory and theirs: once both have seen the largest,
/// nothing is allocated. Not for two threads at a time.
class HierarchyBuilder {
 public:
  HierarchyBuilder() = default;
  /// Uses a given implementation of the discs, which this processor has to support.
  explicit HierarchyBuilder(const BuildImplementation& implementation) : solver_(implementation) {}

  /// Sets the largest number of nodes of a hierarchy, 2^22 by default: more throw std::length_error.
  void limit_nodes(std::size_t most) noexcept { max_nodes_ = most; }

  /// Builds the hierarchy that contour_hierarchy() documents, without primitives. After an exception the
  /// hierarchy has no nodes. `deepest`: nodes at this depth are leaves; cuts down to there are the same.
  void contour(const Outline& outline, float threshold, SplitRule rule, Hierarchy& hierarchy,
               std::uint32_t deepest = all_depths);

  /// Makes the root of contour() alone, for an outline with these points on its convex hull and no others there
  /// that decide the disc around it or its reach. After an exception the hierarchy has no nodes.
  /// Errors:  throws std::invalid_argument on no points or a reach outside rounding.hpp's domain.
  void root(std::span<const Vec2> points, float grid_step, Hierarchy& hierarchy);

  /// Builds the hierarchy that projected_hierarchy() documents, without primitives. After an exception the
  /// hierarchy has no nodes.
  void projected(std::span<const Vec2> vertices, std::span<const std::array<std::uint32_t, 3>> triangles,
                 Hierarchy& hierarchy);

  /// Fills in the primitives of the hierarchy that contour() or projected() made last: this builder's last call.
  void add_primitives(Hierarchy& hierarchy) const;

 private:
  /// Represents a node still to be made: a range of the order. Its items are listed there, or, of a second child, in the scratch.
  struct PendingNode {
    std::uint32_t begin, end;
    std::uint32_t* list;
    std::uint32_t* scratch;  ///< room for a second side: behind the lists that wait, or the list's own
    std::uint32_t parent;
    std::uint32_t below;  ///< levels that may follow
    SplitMeasure measure;

    ItemList items() const { return {list, end - begin}; }
  };
  /// Holds what remains of a segment on its way down: the half from a node's centre to this end.
  struct Half {
    std::uint32_t node;
    std::uint32_t below;
    Vec2 end;
  };
  /// Represents a node of several items, whose disc is solved once the order of all items is final.
  struct Unsolved {
    std::uint32_t node;
    std::uint32_t begin, end;  ///< of the order
  };

  void begin(double reach, double margin, double threshold, std::size_t items);
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
  double sure_square_diagonal_ = 0;   ///< a node whose box has a shorter one is a leaf
  double longest_square_length_ = 0;  ///< of a segment that is not halved

  SplitItems items_;
  std::vector<std::uint32_t> order_, scratch_;
  std::vector<PendingNode> pending_;
  EvenHalves even_halves_;
  std::array<Half, 256> halves_;  ///< lengths span fewer binary orders of magnitude

  std::uint32_t node_count_ = 0;
  std::size_t max_nodes_ = std::size_t{1} << 22;
  std::vector<Hierarchy::Node> nodes_;
  std::vector<std::uint32_t>
      first_node_;  ///< per item of the order: a leaf that holds it, or of its pieces' nodes
  std::vector<Unsolved> unsolved_;

  /// The points of the gathered items, in order. A point that ends one item and begins the next is stored
  /// once.
  std::vector<Vec2> points_;
  std::uint32_t point_count_ = 0;
  std::vector<std::uint32_t> first_point_, last_point_;  ///< per gathered item
  std::vector<PointRange> sets_;
  std::vector<SolvedDisc> discs_;
  EnclosingDiscs solver_;
};

/// Throws std::invalid_argument on a reach outside rounding.hpp's domain.
void require_reach(double reach);
/// Throws std::invalid_argument unless the threshold is positive and finite.
void require_threshold(float threshold);

}  // namespace bch::detail
