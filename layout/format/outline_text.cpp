// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/outline.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "layout/base/shortest.hpp"
#include "layout/format/contours.hpp"

namespace bch {
namespace {

using Ring = std::vector<Vec2>;
using Polygon = std::vector<Ring>;  ///< an exterior, and its holes

double turn(Vec2 a, Vec2 b, Vec2 c) {
  return (double{b.x} - double{a.x}) * (double{c.y} - double{b.y}) -
         (double{b.y} - double{a.y}) * (double{c.x} - double{b.x});
}

/// Removes corners that are straight, and the tips of whiskers.
Ring without_straight_corners(Ring ring) {
  for (bool removed = true; removed && ring.size() >= 3;) {
    Ring corners;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 before = corners.empty() ? ring.back() : corners.back();
      if (turn(before, ring[i], ring[(i + 1) % ring.size()]) != 0) corners.push_back(ring[i]);
    }
    removed = corners.size() < ring.size();
    ring = std::move(corners);
  }
  return ring;
}

/// Returns the rings of a contour: polygons have no corner twice, so that it is cut where it comes to a point again. What has
/// no area, or goes round the other way by the rounding to the grid, is left out.
std::vector<Ring> rings_of(std::span<const Vec2> contour) {
  const bool is_hole = detail::twice_area(contour) < 0;
  std::vector<Ring> rings;
  std::map<std::pair<float, float>, std::size_t> place;  // of the points on the path
  Ring path;
  const auto close = [&](std::size_t first) {
    Ring ring = without_straight_corners({path.begin() + static_cast<std::ptrdiff_t>(first), path.end()});
    const double area = ring.empty() ? 0 : detail::twice_area(ring);
    if (is_hole ? area < 0 : area > 0) rings.push_back(std::move(ring));
  };
  for (const Vec2& point : contour) {
    if (const auto found = place.find({point.x, point.y}); found != place.end()) {
      const std::size_t first = found->second;
      close(first);
      for (; path.size() > first; path.pop_back()) place.erase({path.back().x, path.back().y});
    }
    place[{point.x, point.y}] = path.size();
    path.push_back(point);
  }
  close(0);
  return rings;
}

std::vector<Polygon> polygons_of(const Outline& outline) {
  std::vector<Polygon> polygons;
  for (std::size_t i = 0; i < outline.contours(); ++i)
    for (Ring& ring : rings_of(outline.contour(i))) {
      if (polygons.empty() || detail::twice_area(ring) > 0) polygons.emplace_back();
      polygons.back().push_back(std::move(ring));
    }
  return polygons;
}

/// How a format writes lists and points.
struct Marks {
  char open, close;
  const char *open_point, *within_point, *close_point, *between;
};

/// Writes each of some items, with marks around them all and between them.
template <class Items, class Write>
void write_list(std::string& to, const Marks& marks, const Items& items, Write write) {
  to += marks.open;
  for (bool first = true; const auto& item : items) {
    if (!first) to += marks.between;
    first = false;
    write(item);
  }
  to += marks.close;
}

std::string text_of(const std::vector<Polygon>& polygons, const Marks& marks) {
  std::string to;
  write_list(to, marks, polygons, [&](const Polygon& polygon) {
    write_list(to, marks, polygon, [&](Ring ring) {
      ring.push_back(ring.front());
      write_list(to, marks, ring, [&](Vec2 p) {
        to.append(marks.open_point).append(detail::shortest(p.x)).append(marks.within_point);
        to.append(detail::shortest(p.y)).append(marks.close_point);
      });
    });
  });
  return to;
}

}  // namespace

std::string to_wkt(const Outline& outline) {
  const std::vector<Polygon> polygons = polygons_of(outline);
  return "MULTIPOLYGON " + (polygons.empty() ? "EMPTY" : text_of(polygons, {'(', ')', "", " ", "", ", "}));
}

std::string to_geojson(const Outline& outline) {
  return R"({"type":"MultiPolygon","coordinates":)" +
         text_of(polygons_of(outline), {'[', ']', "[", ",", "]", ","}) + "}";
}

}  // namespace bch
