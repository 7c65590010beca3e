// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/simd/disc_pairs.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/shape_set_view.hpp"

namespace bch::detail {

/// Holds two trees, and how the second lies in the first one's frame.
struct PlacedTrees {
  const Transform& b_in_a;
  const Tree& a;
  const Tree& b;
  float max_extent;  ///< of the two shapes together
};

/// Holds the indices of the ancestors of a cut disc, from its parent to the root, sixteen at a time. If there are
/// fewer, the root fills the rest. (`Simd` gives each instruction set a function of its own, which the linker cannot
/// merge.)
template <class Simd>
struct AncestorPath {
  static constexpr std::uint32_t length = 16;
  std::uint32_t node[length];

  /// Begins the path above a cut disc, whose index in `nodes` is `disc`: sets its first node only.
  void begin(const float* nodes, const Tree& tree, std::uint32_t disc) noexcept {
    const std::uint32_t adjacent = tree.first_inner() + (disc - tree.discs);
    // Inner nodes are stored in-order: node k lies between discs k and k + 1. If the first child of node k is a cut
    // disc, that child is disc k, and the link of the node has the top bit, parent_of_cut_disc. Otherwise the link is less
    // than parent_of_cut_disc, and disc k is the second child of node k - 1.
    node[0] = adjacent - (link(nodes, adjacent) < parent_of_cut_disc);
  }
  /// Sets node k, the parent of node k - 1.
  void step(const float* nodes, std::uint32_t k) noexcept { node[k] = parent(nodes, node[k - 1]); }

  void go_up(const float* nodes) noexcept {
    node[0] = parent(nodes, node[length - 1]);
    for (std::uint32_t k = 1; k < length; ++k) step(nodes, k);
  }
  bool ends_at_root(const float* nodes) const noexcept {
    return parent(nodes, node[length - 1]) == node[length - 1];
  }

 private:
  static std::uint32_t link(const float* nodes, std::uint32_t inner) noexcept {
    std::uint32_t bits;
    __builtin_memcpy(&bits, nodes + std::size_t{inner} * inner_floats + 3, sizeof bits);
    return bits;
  }
  static std::uint32_t parent(const float* nodes, std::uint32_t inner) noexcept {
    return link(nodes, inner) & ~parent_of_cut_disc;
  }
};

/// Tests whether two overlapping cut discs are a hit. They are if each disc overlaps all ancestors of the other, and
/// all ancestors of one overlap all ancestors of the other; see <bch/query.hpp>.
template <class Simd>
class AncestorTest {
 public:
  /// Takes two discs by their places among `nodes`; `ancestors_a` and `ancestors_b` are their paths.
  AncestorTest(const float* nodes, const PlacedTrees& trees, std::uint32_t disc_a, std::uint32_t disc_b,
               const AncestorPath<Simd>& ancestors_a, const AncestorPath<Simd>& ancestors_b) noexcept
      : nodes_(nodes), trees_(trees), ancestors_a_(ancestors_a), ancestors_b_(ancestors_b) {
    a_ = disc(trees.a, disc_a);
    const Disc b = disc(trees.b, disc_b);
    const auto [x, y] = trees.b_in_a.apply(b.x, b.y);
    b_ = {x, y, b.radius};
    load(ancestors_a, discs_a_), load(ancestors_b, discs_b_);
  }

  bool passes() noexcept {
    const auto [overlap, common_point] = compare_with_leaves();
    if (!overlap) return false;
    if (!ancestors_a_.ends_at_root(nodes_) || !ancestors_b_.ends_at_root(nodes_)) return paths_overlap();
    return common_point || loaded_overlap();
  }

 private:
  using Float = typename Simd::Float;
  static constexpr std::uint32_t length = AncestorPath<Simd>::length;
  /// The least depth, in units of the sum of extents, at which a point inside all discs proves overlaps. If a point
  /// lies that deep in every disc of both paths, each disc of A overlaps each disc of B by at least twice the depth.
  /// Twice the depth covers the rounding. Three computations round: contains_point() for the disc of A,
  /// contains_point() for the disc of B, and the test of the two discs. All three start from the same floats. Each
  /// rounds one difference of centres, its square, and radii. All these lengths are at most the sum of extents.
  static constexpr double inside_margin = 16 * rounding::unit_roundoff;
  static_assert(2 * inside_margin >=
                3 * (rounding::terms::apart + rounding::terms::square + rounding::terms::radii) *
                    rounding::unit_roundoff);

  struct PathDiscs {
    alignas(64) float field[3][length];

    Discs eight(std::uint32_t first) const noexcept { return {field[0] + first, length, 2 * length}; }
  };

  struct Comparison {
    bool overlap;       ///< each of the two cut discs overlaps all loaded nodes of the other's path
    bool common_point;  ///< a point is inside all loaded discs of both paths
  };

  Disc disc(const Tree& tree, std::uint32_t place) const noexcept {
    const float* const x = nodes_ + place;
    return {x[0], x[tree.stride], x[2 * std::size_t{tree.stride}]};
  }

  [[gnu::always_inline]] void load(const AncestorPath<Simd>& path, PathDiscs& discs) const noexcept {
    for (std::uint32_t k = 0; k < length; k += Simd::width) {
      Float field[4];
      Simd::template load_records<inner_floats>(nodes_, path.node + k, field);
      for (std::uint32_t i = 0; i < 3; ++i) Simd::store(discs.field[i] + k, field[i]);
    }
  }

  /// Decides most cases, with one test per node. The point divides the line between the centres of the cut discs in
  /// the ratio of their radii, so that it lies in both.
  Comparison compare_with_leaves() const noexcept {
    const auto b_in_a = trees_.b_in_a.template in_lanes<Float>();
    const float fraction = a_.radius / (a_.radius + b_.radius);
    const Float x(a_.x + fraction * (b_.x - a_.x)), y(a_.y + fraction * (b_.y - a_.y));
    const Float margin(static_cast<float>(inside_margin) * trees_.max_extent), zero(0.0f);
    const auto contains_point = [&](Float at_x, Float at_y, Float r) {
      const Float dx = x - at_x, dy = y - at_y, inside = r - margin;
      return Simd::bits(dx * dx + dy * dy <= inside * inside) & Simd::bits(inside >= zero);
    };
    std::uint32_t overlap = ~std::uint32_t{0}, common_point = ~std::uint32_t{0};
    for (std::uint32_t k = 0; k < length; k += Simd::width) {
      const Float ax = Simd::load(discs_a_.field[0] + k), ay = Simd::load(discs_a_.field[1] + k),
                  ar = Simd::load(discs_a_.field[2] + k);
      const auto [bx, by] =
          b_in_a.apply(Simd::load(discs_b_.field[0] + k), Simd::load(discs_b_.field[1] + k));
      const Float br = Simd::load(discs_b_.field[2] + k);
      overlap &= overlaps<Simd>(Float(b_.x), Float(b_.y), Float(b_.radius), ax, ay, ar) &
                 overlaps<Simd>(bx, by, br, Float(a_.x), Float(a_.y), Float(a_.radius));
      common_point &= contains_point(ax, ay, ar) & contains_point(bx, by, br);
    }
    constexpr std::uint32_t all = (std::uint32_t{1} << Simd::width) - 1;
    return {overlap == all, common_point == all};
  }

  /// Tests all nodes of one path with all nodes of the other and with its cut disc, sixteen by sixteen up to the
  /// roots.
  bool paths_overlap() noexcept {
    for (AncestorPath<Simd> a = ancestors_a_;; a.go_up(nodes_)) {
      load(a, discs_a_);
      for (AncestorPath<Simd> b = ancestors_b_;; b.go_up(nodes_)) {
        load(b, discs_b_);
        if (!compare_with_leaves().overlap || !loaded_overlap()) return false;
        if (b.ends_at_root(nodes_)) break;
      }
      if (a.ends_at_root(nodes_)) return true;
    }
  }

  bool loaded_overlap() const noexcept {
    for (std::uint32_t i = 0; i < length; i += block_width)
      for (std::uint32_t j = 0; j < length; j += block_width)
        if (~overlapping_discs<Simd>(trees_.b_in_a, discs_a_.eight(i), discs_b_.eight(j)) != 0) return false;
    return true;
  }

  const float* const nodes_;
  const PlacedTrees& trees_;
  Disc a_, b_;  ///< the cut discs, in A's frame
  const AncestorPath<Simd>&ancestors_a_, &ancestors_b_;
  PathDiscs discs_a_, discs_b_;
};

}  // namespace bch::detail
