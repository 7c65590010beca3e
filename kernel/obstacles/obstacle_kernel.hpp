// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>

#include "kernel/obstacles/obstacle_arguments.hpp"
#include "kernel/obstacles/outline_segment.hpp"
#include "kernel/obstacles/shape_tree.hpp"
#include "kernel/simd/ancestor_test.hpp"
#include "kernel/simd/leaf_segments.hpp"
#include "kernel/simd/tree_nodes.hpp"
#include "layout/base/rounding.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Tests the tree of a body against segments of obstacles, in double; see LocalSegment. Eight discs at a time are compared with
/// a segment.
template <class Simd>
class ObstacleKernel {
 public:
  /// Returns whether a disc of the cut and all its ancestors touch the segments and, if exact leaves decide, the outline in
  /// that disc does.
  static bool touches(const ObstacleArguments& in) noexcept { return ObstacleKernel(in).meets_any(); }

  /// Finds the least gap between a disc of the cut (if exact leaves decide, the outline) and a segment. The search ends at one
  /// of at most `stop_below`. The segment that is nearest to the root comes first: few others improve on it.
  ///
  /// Gaps of discs bound those of outlines: some leaf holds the nearest point of an outline, and its radius was
  /// enlarged by the same grid steps as the margin of exact leaves, and by query_margin, which is more than that margin
  /// and what halving moves. So its gap is below that of the outline.
  static void find_gap(const ObstacleArguments& in, double stop_below, ObstacleGap& best) noexcept {
    ObstacleKernel(in).search_all(stop_below, best);
  }

 private:
  explicit ObstacleKernel(const ObstacleArguments& in) noexcept
      : in_(in),
        own_(*in.shapes, in.root),
        nodes_(own_.nodes),
        tree_(own_.tree),
        exact_(in.exact_leaves && tree_.segments != no_segments) {}

  bool meets_any() noexcept {
    if (in_.shapes->inscribed != nullptr && any_goes_in()) return true;
    const auto visit = [&](std::uint32_t node, OpenBlock& block) {
      block.lanes = touching(TreeNodes<Simd>::discs(nodes_, node, tree_.stride));
      if (node < leaf_bit) return false;
      for (; block.lanes != 0; block.lanes &= block.lanes - 1) {
        const std::uint32_t disc = (node & ~leaf_bit) + block.first();
        const Meeting meeting = exact_ ? outline_meets(disc) : Meeting::within_margin;
        if (meeting == Meeting::sure || (meeting == Meeting::within_margin && ancestors_touch(disc)))
          return true;
      }
      return false;
    };
    return own_.walk(visit, [](const OpenBlock& block) { return block.first(); });
  }

  void search_all(double stop_below, ObstacleGap& best) noexcept {
    std::uint32_t first = 0;
    double least = __builtin_inf();
    for (std::uint32_t i = 0; i < in_.count; ++i) {
      const double square = square_from_root(in_.segments[i]);
      if (square < least) least = square, first = i;
    }
    if (in_.count != 0) search(in_.segments[first], stop_below, best);
    for (std::uint32_t i = 0; i < in_.count && !may_stop(stop_below, best); ++i)
      if (i != first) search(in_.segments[i], stop_below, best);
  }

  using Double = typename Simd::Double;
  // What find_gap() relies on: a disc is enlarged by more than the outlines' margin and what halving moves.
  static_assert(rounding::query_margin >=
                rounding::segment_margin +
                    (rounding::terms::halving + 2 * rounding::terms::higher) * rounding::unit_roundoff);

  static Double square_distance(const LocalSegment& segment, Double x, Double y) noexcept {
    const Double along = segment.along(x, y), across = segment.across(x, y);
    const Double beyond =
        xsimd::max(xsimd::max(Double(segment.from) - along, along - Double(segment.to)), Double(0.0));
    return across * across + beyond * beyond;
  }

  /// Returns whether a segment leads from outside of the root disc, which contains the outline, into a disc inscribed in the
  /// largest contour: then it crosses that contour, which is a hit at every level.
  bool any_goes_in() const noexcept {
    const float* const inscribed = in_.shapes->inscribed[in_.root / in_.shapes->level_count].x;
    const Discs discs{inscribed, block_width, 2 * block_width};
    std::uint32_t inside = 0;
    for (std::uint32_t i = 0; i < in_.count; ++i) {
      const LocalSegment& segment = in_.segments[i];
      if (!begins_or_ends_outside(segment)) continue;
      for (unsigned k = 0; k < block_width; k += Simd::doubles) {
        const Double left = Simd::wide(discs.radius() + k) - Double(segment.slack);
        const Double square = square_distance(segment, Simd::wide(discs.x + k), Simd::wide(discs.y() + k));
        inside |= Simd::bits((Double(0.0) < left) & (square <= left * left));
      }
    }
    return inside != 0;
  }

  bool begins_or_ends_outside(const LocalSegment& segment) const noexcept {
    const Root& root = in_.shapes->roots[in_.root];
    const double x = double{root.x}, y = double{root.y}, limit = double{root.radius} + segment.slack;
    const double along = segment.along(x, y), across = segment.across(x, y);
    const double from = segment.from - along, to = segment.to - along;
    const double farther = from * from < to * to ? to : from;
    return farther * farther + across * across > limit * limit;
  }

  std::uint32_t touching(Discs discs) const noexcept {
    std::uint32_t bits = 0;
    for (unsigned k = 0; k < block_width; k += Simd::doubles) {
      const Double x = Simd::wide(discs.x + k), y = Simd::wide(discs.y() + k),
                   r = Simd::wide(discs.radius() + k);
      for (std::uint32_t i = 0; i < in_.count; ++i) {
        const Double limit = r + Double(in_.segments[i].slack);
        bits |= Simd::bits(square_distance(in_.segments[i], x, y) <= limit * limit) << k;
      }
    }
    return bits;
  }

  /// Returns whether all ancestors of a cut disc touch the segments. `disc` is its index in the nodes.
  bool ancestors_touch(std::uint32_t disc) const noexcept {
    if (tree_.count == 1) return true;
    AncestorPath<Simd> path;
    path.begin(nodes_, tree_, disc);
    for (std::uint32_t k = 1; k < AncestorPath<Simd>::length; ++k) path.step(nodes_, k);
    for (;; path.go_up(nodes_)) {
      for (std::uint32_t k = 0; k < AncestorPath<Simd>::length; ++k) {
        if (k != 0 && path.node[k] == path.node[k - 1]) return true;
        const float* const node = nodes_ + std::size_t{path.node[k]} * inner_floats;
        if (!any_touches(in_.segments, in_.count, double{node[0]}, double{node[1]}, double{node[2]}))
          return false;
      }
      if (path.ends_at_root(nodes_)) return true;
    }
  }

  double margin() const noexcept { return in_.shapes->segment_margin[in_.root / in_.shapes->level_count]; }

  Meeting outline_meets(std::uint32_t disc) const noexcept {
    const LeafSegments<Simd> leaves{in_.shapes->leaf_segments};
    const auto list = leaves.segments(tree_, disc);
    if (list.count == 0) return Meeting::within_margin;
    Meeting most = Meeting::none;
    for (std::uint32_t i = 0; i < list.count && most != Meeting::sure; ++i) {
      const Vec2* const point = in_.shapes->points + list.point(i);
      for (std::uint32_t k = 0; k < in_.count; ++k) {
        const Meeting meeting = OutlineSegment<Simd>(point, in_.segments[k]).meet(margin());
        most = meeting > most ? meeting : most;
      }
    }
    return most;
  }

  static bool may_stop(double stop_below, const ObstacleGap& best) noexcept {
    return best.segment != nullptr && best.gap <= stop_below;
  }

  double square_from_root(const LocalSegment& segment) const noexcept {
    const Root& root = in_.shapes->roots[in_.root];
    return segment.square_distance(double{root.x}, double{root.y});
  }

  /// Returns a limit: a disc whose bound is above it contains nothing as near as the best. Bounds are off by some 2^-50 of their
  /// terms.
  double limit_of(const LocalSegment& segment, const ObstacleGap& best) const noexcept {
    const Root& root = in_.shapes->roots[in_.root];
    const double size =
        double{tree_.outer_radius} + __builtin_fabs(double{root.x}) + __builtin_fabs(double{root.y});
    return best.gap + segment.slack + 0x1p-40 * (size + __builtin_fabs(best.gap));
  }

  /// Searches the tree, the disc with the least bound first.
  void search(const LocalSegment& segment, double stop_below, ObstacleGap& best) noexcept {
    double limit = limit_of(segment, best);
    const double within = double{tree_.outer_radius} + limit;
    if (within < 0 || square_from_root(segment) > within * within) return;
    const auto visit = [&](std::uint32_t node, OpenBlock& block) {
      if (node < leaf_bit) return open(segment, limit, block), false;
      if (take(segment, node, limit, best)) limit = limit_of(segment, best);
      return may_stop(stop_below, best);
    };
    own_.walk(visit, [&](const OpenBlock& block) { return least(block, limit); });
  }

  /// Sets the lanes of a block below which gaps may be within the limit, and their bounds. Mostly there is none, which squares
  /// show sooner.
  void open(const LocalSegment& segment, double limit, OpenBlock& block) const noexcept {
    const Discs discs = TreeNodes<Simd>::outer_discs(nodes_, block.node, tree_.stride);
    alignas(64) double square[block_width];
    block.lanes = near(segment, discs, limit, square);
    if (block.lanes == 0) return;
    for (unsigned k = 0; k < block_width; k += Simd::doubles)
      Simd::store(block.bound + k, gaps(segment, discs, k, square));
  }

  /// Returns the lanes of discs, without padding, whose gap from the segment may be within the limit, and writes the squared
  /// distances of all centres.
  static std::uint32_t near(const LocalSegment& segment, Discs discs, double limit, double* square) noexcept {
    std::uint32_t bits = 0;
    for (unsigned k = 0; k < block_width; k += Simd::doubles) {
      const Double each = square_distance(segment, Simd::wide(discs.x + k), Simd::wide(discs.y() + k)),
                   within = Simd::wide(discs.radius() + k) + Double(limit + segment.slack);
      Simd::store(square + k, each);
      bits |= Simd::bits((each <= within * within) & (Double(0.0) <= within)) << k;
    }
    return bits;
  }

  static Double gaps(const LocalSegment& segment, Discs discs, unsigned k, const double* square) noexcept {
    return xsimd::sqrt(Simd::load(square + k)) - (Simd::wide(discs.radius() + k) + Double(segment.slack));
  }

  /// Returns the lane with the least bound, or block_width if none is within the limit.
  static unsigned least(const OpenBlock& block, double limit) noexcept {
    unsigned found = block_width;
    double bound = __builtin_inf();
    for (std::uint32_t left = block.lanes; left != 0; left &= left - 1) {
      const auto lane = static_cast<unsigned>(__builtin_ctz(left));
      if (block.bound[lane] < bound) bound = block.bound[lane], found = lane;
    }
    return bound > limit ? block_width : found;
  }

  /// Improves `best` by the leaves of a leaf block. Returns: whether it did.
  bool take(const LocalSegment& segment, std::uint32_t node, double limit, ObstacleGap& best) const noexcept {
    const Discs discs = TreeNodes<Simd>::discs(nodes_, node, tree_.stride);
    alignas(64) double square[block_width], gap[block_width];
    std::uint32_t left = near(segment, discs, limit, square);
    if (left == 0) return false;
    for (unsigned k = 0; k < block_width; k += Simd::doubles)
      Simd::store(gap + k, gaps(segment, discs, k, square));
    const std::uint32_t first = node & ~leaf_bit;
    bool improved = false;
    for (; left != 0; left &= left - 1) {
      const auto lane = static_cast<unsigned>(__builtin_ctz(left));
      if (exact_)
        improved |= gap[lane] <= best.gap && take_outline(segment, first + lane, gap[lane], best);
      else
        improved |= best.improve({gap[lane], no_point, first + lane - tree_.discs, segment.number, &segment});
    }
    return improved;
  }

  /// Improves `best` by the segments in a leaf, `disc`, or by the disc if they are too many. Returns: whether it did.
  [[gnu::noinline]] bool take_outline(const LocalSegment& segment, std::uint32_t disc, double gap_of_disc,
                                      ObstacleGap& best) const noexcept {
    const auto list = LeafSegments<Simd>{in_.shapes->leaf_segments}.segments(tree_, disc);
    if (list.count == 0)
      return best.improve(
          {gap_of_disc < 0 ? 0 : gap_of_disc, no_point, disc - tree_.discs, segment.number, &segment});
    bool improved = false;
    for (std::uint32_t i = 0; i < list.count; ++i) {
      const std::uint32_t point = list.point(i);
      const OutlineSegment<Simd> outline(in_.shapes->points + point, segment);
      if (outline.is_off_line((best.gap + margin() + segment.slack) * (1 + 0x1p-40))) continue;
      improved |= best.improve({outline.gap(margin()), point, 0, segment.number, &segment});
    }
    return improved;
  }

  const ObstacleArguments& in_;
  const ShapeTree<Simd> own_;
  const float* const nodes_;
  const Tree& tree_;
  const bool exact_;  ///< segments of the outline decide at leaves that have them
};

}  // namespace bch::detail
