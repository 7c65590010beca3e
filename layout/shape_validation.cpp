// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/shape_validation.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>
#include <string>

#include "layout/cut_discs.hpp"
#include "layout/rounding.hpp"

namespace bch {
namespace {

/// Of coordinates, radii and supports, metres: a few reaches, as pruning discs and supports stick out.
constexpr float largest_length = 1e7f;
constexpr float infinity = std::numeric_limits<float>::infinity();

[[noreturn]] void reject(const char* array, std::size_t place, const std::string& what) {
  throw std::invalid_argument(std::string(array) + " " + std::to_string(place) + ": " + what);
}

void require_size(const char* array, std::uint64_t size, std::uint64_t expected) {
  if (size != expected)
    throw std::invalid_argument(std::string(array) + ": " + std::to_string(size) +
                                " where there have to be " + std::to_string(expected));
}

/// The top bit of the result says so: a float whose magnitude is above a positive limit, or that is negative or above it.
/// Plain integer operations, so that loops over many become vectors; NaN is above everything.
std::uint32_t beyond(float value, float limit) {
  return std::bit_cast<std::uint32_t>(limit) - (std::bit_cast<std::uint32_t>(value) & 0x7fffffff);
}
std::uint32_t negative_or_beyond(float value, float limit) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (std::bit_cast<std::uint32_t>(limit) - bits) | bits;
}
constexpr std::uint32_t top_bit = 0x80000000;

bool is_length(float value) {
  return (beyond(value, largest_length) & top_bit) == 0;
}
bool is_radius(float value) {
  return (negative_or_beyond(value, largest_length) & top_bit) == 0;
}

/// All bits or none.
std::uint32_t is_padding(float x) {
  return -static_cast<std::uint32_t>(std::bit_cast<std::uint32_t>(x) ==
                                     std::bit_cast<std::uint32_t>(infinity));
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

/// From the first row on.
void require_supports(std::span<const float> support) {
  std::uint32_t bad = 0;
  for (std::size_t i = first_row * support_stride; i < support.size(); ++i)
    bad |= beyond(support[i], largest_length);
  if ((bad & top_bit) == 0) return;
  for (std::size_t i = first_row * support_stride; i < support.size(); ++i)
    if (!is_length(support[i])) reject("support", i, "not a length");
}

/// Eight or more discs, x, y and radius each in a run of its own. A disc at infinity is padding.
void require_discs(const char* array, std::size_t place, const float* x, std::size_t count,
                   std::size_t stride) {
  const float *y = x + stride, *radius = x + 2 * stride;
  std::uint32_t bad = 0;
  for (std::size_t i = 0; i < count; ++i) bad |= beyond(x[i], largest_length) & ~is_padding(x[i]);
  for (std::size_t i = 0; i < count; ++i) bad |= beyond(y[i], largest_length);
  for (std::size_t i = 0; i < count; ++i) bad |= negative_or_beyond(radius[i], largest_length);
  if ((bad & top_bit) != 0) reject(array, place, "holds a disc that is none");
}

/// As kernels load whole registers.
template <class... Arrays>
void require_alignment(const Arrays&... arrays) {
  const auto is_aligned = [](const void* data) { return std::bit_cast<std::uintptr_t>(data) % 64 == 0; };
  if (!(is_aligned(arrays.data()) && ...))
    throw std::invalid_argument("an array does not begin on a cache line");
}

void require_sizes(const ShapeArrays& a) {
  if (a.depths.empty() || a.depths.size() > 255)
    throw std::invalid_argument("depths: " + std::to_string(a.depths.size()) + ", not 1 to 255");
  for (std::size_t i = 1; i < a.depths.size(); ++i)
    if (a.depths[i] <= a.depths[i - 1]) reject("depths", i, std::to_string(a.depths[i]) + " does not ascend");
  const std::uint64_t shapes = a.shape_count(), roots = shapes * a.depths.size();
  if (roots > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("roots: " + std::to_string(roots) + ", too many");
  require_size("roots", a.roots.size(), roots);
  const bool roots_only = a.trees.empty(), shortcuts = !a.support.empty();
  require_size("trees", a.trees.size(), roots_only ? 0 : roots);
  require_size("reach", a.reach.size(), roots_only ? 0 : shapes);
  if (roots_only) {
    require_size("nodes", a.nodes.size(), 0);
    require_size("support", a.support.size(), 0);
    require_size("shape_contours", a.shape_contours.size(), 0);
  }
  if (a.nodes.size() >= leaf_window)
    throw std::invalid_argument("nodes: " + std::to_string(a.nodes.size()) + ", not below 2^31");
  require_size("inscribed", a.inscribed.size(), shortcuts ? shapes : 0);
  require_size("extremes", a.extremes.size(), shortcuts ? shapes : 0);
  require_size("profiles", a.profiles.size(), shortcuts ? shapes : 0);
}

/// Rows of supports are numbered in the order of shapes, whose deepest levels have them.
void require_rows(const ShapeArrays& a) {
  const std::size_t levels = a.depths.size();
  std::uint64_t rows = first_row;
  for (std::size_t i = 0; i < a.roots.size(); ++i) {
    if (a.roots[i].row == single_disc) continue;
    if (a.trees.empty()) reject("roots", i, "not a single disc, without a tree");
    const bool deepest = i % levels + 1 == levels;
    if (a.roots[i].row != (deepest ? rows : no_supports))
      reject("roots", i, "row " + std::to_string(a.roots[i].row) + " is not the next");
    rows += deepest;
  }
  if (a.support.empty()) return;
  require_size("support", a.support.size(), rows * support_stride);
  require_all("support", a.support.first(first_row * support_stride), "not infinite",
              [](float height) { return height == infinity; });
}

void require_roots(const ShapeArrays& a) {
  require_all("reach", a.reach, "outside the domain", [](float reach) {
    return static_cast<double>(reach) >= rounding::smallest_reach &&
           static_cast<double>(reach) <= rounding::largest_reach;
  });
  require_all("roots", a.roots, "no disc", [](const Root& root) {
    return is_length(root.x) & is_length(root.y) & is_radius(root.radius) & (root.radius > 0);
  });
  require_rows(a);
}

/// The windows that a level's nodes name, lane by lane. As signed numbers names of windows are negative, the first the
/// least, and those of blocks are not.
struct Windows {
  static constexpr std::int32_t none = 0;
  std::int32_t least[block_width] = {}, most[block_width];

  Windows() { std::fill_n(most, block_width, std::numeric_limits<std::int32_t>::min()); }
  /// One name in every lane.
  explicit Windows(std::uint32_t name) {
    std::fill_n(least, block_width, static_cast<std::int32_t>(name));
    std::fill_n(most, block_width, static_cast<std::int32_t>(name));
  }
};

/// One block's children that are blocks have to be the next ones in breadth-first order.
/// Returns: where the one after those begins.
std::uint64_t check_block(const ShapeArrays& a, std::uint64_t block, std::uint64_t next, Windows& windows) {
  const float* x = a.nodes.data() + block;
  const float* names = x + 3 * block_width;
  require_discs("nodes", block, x, block_width, block_width);
  if (x[0] == infinity) reject("nodes", block, "begins with padding");
  std::uint32_t any_block = 0;
#pragma GCC unroll 1  // else GCC 12 unrolls it first, and then makes no vectors
  for (std::uint32_t i = 0; i < block_width; ++i) {
    const auto name = std::bit_cast<std::uint32_t>(names[i]);
    const std::uint32_t disc = ~is_padding(x[i]);
    const std::uint32_t window = disc & static_cast<std::uint32_t>(static_cast<std::int32_t>(name) >> 31);
    any_block |= disc & ~name;
    const auto named = static_cast<std::int32_t>(name & window);
    const auto or_first = static_cast<std::int32_t>((name & window) | (~window & leaf_window));
    windows.least[i] = std::min(windows.least[i], named);
    windows.most[i] = std::max(windows.most[i], or_first);
  }
  if ((any_block & top_bit) == 0) return next;
  for (std::uint32_t i = 0; i < block_width; ++i) {
    const auto name = std::bit_cast<std::uint32_t>(names[i]);
    if (x[i] == infinity || name >= leaf_window) continue;
    if (name != next) reject("nodes", block, "child " + std::to_string(name) + " is not the next block");
    next += block_floats;
  }
  return next;
}

/// Where a level's first node is a block: the blocks from there on, as far as they name each other.
/// Returns: one past their last float.
std::uint64_t check_blocks(const ShapeArrays& a, std::uint64_t top, Windows& windows) {
  std::uint64_t next = top + block_floats, level_end = next;
  for (std::uint64_t block = top, levels = 1; block < next; block += block_floats) {
    if (block == level_end) {
      level_end = next;
      // The windows below are a level, too.
      if (++levels == most_wide_levels) reject("nodes", block, "the tree has too many levels");
    }
    if (block + block_floats > a.nodes.size()) reject("nodes", block, "the block ends beyond the array");
    next = check_block(a, block, next, windows);
  }
  return next;
}

/// All windows within count discs, of which the first is named so.
void require_within(const Windows& windows, std::size_t root, std::uint64_t first, std::uint64_t count) {
  const std::int32_t least = *std::min_element(windows.least, windows.least + block_width);
  const std::int32_t most = *std::max_element(windows.most, windows.most + block_width);
  if (least == Windows::none) return;
  const std::uint64_t from = static_cast<std::uint32_t>(least) & ~leaf_window,
                      to = static_cast<std::uint32_t>(most) & ~leaf_window;
  if (from < first || to + block_width > first + count)
    reject("trees", root,
           "windows at " + std::to_string(from) + " to " + std::to_string(to) + " are not among its discs");
}

/// Returns: one past the level's last float.
std::uint64_t check_tree(const ShapeArrays& a, std::size_t root, std::uint64_t begin) {
  const auto [top, stride] = a.trees[root];
  const std::uint64_t first = top & ~leaf_window;
  if (first < begin) reject("trees", root, "begins at " + std::to_string(first) + ", in another tree");
  Windows windows = top < leaf_window ? Windows() : Windows(top);
  const std::uint64_t discs = top < leaf_window ? check_blocks(a, top, windows) : first;
  const std::uint64_t end = discs + 3 * std::uint64_t{stride};
  if (stride < block_width || end + block_floats > a.nodes.size())
    reject("trees", root, std::to_string(stride) + " discs do not fit");
  require_within(windows, root, discs, stride);
  if (first_disc(a.nodes.data(), top) != discs)
    reject("trees", root, "the first window is not at the first disc");
  require_discs("nodes", discs, a.nodes.data() + discs, stride, stride);
  return end;
}

void require_shortcuts(const ShapeArrays& a) {
  require_supports(a.support);
  for (std::size_t s = 0; s < a.inscribed.size(); ++s) {
    require_discs("inscribed", s, a.inscribed[s].x, block_width, block_width);
    const Extremes& extremes = a.extremes[s];
    std::uint32_t bad = 0;
    for (const float x : extremes.x) bad |= beyond(x, largest_length);
    for (const float y : extremes.y) bad |= beyond(y, largest_length);
    if ((bad & top_bit) != 0) reject("extremes", s, "not a point");
  }
  // Minus infinity is what nothing is known of.
  const auto is_length_or_none = [](float value) { return (value == -infinity) | is_length(value); };
  require_all("profiles", a.profiles, "no profile", [&](const Profile& profile) {
    bool good = is_length(profile.x) & is_length(profile.y);
    for (const Sector& sector : profile.sectors)
      good &= is_length_or_none(sector.inner) & is_length(sector.outer) & is_length_or_none(sector.extent) &
              is_length(sector.shallow_outer);
    return good;
  });
}

/// Runs that follow each other and fill a list.
template <class Run>
void require_runs(const char* array, std::span<const Run> runs, std::uint64_t end, bool may_be_empty) {
  std::uint64_t next = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].begin != next)
      reject(array, i, "begins at " + std::to_string(runs[i].begin) + ", not " + std::to_string(next));
    if (runs[i].end < next + std::uint64_t{!may_be_empty})
      reject(array, i, "ends at " + std::to_string(runs[i].end) + " where it begins, or before");
    next = runs[i].end;
  }
  if (next != end)
    throw std::invalid_argument(std::string(array) + ": " + std::to_string(next) + " is not the end, " +
                                std::to_string(end));
}

void require_outlines(const ShapeArrays& a) {
  if (!a.shape_contours.empty()) require_size("shape_contours", a.shape_contours.size(), a.shape_count());
  require_runs("shape_contours", a.shape_contours, a.contours.size(), true);
  require_runs("contours", a.contours, a.points.size(), false);
  require_all("contours", a.contours, "no disc", [](const Contour& c) {
    return is_length(c.disc.x) & is_length(c.disc.y) & is_radius(c.disc.radius);
  });
  require_all("points", a.points, "no point", [](const Vec2& p) { return is_length(p.x) & is_length(p.y); });
}

}  // namespace

void validate(const ShapeArrays& arrays, const std::function<void(std::size_t)>& before_nodes) {
  require_alignment(arrays.depths, arrays.roots, arrays.trees, arrays.nodes, arrays.reach, arrays.support,
                    arrays.inscribed, arrays.extremes, arrays.profiles, arrays.shape_contours,
                    arrays.contours, arrays.points);
  require_sizes(arrays);
  require_roots(arrays);
  std::uint64_t end = 0;
  for (std::size_t root = 0; root < arrays.trees.size(); ++root) {
    if (before_nodes) before_nodes(arrays.trees[root].top & ~leaf_window);
    end = check_tree(arrays, root, end);
  }
  require_shortcuts(arrays);
  require_outlines(arrays);
}

}  // namespace bch
