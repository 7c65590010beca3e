// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <array>
#include <cmath>
#include <stdexcept>

#include "layout/base/rounding.hpp"
#include "layout/format/shape_checks.hpp"

namespace bch::detail::shape_checks {
namespace {

/// The numbers of a profile's sectors of which nothing may be known: inner and extent. Minus infinity says so.
constexpr auto may_be_unknown = [] {
  std::array<std::uint32_t, profile_sectors * sizeof(Sector) / sizeof(float)> known{};
  for (std::size_t i = 0; i < known.size(); i += 2) known[i] = ~std::uint32_t{0};
  return known;
}();

/// Runs that follow each other, each and a gap behind the one before, and fill a list.
template <class Run>
void require_runs(const char* array, std::span<const Run> runs, std::uint64_t end, bool may_be_empty,
                  std::uint64_t gap) {
  std::uint64_t next = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].begin != next)
      reject(array, i,
             "expected a beginning at " + std::to_string(next) + ", found " + std::to_string(runs[i].begin));
    if (runs[i].end < next + std::uint64_t{!may_be_empty})
      reject(array, i, "ends at " + std::to_string(runs[i].end) + " where it begins, or before");
    next = runs[i].end + gap;
  }
  if (next != end)
    throw std::invalid_argument(std::string(array) + ": expected an end at " + std::to_string(end) +
                                ", found " + std::to_string(next));
}

/// The radius of a disc about a contour's points is that of the farthest one, and the centre is among them.
bool is_about(const Disc& disc, std::span<const Vec2> points) {
  float farthest = 0, left = infinity, right = -infinity, low = infinity, high = -infinity;
  for (const Vec2 p : points) {
    const float x = p.x - disc.x, y = p.y - disc.y, square = x * x + y * y;
    farthest = farthest < square ? square : farthest;
    left = x < left ? x : left, right = right < x ? x : right;
    low = y < low ? y : low, high = high < y ? y : high;
  }
  // Centre and radius are rounded; coordinates may be much larger than the disc.
  const float slack = 0x1p-20f * (std::abs(disc.x) + std::abs(disc.y) + disc.radius);
  return left <= slack && right >= -slack && low <= slack && high >= -slack &&
         std::abs(std::sqrt(farthest) - disc.radius) <= slack;
}

}  // namespace

void reject(const char* array, std::size_t place, const std::string& what) {
  throw std::invalid_argument(std::string(array) + " " + std::to_string(place) + ": " + what);
}

void require_size(const char* array, std::uint64_t size, std::uint64_t expected) {
  if (size != expected)
    throw std::invalid_argument(std::string(array) + ": expected " + std::to_string(expected) + ", found " +
                                std::to_string(size));
}

void alignment(const ShapeArrays& a) {
  for_each_array(
      [](const char* name, const auto& array) {
        if (std::bit_cast<std::uintptr_t>(array.data()) % 64 != 0)
          throw std::invalid_argument(std::string(name) + ": does not begin on a cache line");
      },
      a);
}

void depths(const ShapeArrays& a) {
  if (a.depths.empty() || a.depths.size() > 255)
    throw std::invalid_argument("depths: expected 1 to 255, found " + std::to_string(a.depths.size()));
  for (std::size_t i = 1; i < a.depths.size(); ++i)
    if (a.depths[i] <= a.depths[i - 1])
      reject(
          "depths", i,
          "expected more than " + std::to_string(a.depths[i - 1]) + ", found " + std::to_string(a.depths[i]));
}

void sizes(const ShapeArrays& a) {
  const std::uint64_t shapes = a.shape_count(), roots = shapes * a.depths.size();
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
  if (roots > most) throw std::invalid_argument("roots: " + std::to_string(roots) + ", too many");
  require_size("roots", a.roots.size(), roots);
  const bool roots_only = a.trees.empty(), culling = !a.support.empty();
  require_size("trees", a.trees.size(), roots_only ? 0 : roots);
  require_size("max_extent", a.max_extent.size(), roots_only ? 0 : shapes);
  if (roots_only) {
    require_size("nodes", a.nodes.size(), 0);
    require_size("support", a.support.size(), 0);
    require_size("shape_contours", a.shape_contours.size(), 0);
  }
  if (a.nodes.size() >= leaf_bit)
    throw std::invalid_argument("nodes: expected fewer than 2^31, found " + std::to_string(a.nodes.size()));
  require_size("inscribed", a.inscribed.size(), culling ? shapes : 0);
  require_size("profiles", a.profiles.size(), culling ? shapes : 0);
  // Kernels name a profile's records by 32 bits, two floats each.
  if (culling && shapes > most / (sizeof(Profile) / (2 * sizeof(float))))
    throw std::invalid_argument("profiles: " + std::to_string(shapes) + ", too many");
  const bool outlines = !a.shape_contours.empty();
  if (outlines) require_size("shape_contours", a.shape_contours.size(), shapes);
  require_size("segment_margin", a.segment_margin.size(), outlines ? shapes : 0);
  if (!outlines) require_size("leaf_segments", a.leaf_segments.size(), 0);
  if (!a.heights.empty()) require_size("heights", a.heights.size(), shapes);
  if (a.leaf_segments.size() > most)
    throw std::invalid_argument("leaf_segments: " + std::to_string(a.leaf_segments.size()) + ", too many");
}

void heights(const ShapeArrays& a) {
  require_all("heights", a.heights, "no heights",
              [](const Heights& heights) { return heights.bottom <= heights.top; });
}

/// Rows of supports are numbered in the order of shapes, whose deepest levels have them.
void rows(const ShapeArrays& a) {
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
  if (!a.support.empty()) require_size("support", a.support.size(), rows * support_stride);
}

/// Else a DynamicShapeSet, which goes by the plan, would copy roots that name trees, and no trees.
void single_depth(const ShapeArrays& a) {
  if (a.depths[0] != 0) return;
  if (a.depths.size() == 1) require_size("trees", a.trees.size(), 0);
  for (std::size_t i = 0; i < a.roots.size(); i += a.depths.size())
    if (a.roots[i].row != single_disc) reject("roots", i, "more than a disc at depth 0");
}

void infinite_rows(const ShapeArrays& a) {
  if (a.support.empty()) return;
  require_all("support", a.support.first(first_row * support_stride), "not infinite",
              [](float height) { return height == infinity; });
}

void max_extents(const ShapeArrays& a) {
  require_all("max_extent", a.max_extent, "outside the domain", [](float max_extent) {
    return static_cast<double>(max_extent) >= rounding::smallest_extent &&
           static_cast<double>(max_extent) <= rounding::largest_extent;
  });
}

void roots(const ShapeArrays& a) {
  require_all("roots", a.roots, "no disc", [](const Root& root) {
    return is_length(root.x) & is_length(root.y) & is_radius(root.radius) & (root.radius > 0);
  });
}

void supports(const ShapeArrays& a) {
  std::uint32_t bad = 0;
  for (std::size_t i = first_row * support_stride; i < a.support.size(); ++i)
    bad |= beyond(a.support[i], largest_length);
  if ((bad & top_bit) == 0) return;
  for (std::size_t i = first_row * support_stride; i < a.support.size(); ++i)
    if (!is_length(a.support[i])) reject("support", i, "not a length");
}

void inscribed(const ShapeArrays& a) {
  for (std::size_t s = 0; s < a.inscribed.size(); ++s)
    require_discs("inscribed", s, a.inscribed[s].x, block_width, block_width);
}

void profiles(const ShapeArrays& a) {
  for (std::size_t s = 0; s < a.profiles.size(); ++s) {
    const Profile& profile = a.profiles[s];
    std::uint32_t bad = beyond(profile.x, largest_length) | beyond(profile.y, largest_length);
    bad |= negative_or_beyond(profile.excess, largest_length);
    if (profile.discs_decide != 0 && profile.discs_decide != 1) reject("profiles", s, "no profile");
    const float* values = &profile.sectors[0].inner;
    for (std::uint32_t i = 0; i < may_be_unknown.size(); ++i)
      bad |= beyond(values[i], largest_length) & ~(is_padding(-values[i]) & may_be_unknown[i]);
    if ((bad & top_bit) != 0) reject("profiles", s, "no profile");
  }
}

void shape_contours(const ShapeArrays& a) {
  require_runs("shape_contours", a.shape_contours, a.contours.size(), true, 0);
}

void contour_points(const ShapeArrays& a) {
  require_runs("contours", a.contours, a.points.size(), false, 1);
  require_all("contours", a.contours, "its first point does not follow its last one", [&](const Contour& c) {
    return std::bit_cast<std::uint64_t>(a.points[c.begin]) == std::bit_cast<std::uint64_t>(a.points[c.end]);
  });
}

void points(const ShapeArrays& a) {
  require_all("points", a.points, "no point", [](const Vec2& p) { return is_length(p.x) & is_length(p.y); });
}

void segment_margins(const ShapeArrays& a) {
  require_all("segment_margin", a.segment_margin, "no margin",
              [](float margin) { return is_radius(margin); });
}

void contour_discs(const ShapeArrays& a) {
  require_all("contours", a.contours, "no disc", [](const Contour& c) {
    return is_length(c.disc.x) & is_length(c.disc.y) & is_radius(c.disc.radius);
  });
  require_all("contours", a.contours, "a disc that is not about the contour",
              [&](const Contour& c) { return is_about(c.disc, a.points.subspan(c.begin, c.end - c.begin)); });
}

}  // namespace bch::detail::shape_checks
