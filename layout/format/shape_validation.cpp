// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/format/shape_validation.hpp"

#include "layout/format/shape_checks.hpp"
#include "layout/format/shape_preconditions.hpp"

namespace bch::detail {
namespace {

using namespace shape_checks;

constexpr Precondition all[] = {
    {"alignment", "Every array begins on a cache line, because kernels load whole registers.", alignment,
     nullptr},
    {"depths", "There are 1 to 255 cut depths, and they ascend: agents name levels by a byte.", depths,
     nullptr},
    {"sizes", "Arrays are as long as the numbers of shapes and levels say, and 32 bits name their elements.",
     sizes, nullptr},
    {"heights", "A shape's bottom is a number that is not above its top.", heights, nullptr},
    {"rows",
     "Rows of supports are numbered in the order of the shapes; without trees all levels are single discs.",
     rows, nullptr},
    {"single depth", "The cut at depth 0 is a single disc; where there is no other depth there are no trees.",
     single_depth, nullptr},
    {"infinite rows", "The first rows of supports, which stand for none, are infinite.", infinite_rows,
     nullptr},
    {"extents", "Extents are within the library's domain.", max_extents, nullptr},
    {"roots", "Root discs are numbers of at most 1e7 m with a radius above 0.", roots, nullptr},
    {"supports", "Supports are numbers of at most 1e7 m.", supports, nullptr},
    {"inscribed discs", "Inscribed discs are such numbers, or padding.", inscribed, nullptr},
    {"profiles", "Profiles are such numbers, or minus infinity where nothing is known.", profiles, nullptr},
    {"shape contours", "Shapes' contours lie one behind the other and are all contours.", shape_contours,
     nullptr},
    {"contours",
     "Contours' points, each with the first one again at its end, lie one behind the other and are all "
     "points; no contour "
     "is empty.",
     contour_points, nullptr},
    {"points", "Points are numbers of at most 1e7 m.", points, nullptr},
    {"segment margins", "Segment margins are numbers from 0 to 1e7 m.", segment_margins, nullptr},
    {"contour discs",
     "A contour's disc is about its points and as large as its farthest point asks: else containment "
     "looks into contours that cannot hold each other.",
     contour_discs, nullptr},
    {"order of levels", "Levels' nodes lie one behind the other, so that checking them takes one pass.",
     nullptr, order_of_levels},
    {"blocks",
     "Blocks are a tree in breadth-first order, within the array, with fewer than max_wide_levels levels, "
     "and none begins with padding: kernels' stacks have that size.",
     nullptr, blocks},
    {"room", "A level has eight discs or more, with padding, and a block's room follows them.", nullptr,
     disc_extent},
    {"leaf blocks", "Leaf blocks lie among their level's discs.", nullptr, leaf_blocks},
    {"first leaf block",
     "First child after first child leads to the level's first disc, from which others are numbered.",
     nullptr, first_leaf_block},
    {"number of leaf blocks",
     "A level has no more leaf blocks than discs, which bounds the steps that a pair takes.", nullptr,
     number_of_leaf_blocks},
    {"padding", "Padding follows discs: in blocks, and where a level has fewer than eight.", nullptr,
     padding},
    {"numbers",
     "Discs are numbers of at most 1e7 m, and no radius is smaller than what rounding.hpp adds to each.",
     nullptr, numbers},
    {"single discs", "A level is marked as a single disc where it is one, and then that is its root.",
     nullptr, single_discs},
    {"extent of a level",
     "No extent is far beyond the root discs: what only bounds an answer has a slack in proportion.", nullptr,
     extent_of_level},
    {"inner nodes",
     "Links of inner nodes make a tree, which every way up leaves at the root disc; no node is larger than "
     "its children "
     "need, else nothing is pruned.",
     nullptr, inner_nodes},
    {"nodes of blocks",
     "A block's discs are those of the nodes that it names, which are above the discs below.", nullptr,
     nodes_of_blocks},
    {"segments of leaves",
     "Leaves name segments of their shape's contours, no more of all than it has points and discs, at the "
     "level of all depths "
     "alone; what they name lies one behind the other.",
     nullptr, segments_of_leaves},
    {"outer radii", "An outer radius exceeds a disc's by no more than cut discs can stick out of it.",
     nullptr, outer_radii},
};

}  // namespace

std::span<const Precondition> shape_preconditions() noexcept {
  return all;
}

void validate(const ShapeArrays& arrays, const std::function<void(std::size_t)>& before_nodes) {
  for (const Precondition& each : all)
    if (each.check_set != nullptr) each.check_set(arrays);
  LevelNodes level{};
  for (std::size_t root = 0; root < arrays.trees.size(); ++root) {
    if (before_nodes) before_nodes(arrays.trees[root].top & ~leaf_bit);
    level.root = root, level.begin = level.end, level.leaf_blocks = {};
    for (const Precondition& each : all)
      if (each.check_level != nullptr) each.check_level(arrays, level);
  }
}

}  // namespace bch::detail
