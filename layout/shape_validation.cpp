// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_validation.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/rounding.hpp"

namespace bch {
namespace {

/// Of coordinates, radii and supports, metres: a few reaches, as pruning discs and supports stick out.
constexpr float largest_length = 1e7f;
/// Of lengths' squares.
constexpr float largest_square = 1e14f;
constexpr float infinity = std::numeric_limits<float>::infinity();

[[noreturn]] void reject(const char* array, std::size_t place, const std::string& what) {
  throw std::invalid_argument(std::string(array) + " " + std::to_string(place) + ": " + what);
}

void require_size(const char* array, std::uint64_t size, std::uint64_t expected) {
  if (size != expected)
    throw std::invalid_argument(std::string(array) + ": " + std::to_string(size) +
                                " where there have to be " + std::to_string(expected));
}

/// Integers, so that loops over many become vectors: a float below a positive limit, by magnitude or with its sign.
std::uint32_t beyond(float value, float limit) {
  return (std::bit_cast<std::uint32_t>(value) & 0x7fffffff) > std::bit_cast<std::uint32_t>(limit);
}
std::uint32_t negative_or_beyond(float value, float limit) {
  return std::bit_cast<std::uint32_t>(value) > std::bit_cast<std::uint32_t>(limit);
}

bool is_length(float value) {
  return beyond(value, largest_length) == 0;
}
bool is_radius(float value) {
  return negative_or_beyond(value, largest_length) == 0;
}

/// Calls `good` for each, and names the first that is not. Returns so soon only where all are.
template <class Record, class Good>
void require_all(const char* array, std::span<const Record> records, const char* what, Good good) {
  bool all = true;
  for (const Record& record : records) all &= good(record);
  if (all) return;
  const auto found =
      std::find_if(records.begin(), records.end(), [&](const Record& record) { return !good(record); });
  reject(array, static_cast<std::size_t>(found - records.begin()), what);
}

void require_lengths(const char* array, std::span<const float> values) {
  std::uint32_t bad = 0;
  for (const float value : values) bad |= beyond(value, largest_length);
  if (bad == 0) return;
  require_all(array, values, "not a length", is_length);
}

/// Eight or more discs, x, y and radius each in a run of its own. A disc at infinity is padding.
void require_discs(const char* array, std::size_t place, const float* x, std::size_t count,
                   std::size_t stride) {
  const float *y = x + stride, *radius = x + 2 * stride;
  std::uint32_t bad = 0;
  for (std::size_t i = 0; i < count; ++i)
    bad |= beyond(x[i], largest_length) & static_cast<std::uint32_t>(x[i] != infinity);
  for (std::size_t i = 0; i < count; ++i) bad |= beyond(y[i], largest_length);
  for (std::size_t i = 0; i < count; ++i) bad |= negative_or_beyond(radius[i], largest_length);
  if (bad != 0) reject(array, place, "holds a disc that is none");
}

void require_sizes(const ShapeArrays& a) {
  if (a.depths.empty() || a.depths.size() > 255)
    throw std::invalid_argument("depths: " + std::to_string(a.depths.size()) + ", not 1 to 255");
  for (std::size_t i = 1; i < a.depths.size(); ++i)
    if (a.depths[i] <= a.depths[i - 1]) reject("depths", i, std::to_string(a.depths[i]) + " does not ascend");
  const std::uint64_t shapes = a.reach.size(), roots = shapes * a.depths.size();
  if (shapes > std::numeric_limits<std::uint32_t>::max() || roots > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("reach: " + std::to_string(shapes) + ", too many shapes");
  require_size("roots", a.roots.size(), roots);
  const bool roots_only = a.trees.empty(), shortcuts = !a.support.empty();
  require_size("trees", a.trees.size(), roots_only ? 0 : roots);
  if (roots_only) require_size("nodes", a.nodes.size(), 0);
  if (a.nodes.size() >= leaf_window)
    throw std::invalid_argument("nodes: " + std::to_string(a.nodes.size()) + ", not below 2^31");
  if (roots_only) require_size("support", a.support.size(), 0);
  if (shortcuts) require_size("support", a.support.size(), roots * support_stride);
  require_size("inscribed", a.inscribed.size(), shortcuts ? shapes : 0);
  require_size("extremes", a.extremes.size(), shortcuts ? shapes : 0);
  require_size("enclosures", a.enclosures.size(), shortcuts ? shapes : 0);
}

void require_roots(const ShapeArrays& a) {
  require_all("reach", a.reach, "outside the domain", [](float reach) {
    return static_cast<double>(reach) >= rounding::smallest_reach &&
           static_cast<double>(reach) <= rounding::largest_reach;
  });
  require_all("roots", a.roots, "no disc", [](const Root& root) {
    return is_length(root.x) & is_length(root.y) & is_radius(root.radius) & (root.is_single <= 1);
  });
  if (!a.trees.empty()) return;
  require_all("roots", a.roots, "not single, without a tree",
              [](const Root& root) { return root.is_single == 1; });
}

/// What the blocks of a level refer to.
struct Blocks {
  std::uint64_t end;                                            ///< one past their last float
  std::uint32_t least_window = ~0u, most_window = leaf_window;  ///< names
};

/// One block's children that are blocks have to be the next ones in breadth-first order.
/// Returns: where the one after those begins.
std::uint64_t check_block(const ShapeArrays& a, std::uint64_t block, std::uint64_t next, Blocks& seen) {
  const float* x = a.nodes.data() + block;
  const float* names = x + 3 * block_width;
  require_discs("nodes", block, x, block_width, block_width);
  std::uint32_t inner = 0, least = seen.least_window, most = seen.most_window;
  for (std::uint32_t i = 0; i < block_width; ++i) {
    const auto name = std::bit_cast<std::uint32_t>(names[i]);
    const std::uint32_t is_disc = static_cast<std::uint32_t>(x[i] != infinity),
                        is_window = name / leaf_window;
    inner |= (is_disc & (is_window ^ 1)) << i;
    const std::uint32_t followed = -(is_disc & is_window);
    least = std::min(least, name | ~followed);
    most = std::max(most, name & followed);
  }
  seen.least_window = least, seen.most_window = most;
  for (; inner != 0; inner &= inner - 1, next += block_floats) {
    const auto name = std::bit_cast<std::uint32_t>(names[std::countr_zero(inner)]);
    if (name != next) reject("nodes", block, "child " + std::to_string(name) + " is not the next block");
  }
  return next;
}

/// Where a level's first node is a block: the blocks from there on, as far as they name each other.
Blocks check_blocks(const ShapeArrays& a, std::uint64_t top) {
  Blocks seen{};
  std::uint64_t next = top + block_floats, level_end = next;
  for (std::uint64_t block = top, levels = 1; block < next; block += block_floats) {
    if (block == level_end) {
      level_end = next;
      // The windows below are a level, too.
      if (++levels == most_wide_levels) reject("nodes", block, "the tree has too many levels");
    }
    if (block + block_floats > a.nodes.size()) reject("nodes", block, "the block ends beyond the array");
    next = check_block(a, block, next, seen);
  }
  seen.end = next;
  return seen;
}

/// Returns: one past the level's last float.
std::uint64_t check_tree(const ShapeArrays& a, std::size_t root, std::uint64_t begin) {
  const auto [top, stride] = a.trees[root];
  const std::uint64_t first = top & ~leaf_window;
  if (first < begin) reject("trees", root, "begins at " + std::to_string(first) + ", in another tree");
  Blocks blocks{first, top | leaf_window, top | leaf_window};
  if (top < leaf_window) blocks = check_blocks(a, top);
  const std::uint64_t discs = blocks.end, end = discs + 3 * std::uint64_t{stride};
  if (stride < block_width || end + block_floats > a.nodes.size())
    reject("trees", root, std::to_string(stride) + " discs do not fit");
  if (blocks.most_window != leaf_window || top >= leaf_window) {
    const std::uint64_t least = blocks.least_window & ~leaf_window, most = blocks.most_window & ~leaf_window;
    if (least < discs || most + block_width > discs + stride)
      reject(
          "trees", root,
          "windows at " + std::to_string(least) + " to " + std::to_string(most) + " are not among its discs");
  }
  require_discs("nodes", discs, a.nodes.data() + discs, stride, stride);
  return end;
}

void require_shortcuts(const ShapeArrays& a) {
  require_lengths("support", a.support);
  for (std::size_t s = 0; s < a.inscribed.size(); ++s) {
    require_discs("inscribed", s, a.inscribed[s].x, block_width, block_width);
    const Extremes& extremes = a.extremes[s];
    std::uint32_t bad = 0;
    for (const float x : extremes.x) bad |= beyond(x, largest_length);
    for (const float y : extremes.y) bad |= beyond(y, largest_length);
    if (bad != 0) reject("extremes", s, "not a point");
  }
  // A shape without an outline may nest with any, one of several contours in any.
  require_all("enclosures", a.enclosures, "no disc", [](const Enclosure& e) {
    const bool outer = e.outer_square == infinity || negative_or_beyond(e.outer_square, largest_square) == 0;
    const bool inner = e.inner_square == -infinity || beyond(e.inner_square, largest_square) == 0;
    return is_length(e.x) & is_length(e.y) & outer & inner;
  });
}

/// Offsets of runs that fill a list: from 0 to its size.
void require_offsets(const char* array, std::span<const std::uint32_t> offsets, std::uint64_t runs,
                     std::uint64_t end, bool may_be_empty) {
  require_size(array, offsets.size(), runs + 1);
  if (offsets.front() != 0) reject(array, 0, std::to_string(offsets.front()) + " is not 0");
  for (std::size_t i = 1; i < offsets.size(); ++i)
    if (offsets[i] < offsets[i - 1] + std::uint64_t{!may_be_empty})
      reject(array, i, std::to_string(offsets[i]) + " does not ascend");
  if (offsets.back() != end)
    reject(array, offsets.size() - 1,
           std::to_string(offsets.back()) + " is not the end, " + std::to_string(end));
}

void require_outlines(const ShapeArrays& a) {
  if (a.shape_contours.empty()) {
    require_size("contour_points", a.contour_points.size(), 0);
    require_size("contour_disc", a.contour_disc.size(), 0);
    require_size("points", a.points.size(), 0);
    return;
  }
  require_offsets("shape_contours", a.shape_contours, a.reach.size(), a.contour_disc.size(), true);
  require_offsets("contour_points", a.contour_points, a.contour_disc.size(), a.points.size(), false);
  require_all("contour_disc", a.contour_disc, "no disc",
              [](const Disc& d) { return is_length(d.x) & is_length(d.y) & is_radius(d.radius); });
  require_all("points", a.points, "no point", [](const Vec2& p) { return is_length(p.x) & is_length(p.y); });
}

}  // namespace

void validate(const ShapeArrays& arrays) {
  require_sizes(arrays);
  require_roots(arrays);
  std::uint64_t end = 0;
  for (std::size_t root = 0; root < arrays.trees.size(); ++root) end = check_tree(arrays, root, end);
  require_shortcuts(arrays);
  require_outlines(arrays);
}

}  // namespace bch
