// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/union_outline.hpp"

#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "layout/rounding.hpp"

namespace bch {
namespace {

using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;
using Triangle = std::array<IntPoint, 3>;

/// Coordinates stay below 2^23 steps: floats hold them exactly, and Clipper stays on its fast 64-bit path.
constexpr int grid_bits = 23;

struct SnappedMesh {
  std::vector<Triangle> triangles;
  double step;
};

SnappedMesh snap(std::span<const Eigen::Vector3f> positions,
                 std::span<const std::array<std::uint32_t, 3>> triangles) {
  if (triangles.empty()) throw std::invalid_argument("outline: no triangles");
  double reach = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t v : triangles[t]) {
      if (v >= positions.size())
        throw std::invalid_argument("outline: triangle " + std::to_string(t) + " names vertex " +
                                    std::to_string(v));
      if (!std::isfinite(positions[v].x()) || !std::isfinite(positions[v].y()))
        throw std::invalid_argument("outline: vertex " + std::to_string(v) + " is not finite");
      reach = std::max({reach, std::abs(static_cast<double>(positions[v].x())),
                        std::abs(static_cast<double>(positions[v].y()))});
    }
  if (!(reach >= rounding::smallest_reach && reach <= rounding::largest_reach))
    throw std::invalid_argument("outline: reach " + std::to_string(reach) + " m is outside 1e-6 to 1e6 m");

  SnappedMesh mesh;
  mesh.step = std::ldexp(1.0, std::ilogb(reach) + 1 - grid_bits);
  const auto to_grid = [&](float x) {
    return static_cast<ClipperLib::cInt>(std::floor(static_cast<double>(x) / mesh.step + 0.5));
  };
  mesh.triangles.reserve(triangles.size());
  for (const auto& t : triangles) {
    Triangle snapped;
    for (int k = 0; k < 3; ++k)
      snapped[k] = IntPoint(to_grid(positions[t[k]].x()), to_grid(positions[t[k]].y()));
    mesh.triangles.push_back(snapped);
  }
  return mesh;
}

ClipperLib::cInt twice_area(const Triangle& t) {
  return (t[1].X - t[0].X) * (t[2].Y - t[0].Y) - (t[1].Y - t[0].Y) * (t[2].X - t[0].X);
}

double length(IntPoint a, IntPoint b) {
  return std::hypot(static_cast<double>(b.X - a.X), static_cast<double>(b.Y - a.Y));
}

/// The outer contours of the union, counter-clockwise.
Paths outer_contours(const std::vector<Triangle>& triangles) {
  ClipperLib::Clipper clipper;
  for (Triangle t : triangles) {
    const auto area = twice_area(t);
    if (area == 0) continue;
    if (area < 0) std::swap(t[1], t[2]);
    clipper.AddPath(Path(t.begin(), t.end()), ClipperLib::ptSubject, true);
  }
  ClipperLib::PolyTree tree;
  clipper.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  Paths contours;
  for (const ClipperLib::PolyNode* outer : tree.Childs) contours.push_back(outer->Contour);
  return contours;
}

double distance(IntPoint p, IntPoint a, IntPoint b) {
  const double dx = static_cast<double>(b.X - a.X), dy = static_cast<double>(b.Y - a.Y);
  const double px = static_cast<double>(p.X - a.X), py = static_cast<double>(p.Y - a.Y);
  const double square = dx * dx + dy * dy;
  const double t = square > 0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(px - t * dx, py - t * dy);
}

bool covered(const Paths& contours, IntPoint p) {
  constexpr double rounding_of_crossings = 0.75;  // grid steps; sqrt(1/2) and a little
  for (const Path& contour : contours)
    if (ClipperLib::PointInPolygon(p, contour) != 0) return true;
  for (const Path& contour : contours)
    for (std::size_t i = 0; i < contour.size(); ++i)
      if (distance(p, contour[i], contour[(i + 1) % contour.size()]) <= rounding_of_crossings) return true;
  return false;
}

using Edge = std::pair<IntPoint, IntPoint>;

bool before(const IntPoint& a, const IntPoint& b) {
  return a.X != b.X ? a.X < b.X : a.Y < b.Y;
}

/// Edges that the union cannot show as area: the longest edge of a triangle thinner than the rounding of
/// crossings, and the edges at a vertex that the union lost (a tip whose sides were rounded together).
std::vector<Edge> whisker_candidates(const std::vector<Triangle>& triangles, const Paths& contours) {
  constexpr double thin = 4;  // grid steps
  std::vector<Edge> edges;
  const auto add = [&](IntPoint a, IntPoint b) { edges.push_back(before(a, b) ? Edge{a, b} : Edge{b, a}); };
  for (const Triangle& t : triangles) {
    int longest = 0;
    for (int k = 1; k < 3; ++k)
      if (length(t[k], t[(k + 1) % 3]) > length(t[longest], t[(longest + 1) % 3])) longest = k;
    const double base = length(t[longest], t[(longest + 1) % 3]);
    if (base == 0) continue;
    if (std::abs(static_cast<double>(twice_area(t))) <= thin * base) add(t[longest], t[(longest + 1) % 3]);
    if (twice_area(t) == 0) continue;
    for (int k = 0; k < 3; ++k) {
      if (covered(contours, t[k])) continue;
      add(t[k], t[(k + 1) % 3]);
      add(t[k], t[(k + 2) % 3]);
    }
  }
  const auto less = [](const Edge& a, const Edge& b) {
    return a.first == b.first ? before(a.second, b.second) : before(a.first, b.first);
  };
  std::sort(edges.begin(), edges.end(), less);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

double cross(IntPoint a, IntPoint b, IntPoint p) {
  return static_cast<double>((b.X - a.X) * (p.Y - a.Y) - (b.Y - a.Y) * (p.X - a.X));
}

/// Where along an edge (0 to 1) the contours cross or touch it, in order, with both ends.
std::vector<double> crossings(const Edge& edge, const Paths& contours) {
  const auto [a, b] = edge;
  const double square = length(a, b) * length(a, b);
  std::vector<double> at = {0, 1};
  for (const Path& contour : contours)
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const IntPoint p = contour[i], q = contour[(i + 1) % contour.size()];
      const double p_side = cross(a, b, p), q_side = cross(a, b, q);
      if (p_side == 0)
        at.push_back(static_cast<double>((p.X - a.X) * (b.X - a.X) + (p.Y - a.Y) * (b.Y - a.Y)) / square);
      if ((p_side < 0) != (q_side < 0)) at.push_back(cross(p, q, a) / (cross(p, q, a) - cross(p, q, b)));
    }
  std::erase_if(at, [](double t) { return !(t >= 0 && t <= 1); });
  std::sort(at.begin(), at.end());
  return at;
}

/// The parts of the edges outside the contours, each as a contour that goes there and back. (Clipper could
/// clip open paths, but it loses some that run along x.)
Paths whiskers(const std::vector<Edge>& edges, const Paths& contours) {
  Paths lines;
  for (const Edge& edge : edges) {
    const auto [a, b] = edge;
    const auto point = [a = a, b = b](double t) {
      const auto on_grid = [t](ClipperLib::cInt from, ClipperLib::cInt to) {
        return from + static_cast<ClipperLib::cInt>(std::floor(t * static_cast<double>(to - from) + 0.5));
      };
      return IntPoint(on_grid(a.X, b.X), on_grid(a.Y, b.Y));
    };
    const std::vector<double> at = crossings(edge, contours);
    std::size_t begin = 0;  // of the part outside that is being followed
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
      const bool outside = !covered(contours, point(0.5 * (at[i] + at[i + 1])));
      if (!outside) begin = i + 1;
      const bool last = i + 2 == at.size() || covered(contours, point(0.5 * (at[i + 1] + at[i + 2])));
      if (outside && last && !(point(at[begin]) == point(at[i + 1])))
        lines.push_back({point(at[begin]), point(at[i + 1])});
    }
  }
  return lines;
}

}  // namespace

Outline union_outline(std::span<const Eigen::Vector3f> positions,
                      std::span<const std::array<std::uint32_t, 3>> triangles) {
  const SnappedMesh mesh = snap(positions, triangles);
  Paths contours = outer_contours(mesh.triangles);
  const std::vector<Edge> edges = whisker_candidates(mesh.triangles, contours);
  if (!edges.empty()) {
    const Paths lines = whiskers(edges, contours);
    contours.insert(contours.end(), lines.begin(), lines.end());
  }
  if (contours.empty())
    throw std::invalid_argument("outline: every triangle is a point when seen from above");

  for (Path& contour : contours)
    std::rotate(contour.begin(), std::min_element(contour.begin(), contour.end(), before), contour.end());
  std::stable_sort(contours.begin(), contours.end(),
                   [](const Path& a, const Path& b) { return before(a[0], b[0]); });

  Outline outline;
  outline.grid_step = static_cast<float>(mesh.step);
  for (const Path& contour : contours) {
    for (const IntPoint& p : contour)
      outline.points.push_back({static_cast<float>(static_cast<double>(p.X) * mesh.step),
                                static_cast<float>(static_cast<double>(p.Y) * mesh.step)});
    outline.contour_begin.push_back(static_cast<std::uint32_t>(outline.points.size()));
  }
  return outline;
}

}  // namespace bch
