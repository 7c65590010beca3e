// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "layout/base/plane_point.hpp"
#include "layout/base/rounding.hpp"
#include "layout/culling/profile.hpp"
#include "layout/culling/supports.hpp"
#include "layout/enclosing_disc/enclosing_disc.hpp"
#include "layout/format/contours.hpp"
#include "layout/format/leaf_segments.hpp"
#include "layout/shape_set/verify_parts.hpp"

// What follows from a shape's outline; where it is not stored, no area is known.

namespace bch::detail::verification {
namespace {

constexpr std::uint32_t no_level = Inconsistency::no_level;

PlanePoint direction(std::uint32_t k, std::uint32_t of) {
  const double angle = 2 * std::numbers::pi * k / of;
  return {std::cos(angle), std::sin(angle)};
}

/// The fraction of a segment's path up to which a disc holds it, if it holds the point at `from`; else `from`.
double covered_up_to(const Disc& disc, PlanePoint a, PlanePoint edge, double from) {
  const PlanePoint centre{static_cast<double>(disc.x), static_cast<double>(disc.y)};
  const double radius = disc.radius, square = dot(edge, edge);
  const PlanePoint to_a = a - centre, at{to_a.x + from * edge.x, to_a.y + from * edge.y};
  const double beyond = radius * radius - dot(at, at);
  if (beyond < 0) return from;
  if (square == 0) return 1;
  const double along = dot(at, edge);
  return from + (std::sqrt(along * along + square * beyond) - along) / square;
}

bool is_covered(const CutDiscs& discs, PlanePoint a, PlanePoint b) {
  const PlanePoint edge = b - a;
  const double half = 0.5 * length(edge);
  const PlanePoint middle{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
  std::vector<Disc> near;
  for (std::uint32_t i = 0; i < discs.count; ++i) {
    const Disc disc{discs.x[i], discs.y[i], discs.radius[i]};
    const PlanePoint to{static_cast<double>(disc.x) - middle.x, static_cast<double>(disc.y) - middle.y};
    const double limit = half + static_cast<double>(disc.radius);
    if (dot(to, to) <= limit * limit) near.push_back(disc);
  }
  double at = 0;
  for (double next = 0; at < 1; at = next) {
    for (const Disc& disc : near) next = std::max(next, covered_up_to(disc, a, edge, at));
    if (next == at) return false;
  }
  return true;
}

struct Depth {
  double distance;
  bool inside;
};

/// Computes the depth of a point in a contour.
Depth depth_in(std::span<const Vec2> contour, PlanePoint p) {
  Depth depth{HUGE_VAL, false};
  PlanePoint a = plane_point(contour.back()) - p;
  for (const Vec2 end : contour) {
    const PlanePoint b = plane_point(end) - p, edge = b - a;
    const double square = dot(edge, edge), t = square > 0 ? std::clamp(-dot(a, edge) / square, 0.0, 1.0) : 0;
    depth.distance = std::min(depth.distance, length({a.x + t * edge.x, a.y + t * edge.y}));
    if ((a.y > 0) != (b.y > 0)) depth.inside ^= (a.x * b.y - a.y * b.x > 0) == (b.y > a.y);
    a = b;
  }
  return depth;
}

/// Finds the farthest points of the largest contour, which profiles are made of.
Interior extremes_of(const Outline& outline) {
  Interior interior{};
  if (outline.contours() == 0) return interior;
  const auto contour = largest_contour(outline);
  for (std::uint32_t k = 0; k < extreme_directions; ++k) {
    const PlanePoint along = direction(k, extreme_directions);
    const Vec2 farthest = *std::max_element(contour.begin(), contour.end(), [&](Vec2 p, Vec2 q) {
      return dot(plane_point(p), along) < dot(plane_point(q), along);
    });
    interior.extreme_x[k] = farthest.x, interior.extreme_y[k] = farthest.y;
  }
  return interior;
}

/// What the library stored as outer, shallow_outer and excess.
void verify_outer(const Verifier& verifier, const Profile& stored, const DeepestBounds& bounds) {
  Outer shallow{};
  for (std::uint32_t level = 0; level + 1 < verifier.levels(); ++level) {
    const CutDiscs discs = verifier.cut(level);
    if (discs.count == 1) continue;
    const Outer of_level = outer(stored, discs.x, discs.y, discs.radius, discs.count, verifier.max_extent);
    for (std::uint32_t k = 0; k < profile_sectors; ++k) shallow[k] = std::max(shallow[k], of_level[k]);
  }
  const auto compare = [&](const std::string& what, float value, float expected) {
    verifier.compare("profiles", no_level, what, static_cast<double>(value), static_cast<double>(expected));
  };
  for (std::uint32_t k = 0; k < profile_sectors; ++k) {
    compare("outer of sector " + std::to_string(k), stored.sectors[k].outer, bounds.stored.outer[k]);
    compare("shallow_outer of sector " + std::to_string(k), stored.sectors[k].shallow_outer, shallow[k]);
  }
  compare("excess", stored.excess, excess(bounds.discs, bounds.stored));
}

/// Nothing is ever wrong with minus infinity, which is stored where nothing is known.
void verify_sectors(const Verifier& verifier, const Profile& stored, const Profile& expected) {
  const auto compare = [&](const char* what, std::uint32_t k, float value, float limit) {
    if (value != -infinity)
      verifier.compare("profiles", no_level, what + std::to_string(k), static_cast<double>(value),
                       static_cast<double>(limit));
  };
  for (std::uint32_t k = 0; k < profile_sectors; ++k) {
    compare("inner of sector ", k, stored.sectors[k].inner, expected.sectors[k].inner);
    compare("extent of sector ", k, stored.sectors[k].extent, expected.sectors[k].extent);
  }
}

}  // namespace

void verify_cover(const Verifier& verifier, const Outline& outline, std::uint32_t level) {
  const CutDiscs discs = verifier.cut(level);
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto contour = outline.contour(c);
    Vec2 before = contour.back();
    for (std::size_t i = 0; i < contour.size(); before = contour[i++])
      if (!is_covered(discs, plane_point(before), plane_point(contour[i])))
        verifier.report("nodes", level,
                        "no discs cover the outline at point " + std::to_string(i) + " of contour " +
                            std::to_string(c) + ", (" + shortest(contour[i].x) + ", " +
                            shortest(contour[i].y) + ") m");
  }
}

void verify_segments(const Verifier& verifier) {
  const ShapeArrays& arrays = verifier.arrays();
  const double margin = arrays.segment_margin[verifier.shape];
  if (margin + verifier.tolerance() * 0x1p-4 < rounding::segment_margin * verifier.max_extent)
    verifier.report("segment_margin", no_level, shortest(margin) + " m is below what rounding needs");
  const std::uint32_t level = verifier.levels() - 1;
  const Tree& tree = arrays.trees[verifier.root(level)];
  if (tree.segments == no_segments) return;
  const CutDiscs cut = verifier.cut(level);
  std::map<std::uint32_t, std::vector<std::uint32_t>> leaves;  // of each segment
  const auto words = arrays.leaf_segments.subspan(tree.segments);
  for (std::uint32_t k = 0; k < cut.count; ++k)
    for (const std::uint32_t segment : segments_of(words, k)) leaves[tree.points + segment].push_back(k);
  if (std::count(words.begin(), words.begin() + cut.count, 0u) > 0) return;  // some name none
  const auto [first, last] = arrays.shape_contours[verifier.shape];
  for (const Contour& contour : arrays.contours.subspan(first, last - first))
    for (std::uint32_t i = contour.begin; i < contour.end; ++i) {
      std::vector<float> x, y, radius;
      for (const std::uint32_t k : leaves[i])
        x.push_back(cut.x[k]), y.push_back(cut.y[k]), radius.push_back(cut.radius[k]);
      const CutDiscs naming{x.data(), y.data(), radius.data(), static_cast<std::uint32_t>(x.size())};
      if (!is_covered(naming, plane_point(arrays.points[i]), plane_point(arrays.points[i + 1])))
        verifier.report("leaf_segments", level,
                        "no leaves that name segment " + std::to_string(i) + " cover it");
    }
}

void verify_contours(const Verifier& verifier, const Outline& outline) {
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const std::uint32_t place =
        verifier.arrays().shape_contours[verifier.shape].begin + static_cast<std::uint32_t>(c);
    const Disc& stored = verifier.arrays().contours[place].disc;
    const EnclosingDisc smallest = smallest_enclosing_disc(outline.contour(c));
    const PlanePoint off = plane_point({stored.x, stored.y}) - plane_point(smallest.centre);
    const double larger = std::abs(static_cast<double>(stored.radius) - smallest.radius);
    if (larger > verifier.tolerance() || length(off) > verifier.tolerance())
      verifier.report(
          "contours", no_level,
          "the disc of contour " + std::to_string(place) + " at " + text_of(stored) + " is not its smallest");
  }
  const double farthest = max_extent(outline.points);
  const bool more = outline.contours() > 0 && verifier.cut(verifier.levels() - 1).count > 1;
  if (farthest > verifier.max_extent + verifier.tolerance() ||
      (more && verifier.max_extent > farthest + verifier.tolerance()))
    verifier.report(
        "max_extent", no_level,
        shortest(verifier.max_extent) + " m, and the outline reaches to " + shortest(farthest) + " m");
}

void verify_profile(const Verifier& verifier, const Outline& outline, const DeepestBounds& bounds) {
  const Profile& stored = verifier.arrays().profiles[verifier.shape];
  verify_outer(verifier, stored, bounds);
  // Made from the extent before it was rounded up.
  const float max_extent = std::nextafter(static_cast<float>(verifier.max_extent), 0.0f);
  const Profile expected = profile(outline, extremes_of(outline), static_cast<double>(max_extent));
  const double off = length(plane_point({stored.x, stored.y}) - plane_point({expected.x, expected.y}));
  if (off > verifier.tolerance())
    return verifier.report(
        "profiles", no_level,
        "the centre (" + shortest(stored.x) + ", " + shortest(stored.y) + ") m is not the area's");
  verify_sectors(verifier, stored, expected);
}

void verify_inside(const Verifier& verifier, const Outline& outline) {
  const auto contour = outline.contours() > 0 ? largest_contour(outline) : std::span<const Vec2>();
  const DiscBlock& discs = verifier.arrays().inscribed[verifier.shape];
  for (std::uint32_t i = 0; i < block_width; ++i) {
    if (!(discs.x[i] < infinity)) continue;
    const Disc disc{discs.x[i], discs.y[i], discs.radius[i]};
    const Depth depth = contour.empty() ? Depth{0, false} : depth_in(contour, plane_point({disc.x, disc.y}));
    const double max_radius = depth.distance - 24 * rounding::unit_roundoff * verifier.max_extent;
    if (!depth.inside || static_cast<double>(disc.radius) > max_radius)
      verifier.report(
          "inscribed", no_level,
          "disc " + std::to_string(i) + " at " + text_of(disc) + " is not inside the largest contour");
  }
}

}  // namespace bch::detail::verification
