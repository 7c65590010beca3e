// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/hierarchy.hpp>

#include "layout/base/rounding.hpp"
#include "layout/format/cut_discs.hpp"
#include "layout/format/leaf_segments.hpp"
#include "layout/format/shape_checks.hpp"

namespace bch::detail::shape_checks {
namespace {

const Tree& tree(const ShapeArrays& a, const LevelNodes& level) {
  return a.trees[level.root];
}
bool is_leaf_block(const Tree& tree) {
  return tree.top >= leaf_bit;
}
float max_extent(const ShapeArrays& a, const LevelNodes& level) {
  return a.max_extent[level.root / a.depths.size()];
}
std::uint32_t name_of(const float* block, std::uint32_t lane) {
  return std::bit_cast<std::uint32_t>(block[block_names + lane]);
}

/// Requires those of one block's children that are blocks to be the next ones in breadth-first order.
/// Returns: where the one after those begins.
std::uint64_t require_children(const float* x, std::uint64_t block, std::uint64_t next,
                               NamedLeafBlocks& leaf_blocks) {
  std::uint32_t any_block = 0;
#pragma GCC unroll 1  // else GCC 12 unrolls it first, and then makes no vectors
  for (std::uint32_t i = 0; i < block_width; ++i) {
    const std::uint32_t name = name_of(x, i), disc = ~is_padding(x[i]);
    const std::uint32_t leaf_block = disc & static_cast<std::uint32_t>(static_cast<std::int32_t>(name) >> 31);
    any_block |= disc & ~name;
    const auto named = static_cast<std::int32_t>(name & leaf_block);
    const auto or_first = static_cast<std::int32_t>((name & leaf_block) | (~leaf_block & leaf_bit));
    leaf_blocks.least[i] = std::min(leaf_blocks.least[i], named);
    leaf_blocks.most[i] = std::max(leaf_blocks.most[i], or_first);
    leaf_blocks.count[i] -= leaf_block;
  }
  if ((any_block & top_bit) == 0) return next;
  for (std::uint32_t i = 0; i < block_width; ++i) {
    const std::uint32_t name = name_of(x, i);
    if (x[i] == infinity || name >= leaf_bit) continue;
    if (name != next) reject("nodes", block, "child " + std::to_string(name) + " is not the next block");
    next += block_floats;
  }
  return next;
}

/// Requires eight discs to begin with one, and nothing but padding to follow padding.
void require_padding_last(const float* x, std::uint64_t place) {
  std::uint32_t late = is_padding(x[0]);
  for (std::uint32_t i = 1; i < block_width; ++i) late |= is_padding(x[i - 1]) & ~is_padding(x[i]);
  if (late != 0) reject("nodes", place, "padding before a disc");
}

/// The smallest radius that discs of this extent have, by rounding.hpp, with room for how it is rounded.
float smallest_radius(float max_extent) {
  return static_cast<float>(24 * rounding::unit_roundoff) * max_extent;
}

constexpr const char* not_a_disc =
    "expected discs of finite numbers, no smaller than the rounding of the shape, found another";

/// Returns a word whose top bit is set, like that of beyond(), for a value that is not between two positive
/// numbers.
std::uint32_t outside(float value, float least, float most) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits - std::bit_cast<std::uint32_t>(least)) | (std::bit_cast<std::uint32_t>(most) - bits);
}

/// Requires eight discs, padding among them, to be numbers within their limits.
void require_eight_discs(const float* x, float least, std::uint64_t place) {
  std::uint32_t bad = 0;
#pragma GCC unroll 1
  for (std::uint32_t i = 0; i < block_width; ++i)
    bad |= (beyond(x[i], largest_length) | outside(x[2 * block_width + i], least, largest_length)) &
           ~is_padding(x[i]);
#pragma GCC unroll 1
  for (std::uint32_t i = 0; i < block_width; ++i)
    bad |= beyond(x[block_width + i], largest_length) | beyond(x[2 * block_width + i], largest_length);
  if ((bad & top_bit) != 0) reject("nodes", place, not_a_disc);
}

void require_inner_numbers(const ShapeArrays& a, const LevelNodes& level, float least) {
  const Tree& tree = a.trees[level.root];
  const std::size_t begin = std::size_t{tree.first_inner()} * inner_floats;
  std::uint32_t bad = 0;
  for (const float* x = a.nodes.data() + begin;
       x < a.nodes.data() + level.end - (tree.count > 1 ? inner_floats : 0); x += inner_floats)
    bad |= beyond(x[0], largest_length) | beyond(x[1], largest_length) | outside(x[2], least, largest_length);
  if ((bad & top_bit) != 0) reject("nodes", begin, not_a_disc);
}

}  // namespace

void order_of_levels(const ShapeArrays& a, LevelNodes& level) {
  const std::uint64_t first = tree(a, level).top & ~leaf_bit;
  if (first < level.begin)
    reject("trees", level.root, "begins at " + std::to_string(first) + ", in another tree");
}

void blocks(const ShapeArrays& a, LevelNodes& level) {
  const std::uint32_t top = tree(a, level).top;
  NamedLeafBlocks& leaf_blocks = level.leaf_blocks;
  std::fill_n(leaf_blocks.most, block_width, std::numeric_limits<std::int32_t>::min());
  level.discs = top & ~leaf_bit;
  if (is_leaf_block(tree(a, level))) {
    leaf_blocks.least[0] = leaf_blocks.most[0] = static_cast<std::int32_t>(top);
    leaf_blocks.count[0] = 1;
    return;
  }
  std::uint64_t next = level.discs + block_floats, level_end = next;
  for (std::uint64_t block = top, levels = 1; block < next; block += block_floats) {
    if (block == level_end) {
      level_end = next;
      // The leaf blocks below are a level, too.
      if (++levels == max_wide_levels) reject("nodes", block, "the tree has too many levels");
    }
    if (block + block_floats > a.nodes.size()) reject("nodes", block, "the block ends beyond the array");
    const float* x = a.nodes.data() + block;
    // first_disc() follows the first disc's name before padding is examined.
    if (x[0] == infinity) reject("nodes", block, "begins with padding");
    next = require_children(x, block, next, leaf_blocks);
  }
  level.discs = next;
}

void disc_extent(const ShapeArrays& a, LevelNodes& level) {
  const auto [top, discs, stride, count, outer, segments, points, conservative_nodes] = tree(a, level);
  const std::uint64_t after_discs = level.discs + 3 * std::uint64_t{stride};
  level.end =
      (after_discs + inner_floats - 1) / inner_floats * inner_floats + inner_floats * std::uint64_t{count};
  if (discs != level.discs || count < 1 || stride != std::max(count, block_width) ||
      level.end + block_floats > a.nodes.size())
    reject("trees", level.root, std::to_string(count) + " discs do not fit");
  if (conservative_nodes > 1)
    reject("trees", level.root,
           "expected conservative_nodes of 0 or 1, found " + std::to_string(conservative_nodes));
}

void leaf_blocks(const ShapeArrays& a, LevelNodes& level) {
  const NamedLeafBlocks& named = level.leaf_blocks;
  const std::int32_t least = *std::min_element(named.least, named.least + block_width);
  const std::int32_t most = *std::max_element(named.most, named.most + block_width);
  const std::uint64_t from = static_cast<std::uint32_t>(least) & ~leaf_bit,
                      to = static_cast<std::uint32_t>(most) & ~leaf_bit;
  if (from < level.discs || to + block_width > level.discs + tree(a, level).stride)
    reject(
        "trees", level.root,
        "leaf blocks at " + std::to_string(from) + " to " + std::to_string(to) + " are not among its discs");
}

void first_leaf_block(const ShapeArrays& a, LevelNodes& level) {
  if (first_disc(a.nodes.data(), tree(a, level).top) != level.discs)
    reject("trees", level.root, "the first leaf block is not at the first disc");
}

void number_of_leaf_blocks(const ShapeArrays& a, LevelNodes& level) {
  std::uint64_t count = 0;
  for (const std::uint32_t of_lane : level.leaf_blocks.count) count += of_lane;
  if (count > tree(a, level).stride)
    reject("trees", level.root,
           std::to_string(count) + " leaf blocks of " + std::to_string(tree(a, level).stride) + " discs");
}

void padding(const ShapeArrays& a, LevelNodes& level) {
  const float* nodes = a.nodes.data();
  if (!is_leaf_block(tree(a, level)))
    for (std::uint64_t block = tree(a, level).top; block < level.discs; block += block_floats)
      require_padding_last(nodes + block, block);
  const std::uint32_t count = tree(a, level).count;
  if (count > block_width) return;
  require_padding_last(nodes + level.discs, level.discs);
  if ((count < block_width && nodes[level.discs + count] != infinity) ||
      nodes[level.discs + count - 1] == infinity)
    reject("trees", level.root, "not " + std::to_string(count) + " discs");
}

void numbers(const ShapeArrays& a, LevelNodes& level) {
  const float* nodes = a.nodes.data();
  const float least = smallest_radius(max_extent(a, level));
  if (!is_leaf_block(tree(a, level)))
    for (std::uint64_t block = tree(a, level).top; block < level.discs; block += block_floats)
      require_eight_discs(nodes + block, least, block);
  require_inner_numbers(a, level, least);
  const std::uint32_t stride = tree(a, level).stride;
  if (stride == block_width) return require_eight_discs(nodes + level.discs, least, level.discs);
  const float *places = nodes + level.discs, *radius = places + 2 * std::size_t{stride};
  std::uint32_t bad = 0;
  for (std::size_t i = 0; i < 2 * std::size_t{stride}; ++i) bad |= beyond(places[i], largest_length);
  for (std::uint32_t i = 0; i < stride; ++i) bad |= outside(radius[i], least, largest_length);
  if ((bad & top_bit) != 0) reject("nodes", level.discs, not_a_disc);
}

void single_discs(const ShapeArrays& a, LevelNodes& level) {
  const float* x = a.nodes.data() + level.discs;
  const std::uint32_t stride = tree(a, level).stride;
  const Root& root = a.roots[level.root];
  if ((tree(a, level).count == 1) != (root.row == single_disc))
    reject("roots", level.root, "row " + std::to_string(root.row) + " is not that of its discs");
  if (root.row == single_disc &&
      !(root.x == x[0] && root.y == x[stride] && root.radius == x[2 * std::size_t{stride}]))
    reject("roots", level.root, "not its single disc");
}

void extent_of_level(const ShapeArrays& a, LevelNodes& level) {
  const Root& root = a.roots[level.root];
  constexpr float most =
      64;  // of what a shape extends to: hierarchies of one's own may say more than they have
  const float extent = std::abs(root.x) + std::abs(root.y) + root.radius;
  if (max_extent(a, level) > most * extent)
    reject("max_extent", level.root / a.depths.size(), "far beyond root " + std::to_string(level.root));
}

void segments_of_leaves(const ShapeArrays& a, LevelNodes& level) {
  const Tree& of = tree(a, level);
  const std::size_t shape = level.root / a.depths.size();
  const bool is_last_level = level.root % a.depths.size() == a.depths.size() - 1;
  const auto require = [&](bool good, const char* what) {
    if (!good) reject("leaf_segments", level.segments, "root " + std::to_string(level.root) + ": " + what);
  };
  if (of.segments != no_segments) {
    require(is_last_level && a.depths.back() == all_depths && of.count > 1, "not a level of exact leaves");
    require(of.segments == level.segments && of.segments + std::uint64_t{of.count} <= a.leaf_segments.size(),
            "no words of its leaves");
    const auto [first_contour, last_contour] = a.shape_contours[shape];
    require(first_contour < last_contour && of.points == a.contours[first_contour].begin,
            "not its shape's points");
    const std::uint64_t points = a.contours[last_contour - 1].end - of.points;
    const auto words = a.leaf_segments.subspan(of.segments);
    std::uint64_t named = 0, end = of.count;
    const auto name = [&](std::uint64_t first, std::uint64_t count) {
      require(first + count <= points, "a leaf names no segments of its shape");
      named += count;
    };
    for (const std::uint32_t word : words.first(of.count)) {
      if (word < leaf_list) {
        name(word & leaf_first_mask, word >> leaf_count_shift);
        continue;
      }
      require((word & ~leaf_list) == end && end < words.size() && words[end] < words.size() - end,
              "a list is not behind the one before");
      for (const std::uint32_t segment : words.subspan(end + 1, words[end])) name(segment, 1);
      require(words[end] > 0 && words[end] <= max_leaf_segments, "a list is too short or too long");
      end += 1 + words[end];
    }
    require(named <= points + of.count, "leaves name too many segments");
    level.segments = of.segments + end;
  }
  require(level.root + 1 < a.roots.size() || level.segments == a.leaf_segments.size(), "more follows");
}

}  // namespace bch::detail::shape_checks
