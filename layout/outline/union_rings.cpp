// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/union_rings.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace bch::detail {
namespace {

constexpr std::size_t none = ~std::size_t{0};

bool begins_before(const BoundaryPiece& a, const BoundaryPiece& b) {
  return lexicographically_less(a.begin, b.begin);
}

/// Joins pieces. As many end at a point as begin there, so that a path goes on until it is back where it began; where it comes to a
/// point again, what lies between is a ring. Of several edges it takes the first one counter-clockwise from where it comes, which
/// keeps to one region next to the union.
class RingPath {
 public:
  explicit RingPath(std::vector<BoundaryPiece> pieces)
      : pieces_(std::move(pieces)), used_(pieces_.size(), 0), place_on_path_(pieces_.size(), none) {
    std::sort(pieces_.begin(), pieces_.end(), begins_before);
  }

  std::vector<GridRing> rings() {
    std::vector<GridRing> rings;
    for (std::size_t start = 0; start < pieces_.size(); ++start)
      for (std::size_t piece = start; piece != none && used_[piece] == 0; piece = next(pieces_[piece]))
        step(piece, rings);
    return rings;
  }

 private:
  /// The first of the pieces that begin at a point, which stands for the point.
  std::size_t node(GridPoint at) const {
    const auto first =
        std::lower_bound(pieces_.begin(), pieces_.end(), BoundaryPiece{at, at, {}}, begins_before);
    return static_cast<std::size_t>(first - pieces_.begin());
  }

  void step(std::size_t piece, std::vector<GridRing>& rings) {
    used_[piece] = 1;
    const GridPoint begin = pieces_[piece].begin, end = pieces_[piece].end;
    place_on_path_[node(begin)] = path_.size();
    path_.push_back(begin);
    const std::size_t at = node(end);
    if (at == pieces_.size() || place_on_path_[at] == none) return;
    const auto first = path_.begin() + static_cast<std::ptrdiff_t>(place_on_path_[at]);
    rings.emplace_back(first, path_.end());
    for (const GridPoint& point : rings.back()) place_on_path_[node(point)] = none;
    path_.erase(first, path_.end());
  }

  std::size_t next(const BoundaryPiece& from) const {
    const GridVector direction = from.direction;
    std::size_t first = none;
    int first_part = 4;
    for (std::size_t i = node(from.end); i < pieces_.size() && pieces_[i].begin == from.end; ++i) {
      if (used_[i] != 0) continue;
      const GridVector other = pieces_[i].direction;
      const std::int64_t side = cross(direction, other);
      const int on_line = dot(direction, other) > 0 ? 1 : 3;
      const int part = side < 0 ? 0 : side > 0 ? 2 : on_line;
      if (part > first_part || (part == first_part && cross(other, pieces_[first].direction) <= 0)) continue;
      first = i, first_part = part;
    }
    return first;
  }

  std::vector<BoundaryPiece> pieces_;  ///< in the order of where they begin
  std::vector<std::uint8_t> used_;
  std::vector<std::size_t> place_on_path_;  ///< of each node
  std::vector<GridPoint> path_;
};

/// Removes corners that are straight, and makes the smallest the first.
void tidy(GridRing& ring) {
  for (bool removed = true; removed && ring.size() >= 3;) {
    GridRing corners;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const GridPoint before = corners.empty() ? ring.back() : corners.back();
      if (cross(ring[i] - before, ring[(i + 1) % ring.size()] - ring[i]) != 0) corners.push_back(ring[i]);
    }
    removed = corners.size() < ring.size();
    ring = std::move(corners);
  }
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end(), lexicographically_less), ring.end());
}

std::int64_t twice_area(const GridRing& ring) {
  std::int64_t sum = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum += cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return sum;
}

/// Returns 1 for a point inside, -1 for one outside and 0 for one on the ring. Coordinates of the point are twice those of the grid.
int place_in(const GridRing& ring, GridVector twice) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const GridPoint a = ring[i], b = ring[(i + 1) % ring.size()];
    const GridVector from{2 * std::int64_t{a.x} - twice.x, 2 * std::int64_t{a.y} - twice.y};
    const GridVector to{2 * std::int64_t{b.x} - twice.x, 2 * std::int64_t{b.y} - twice.y};
    const std::int64_t side = cross(from, to);
    if (side == 0 && dot(from, to) <= 0) return 0;
    if ((from.y > 0) != (to.y > 0) && (to.y > from.y) == (side > 0)) inside = !inside;
  }
  return inside ? 1 : -1;
}

/// Returns whether a hole is in an exterior, which it may touch in points: by the first middle of an edge that is not on it.
bool contains(const GridRing& exterior, const GridRing& hole) {
  for (std::size_t i = 0; i < hole.size(); ++i) {
    const GridPoint a = hole[i], b = hole[(i + 1) % hole.size()];
    const int place = place_in(exterior, {std::int64_t{a.x} + b.x, std::int64_t{a.y} + b.y});
    if (place != 0) return place > 0;
  }
  return false;
}

}  // namespace

std::vector<GridRing> rings_of(std::vector<BoundaryPiece> boundary) {
  struct Polygon {
    std::int64_t area;
    std::vector<GridRing> rings;
  };
  std::vector<Polygon> polygons;
  std::vector<GridRing> holes;
  for (GridRing& ring : RingPath(std::move(boundary)).rings()) {
    tidy(ring);
    const std::int64_t area = twice_area(ring);
    if (area > 0)
      polygons.push_back({area, {std::move(ring)}});
    else if (area < 0)
      holes.push_back(std::move(ring));
  }
  const auto begins_first = [](const GridRing& a, const GridRing& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), lexicographically_less);
  };
  std::sort(holes.begin(), holes.end(), begins_first);
  std::sort(polygons.begin(), polygons.end(),
            [&](const Polygon& a, const Polygon& b) { return begins_first(a.rings[0], b.rings[0]); });
  for (GridRing& hole : holes) {
    Polygon* smallest = nullptr;
    for (Polygon& polygon : polygons)
      if ((smallest == nullptr || polygon.area < smallest->area) && contains(polygon.rings[0], hole))
        smallest = &polygon;
    if (smallest != nullptr) smallest->rings.push_back(std::move(hole));
  }
  std::vector<GridRing> rings;
  for (Polygon& polygon : polygons)
    for (GridRing& ring : polygon.rings) rings.push_back(std::move(ring));
  return rings;
}

}  // namespace bch::detail
