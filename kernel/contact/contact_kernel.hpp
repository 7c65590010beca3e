// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>

#include <bch/query.hpp>

#include "kernel/simd/ancestor_test.hpp"
#include "kernel/simd/arguments.hpp"
#include "kernel/simd/disc_pairs.hpp"
#include "kernel/simd/relative_transforms.hpp"
#include "kernel/simd/segment_test.hpp"
#include "kernel/simd/tree_nodes.hpp"
#include "layout/base/rounding.hpp"
#include "layout/format/cut_discs.hpp"
#include "layout/format/shape_set_view.hpp"
#include "layout/simd/lanes.hpp"

namespace bch::detail {

/// Finds all contacts of two cuts. (A cut is the discs of a tree at a level of detail.) A contact is a disc
/// of each cut such that the two discs overlap, and each ancestor of either overlaps the other disc and all
/// of its ancestors. With exact leaves, segments of the two discs also touch. Handles one pair of agents
/// after the other.
///
/// Order. "Rows" are the discs of the pair's first agent, "columns" those of the second. A cut is stored as a flat
/// tree (layout/format/shape_set_view.hpp): its leaves are leaf blocks, each of eight consecutive discs, and the nodes
/// above are blocks. Row leaf blocks are visited from left to right. Each row leaf block is compared with those column
/// nodes that overlap the blocks above the row leaf block. So contacts are found in order, except among the eight rows
/// of a leaf block; those are counted first and then written to their positions.
///
/// Uniqueness. Leaf blocks may share discs with their neighbours, but no contact is reported twice. A row is tested in
/// the last leaf block that contains it: each row leaf block but the last is used only up to the first row of the next
/// leaf block. The last leaf block is used whole. It, too, has eight discs, so it may begin before the end of the leaf
/// block to its left; the rows that both contain are tested in the last leaf block. A column is tested in the first
/// visited leaf block that contains it.
///
/// Pruning and verification of hits are those of the kernel of collide().
template <class Simd>
class ContactKernel {
 public:
  static void count(const Arguments& in, std::size_t begin, std::size_t end, std::uint64_t* counts) noexcept {
    for_pairs(in, begin, end, [=](ContactKernel& kernel, std::size_t pair) {
      std::uint64_t sum = 0;
      kernel.for_row_leaf_blocks([&](std::uint32_t rows, std::uint64_t mask, const Nodes& columns) {
        kernel.for_column_leaf_blocks(rows, mask, columns, [&](std::uint32_t, std::uint64_t hits) {
          sum += static_cast<std::uint64_t>(__builtin_popcountll(hits));
        });
      });
      counts[pair] = sum;
    });
  }

  /// Writes the contacts of pairs from offsets[begin] on, and the end of each pair's contacts. It stops before the
  /// first pair that has more pairs of discs than there is room for contacts.
  /// Returns: one past the last pair that was answered.
  static std::size_t append(const Arguments& in, std::size_t begin, std::size_t end, std::uint64_t* offsets,
                            DiscPair* contacts, std::uint64_t capacity) noexcept {
    ContactKernel kernel(in);
    while (begin < end) {
      kernel.transforms_.compute(in, begin, end);
      for (std::uint32_t k = 0; k < kernel.transforms_.size; ++k, ++begin) {
        kernel.begin_pair(begin - k, k);
        if (capacity - offsets[begin] < std::uint64_t{kernel.rows_.count} * kernel.columns_.count)
          return begin;
        const DiscPair* const last = kernel.write_all(contacts + offsets[begin]);
        offsets[begin + 1] = static_cast<std::uint64_t>(last - contacts);
      }
    }
    return end;
  }

  static void fill(const Arguments& in, std::size_t begin, std::size_t end, const std::uint64_t* offsets,
                   DiscPair* contacts) noexcept {
    for_pairs(in, begin, end, [=](ContactKernel& kernel, std::size_t pair) {
      if (offsets[pair + 1] != offsets[pair]) kernel.write_all(contacts + offsets[pair]);
    });
  }

 private:
  /// Holds column nodes, from left to right.
  struct Nodes {
    static constexpr std::uint32_t capacity = 32;
    std::uint32_t size = 0;
    std::uint32_t node[capacity];
  };

  explicit ContactKernel(const Arguments& in) noexcept : in_(in), shapes_(*in.shapes) {}

  template <class Visit>
  static void for_pairs(const Arguments& in, std::size_t begin, std::size_t end, Visit visit) noexcept {
    ContactKernel kernel(in);
    for (; begin < end; begin += kernel.transforms_.size) {
      kernel.transforms_.compute(in, begin, end);
      for (std::uint32_t k = 0; k < kernel.transforms_.size; ++k) {
        kernel.begin_pair(begin, k);
        visit(kernel, begin + k);
      }
    }
  }

  /// Sets the current pair of agents. A is the agent with the lower index, see RelativeTransforms.
  void begin_pair(std::size_t begin, std::uint32_t k) noexcept {
    const Pair pair = in_.pairs[begin + k];
    swapped_ = pair.second < pair.first;
    placed_.b_in_a = transforms_.transform(k);
    const std::uint32_t rows = swapped_ ? transforms_.root_b[k] : transforms_.root_a[k];
    const std::uint32_t columns = swapped_ ? transforms_.root_a[k] : transforms_.root_b[k];
    if (shapes_.trees == nullptr) return begin_single_discs(shapes_.roots[rows], shapes_.roots[columns]);
    nodes_ = shapes_.nodes;
    const float max_extent_a = shapes_.max_extent[transforms_.shape_a[k]],
                max_extent_b = shapes_.max_extent[transforms_.shape_b[k]];
    max_extent_ = max_extent_a + max_extent_b;
    rows_ = shapes_.trees[rows], columns_ = shapes_.trees[columns];
    // The margin with which nodes enclose their discs suffices if the sum of both extents is at most conservative_ratio times
    // the lesser one: rounding.hpp, VIII.
    is_conservative_ = (rows_.conservative_nodes & columns_.conservative_nodes) != 0 &&
                       max_extent_ <= float{rounding::conservative_ratio} *
                                          (max_extent_a < max_extent_b ? max_extent_a : max_extent_b);
    const bool exact = in_.exact_leaves && rows_.segments != no_segments && columns_.segments != no_segments;
    placed_.margin =
        exact ? segment_margin<Simd>(shapes_, transforms_.shape_a[k], transforms_.shape_b[k]) : 0;
    first_row_ = rows_.discs, first_column_ = columns_.discs;
  }

  /// Sets the current pair for a set of single discs, which has no leaf blocks, by making two.
  void begin_single_discs(const Root& row_disc, const Root& column_disc) noexcept {
    for (DiscBlock& single : singles_)
      for (unsigned i = 0; i < block_width; ++i)
        single.x[i] = __builtin_inff(), single.y[i] = single.radius[i] = 0;
    singles_[0].x[0] = row_disc.x, singles_[0].y[0] = row_disc.y, singles_[0].radius[0] = row_disc.radius;
    singles_[1].x[0] = column_disc.x, singles_[1].y[0] = column_disc.y,
    singles_[1].radius[0] = column_disc.radius;
    nodes_ = singles_[0].x;
    first_row_ = 0, first_column_ = sizeof(DiscBlock) / sizeof(float);
    rows_ = {leaf_bit | first_row_, first_row_, block_width, 1, 0};
    columns_ = {leaf_bit | first_column_, first_column_, block_width, 1, 0};
  }

  /// Calls visit(leaf_block, mask of its own rows, nodes above the columns that may overlap them).
  template <class Visit>
  void for_row_leaf_blocks(Visit visit) const noexcept {
    Nodes columns;
    columns.node[columns.size++] = columns_.top;
    visit_rows(rows_.top, last_rows() + block_width, columns, visit);
    visit(last_rows() | leaf_bit, ~std::uint64_t{0}, columns);
  }

  /// Returns the index of the first of the last eight rows.
  std::uint32_t last_rows() const noexcept { return first_row_ + rows_.stride - block_width; }

  /// Visits the row leaf blocks below a node. `end`: the first row of the node to the right.
  template <class Visit>
  void visit_rows(std::uint32_t node, std::uint32_t end, const Nodes& columns, Visit& visit) const noexcept {
    if (node >= leaf_bit) {
      const std::uint32_t begin = node & ~leaf_bit;
      const std::uint32_t stop = end < last_rows() ? end : last_rows();
      if (begin < stop) visit(node, rows_below(stop - begin), columns);
      return;
    }
    std::uint64_t hits[Nodes::capacity];
    for (std::uint32_t k = 0; k < columns.size; ++k) hits[k] = overlaps_of(node, columns.node[k]);
    for (unsigned i = 0; i < block_width; ++i) {
      Nodes below;
      const bool fits = children_of_hits(columns, hits, i, below);
      if (below.size == 0) continue;
      const bool is_last = i + 1 == block_width || nodes_[node + i + 1] == __builtin_inff();
      const std::uint32_t child_end = is_last ? end : first_disc(nodes_, child(node, i + 1));
      // If the children do not fit, their parents cover the same columns.
      visit_rows(child(node, i), child_end, fits ? below : columns, visit);
    }
  }

  static std::uint64_t rows_below(std::uint32_t lanes) noexcept {
    return lanes < block_width ? (std::uint64_t{1} << (lanes * block_width)) - 1 : ~std::uint64_t{0};
  }

  /// Collects the children of the column nodes that disc i of a row block overlaps; a leaf block is its own
  /// child.
  /// Returns: whether there is room for all.
  bool children_of_hits(const Nodes& columns, const std::uint64_t* hits, unsigned i,
                        Nodes& below) const noexcept {
    for (std::uint32_t k = 0; k < columns.size; ++k) {
      std::uint64_t of_disc = hits[k] >> (i * block_width) & first_row_of_pairs;
      const bool is_leaf_block = columns.node[k] >= leaf_bit;
      if (is_leaf_block && of_disc != 0) of_disc = 1;
      for (; of_disc != 0; of_disc &= of_disc - 1) {
        if (below.size == Nodes::capacity) return false;
        const auto j = static_cast<unsigned>(__builtin_ctzll(of_disc));
        below.node[below.size++] = is_leaf_block ? columns.node[k] : child(columns.node[k], j);
      }
    }
    return true;
  }

  /// Calls visit(leaf_block, hits) for each leaf block of columns with discs that overlap those of a row leaf block.
  template <class Visit>
  void for_column_leaf_blocks(std::uint32_t rows, std::uint64_t mask, const Nodes& columns,
                              Visit visit) const noexcept {
    std::uint32_t next = 0;
    for (std::uint32_t k = 0; k < columns.size; ++k) visit_columns(rows, mask, columns.node[k], next, visit);
  }

  template <class Visit>
  void visit_columns(std::uint32_t rows, std::uint64_t mask, std::uint32_t node, std::uint32_t& next,
                     Visit& visit) const noexcept {
    std::uint64_t hits = overlaps_of(rows, node) & mask;
    if (node >= leaf_bit) {
      hits &= (first_row_of_pairs << visited_lanes(node, next) & first_row_of_pairs) * first_column_of_pairs;
      if (hits != 0) hits = verified(rows, node, hits);
      if (hits != 0) visit(node, hits);
      return;
    }
    for (unsigned j = 0; j < block_width; ++j)
      if (hits & first_column_of_pairs << j) visit_columns(rows, mask, child(node, j), next, visit);
  }

  /// Returns how many discs of a leaf block were in the leaf blocks visited before it, which ended before disc
  /// `next`. Advances `next` to the end of this leaf block.
  static std::uint32_t visited_lanes(std::uint32_t leaf_block, std::uint32_t& next) noexcept {
    const std::uint32_t done = next > leaf_block ? next - leaf_block : 0;
    next = leaf_block + block_width > next ? leaf_block + block_width : next;
    return done < block_width ? done : block_width;
  }

  /// Writes all contacts of a pair. Returns: one past the last.
  DiscPair* write_all(DiscPair* out) const noexcept {
    if ((rows_.top & columns_.top) >= leaf_bit) {
      std::uint64_t hits = verified(rows_.top, columns_.top, overlaps_of(rows_.top, columns_.top));
      for (; hits != 0; hits &= hits - 1) {
        const auto bit = static_cast<unsigned>(__builtin_ctzll(hits));
        *out++ = {bit / block_width, bit % block_width};
      }
      return out;
    }
    for_row_leaf_blocks([&](std::uint32_t rows, std::uint64_t mask, const Nodes& columns) {
      out = write_rows(rows, mask, columns, out);
    });
    return out;
  }

  /// Writes the contacts of a row leaf block with all column leaf blocks, row by row.
  /// Returns: one past the last.
  DiscPair* write_rows(std::uint32_t rows, std::uint64_t mask, const Nodes& columns,
                       DiscPair* out) const noexcept {
    constexpr std::uint32_t max_kept = 16;
    std::uint32_t count[block_width] = {}, leaf_blocks = 0, kept[max_kept];
    std::uint64_t kept_hits[max_kept];
    for_column_leaf_blocks(rows, mask, columns, [&](std::uint32_t leaf_block, std::uint64_t hits) {
      for (unsigned i = 0; i < block_width; ++i)
        count[i] +=
            static_cast<std::uint32_t>(__builtin_popcountll(hits >> (i * block_width) & first_row_of_pairs));
      if (leaf_blocks < max_kept) kept[leaf_blocks] = leaf_block, kept_hits[leaf_blocks] = hits;
      ++leaf_blocks;
    });
    DiscPair* end[block_width];
    for (unsigned i = 0; i < block_width; ++i) end[i] = out, out += count[i];
    const std::uint32_t first = (rows & ~leaf_bit) - first_row_;
    const auto place = [&](std::uint32_t leaf_block, std::uint64_t hits) {
      for (; hits != 0; hits &= hits - 1) {
        const auto bit = static_cast<unsigned>(__builtin_ctzll(hits));
        *end[bit / block_width]++ = {first + bit / block_width,
                                     (leaf_block & ~leaf_bit) - first_column_ + bit % block_width};
      }
    };
    if (leaf_blocks > max_kept)
      for_column_leaf_blocks(rows, mask, columns, place);
    else
      for (std::uint32_t k = 0; k < leaf_blocks; ++k) place(kept[k], kept_hits[k]);
    return out;
  }

  /// Returns which discs of two nodes overlap: bit 8 i + j is set if disc i of the row node and disc j of the
  /// column node do.
  std::uint64_t overlaps_of(std::uint32_t rows, std::uint32_t columns) const noexcept {
    const Discs of_rows = TreeNodes<Simd>::discs(nodes_, rows, rows_.stride),
                of_columns = TreeNodes<Simd>::discs(nodes_, columns, columns_.stride);
    if (!swapped_) return overlapping_discs<Simd>(placed_.b_in_a, of_rows, of_columns);
    return transposed(overlapping_discs<Simd>(placed_.b_in_a, of_columns, of_rows));
  }

  /// Returns those hits of two leaf blocks whose ancestors all overlap and, with exact leaves, whose segments meet.
  /// Ancestors need no test in two cases: single discs have none, and conservative nodes (is_conservative_) overlap
  /// wherever discs below them do.
  std::uint64_t verified(std::uint32_t rows, std::uint32_t columns, std::uint64_t hits) const noexcept {
    if (shapes_.trees == nullptr) return hits;
    if (is_conservative_ && placed_.margin == 0) return hits;
    std::uint64_t verified = 0;
    for (; hits != 0; hits &= hits - 1) {
      const auto bit = static_cast<unsigned>(__builtin_ctzll(hits));
      const std::uint32_t row = (rows & ~leaf_bit) + bit / block_width,
                          column = (columns & ~leaf_bit) + bit % block_width;
      const bool passes =
          swapped_ ? is_hit(columns_, column, rows_, row) : is_hit(rows_, row, columns_, column);
      verified |= std::uint64_t{passes} << bit;
    }
    return verified;
  }

  bool segments_meet(const Tree& a, std::uint32_t disc_a, const Tree& b,
                     std::uint32_t disc_b) const noexcept {
    bool meet = false;
    const auto on_meeting = [&](std::uint32_t, Meeting meeting) { meet |= meeting != Meeting::none; };
    SegmentTest<Simd> test(shapes_, &placed_);
    test.add(0, test.row(a, disc_a), 0, test.row(b, disc_b), 0, 0, on_meeting);
    test.finish(on_meeting);
    return meet;
  }

  bool is_hit(const Tree& a, std::uint32_t disc_a, const Tree& b, std::uint32_t disc_b) const noexcept {
    if (placed_.margin > 0 && !segments_meet(a, disc_a, b, disc_b)) return false;
    AncestorPath<Simd> ancestors_a, ancestors_b;
    ancestors_a.begin(nodes_, a, disc_a), ancestors_b.begin(nodes_, b, disc_b);
    for (std::uint32_t k = 1; k < AncestorPath<Simd>::length; ++k)
      ancestors_a.step(nodes_, k), ancestors_b.step(nodes_, k);
    return AncestorTest<Simd>(nodes_, {placed_.b_in_a, a, b, max_extent_}, disc_a, disc_b, ancestors_a,
                              ancestors_b)
        .passes();
  }

  std::uint32_t child(std::uint32_t node, unsigned lane) const noexcept {
    return TreeNodes<Simd>::child(nodes_, node, lane);
  }

  /// Transposes a matrix of 8 x 8 bits. Source: Warren, Hacker's Delight, 7-3.
  static std::uint64_t transposed(std::uint64_t m) noexcept {
    const auto exchange = [&m](std::uint64_t bits, unsigned shift) {
      const std::uint64_t both = (m ^ m >> shift) & bits;
      m ^= both ^ both << shift;
    };
    exchange(0x00aa00aa00aa00aa, 7);
    exchange(0x0000cccc0000cccc, 14);
    exchange(0x00000000f0f0f0f0, 28);
    return m;
  }

  const Arguments& in_;
  const ShapeSetView shapes_;
  RelativeTransforms<Simd> transforms_;

  // State of the current pair.
  bool swapped_;           ///< the first agent is B
  PlacedSegments placed_;  ///< a margin of 0: discs decide
  float max_extent_;       ///< of both shapes
  bool is_conservative_;   ///< Tree::conservative_nodes of both, and similar extents
  const float* nodes_;
  Tree rows_, columns_;
  std::uint32_t first_row_, first_column_;  ///< where their discs begin
  DiscBlock singles_[2];
};

}  // namespace bch::detail
