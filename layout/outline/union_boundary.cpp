// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/outline/union_boundary.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "layout/outline/grid_box.hpp"

namespace bch::detail {
namespace {

struct GridEdge {
  GridPoint a, b;

  GridVector direction() const { return b - a; }
};

/// A part of an edge, by fractions of it.
struct Part {
  Fraction begin, end;

  bool is_empty() const { return compare(begin, end) >= 0; }
};

const Fraction all_of_it(1, 1);

/// A triangle that goes counter-clockwise. Of each edge: whether it may be part of the boundary.
struct Tile {
  GridTriangle corners;
  std::array<bool, 3> may_bound;

  GridEdge edge(std::size_t k) const { return {corners[k], corners[(k + 1) % 3]}; }
};

/// Keeps of a part of an edge what a triangle's edge has to its left, where the edge of the part, moved to its right by less than
/// anything, is examined.
void keep_left_of(const GridEdge& side, const GridEdge& edge, Part& part) {
  const GridVector direction = side.direction();
  const std::int64_t at_begin = cross(direction, edge.a - side.a), at_end = cross(direction, edge.b - side.a);
  if (at_begin == 0 && at_end == 0) {
    if (dot(direction, edge.direction()) > 0) part.end = part.begin;
  } else if (at_begin <= 0 && at_end <= 0) {
    part.end = part.begin;
  } else if (at_begin < 0) {
    const Fraction enters(-at_begin, at_end - at_begin);
    if (compare(part.begin, enters) < 0) part.begin = enters;
  } else if (at_end < 0) {
    const Fraction leaves(at_begin, at_begin - at_end);
    if (compare(leaves, part.end) < 0) part.end = leaves;
  }
}

/// The part of an edge that a triangle covers on the edge's right.
Part covered(const Tile& by, const GridEdge& edge) {
  Part part{{}, all_of_it};
  for (std::size_t k = 0; k < 3 && !part.is_empty(); ++k) keep_left_of(by.edge(k), edge, part);
  return part;
}

/// The part of an edge that lies on another one of the same direction.
Part shared(const GridEdge& other, const GridEdge& edge) {
  const GridVector direction = edge.direction();
  if (cross(direction, other.direction()) != 0 || cross(direction, other.a - edge.a) != 0 ||
      dot(direction, other.direction()) <= 0)
    return {all_of_it, {}};
  const std::int64_t whole = dot(direction, direction);
  const std::int64_t begin = dot(direction, other.a - edge.a), end = dot(direction, other.b - edge.a);
  return {Fraction(std::clamp(begin, std::int64_t{0}, whole), whole),
          Fraction(std::clamp(end, std::int64_t{0}, whole), whole)};
}

/// Finds triangles by the cells of a grid that their boxes meet.
class Cells {
 public:
  explicit Cells(std::span<const Tile> tiles) {
    for (const Tile& tile : tiles) enlarge(bounds_, box_of(tile.corners));
    const double side = std::sqrt(static_cast<double>(tiles.size()));
    across_ = static_cast<std::size_t>(std::clamp(side, 1.0, 1024.0));
    begin_.assign(across_ * across_ + 1, 0);
    for (const Tile& tile : tiles)
      for_each(box_of(tile.corners), [&](std::size_t cell) { ++begin_[cell + 1]; });
    for (std::size_t cell = 0; cell + 1 < begin_.size(); ++cell) begin_[cell + 1] += begin_[cell];
    numbers_.resize(begin_.back());
    std::vector<std::size_t> next = begin_;
    for (std::size_t i = 0; i < tiles.size(); ++i)
      for_each(box_of(tiles[i].corners),
               [&](std::size_t cell) { numbers_[next[cell]++] = static_cast<std::uint32_t>(i); });
  }

  template <std::size_t Count>
  static GridBox box_of(const std::array<GridPoint, Count>& points) {
    GridBox box = empty_box;
    for (const GridPoint& point : points) enlarge(box, {point, point});
    return box;
  }

  /// Calls each(number) for the triangles of all cells that a box meets, for some more than once.
  template <class Each>
  void for_each_near(const GridBox& box, Each each) const {
    for_each(box, [&](std::size_t cell) {
      for (std::size_t i = begin_[cell]; i < begin_[cell + 1]; ++i) each(numbers_[i]);
    });
  }

 private:
  std::size_t along(std::int64_t from, std::int64_t low, std::int64_t high) const {
    const auto cells = static_cast<std::int64_t>(across_);
    return static_cast<std::size_t>((from - low) * cells / (high - low + 1));
  }
  template <class Each>
  void for_each(const GridBox& box, Each each) const {
    const std::size_t left = along(box.low.x, bounds_.low.x, bounds_.high.x);
    const std::size_t right = along(box.high.x, bounds_.low.x, bounds_.high.x);
    const std::size_t top = along(box.high.y, bounds_.low.y, bounds_.high.y);
    for (std::size_t y = along(box.low.y, bounds_.low.y, bounds_.high.y); y <= top; ++y)
      for (std::size_t x = left; x <= right; ++x) each(y * across_ + x);
  }

  GridBox bounds_ = empty_box;
  std::size_t across_ = 1;
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> numbers_;
};

std::vector<Tile> tiles_of(std::span<const GridTriangle> triangles) {
  std::vector<Tile> tiles;
  tiles.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    const std::int64_t twice_area = cross(b - a, c - a);
    if (twice_area > 0) tiles.push_back({{a, b, c}, {}});
    if (twice_area < 0) tiles.push_back({{a, c, b}, {}});
  }
  return tiles;
}

/// Marks the edges that have triangles on one side alone, one of those that are the same.
void mark_edges(std::vector<Tile>& tiles) {
  struct Use {
    std::uint64_t low, high;  ///< the ends, as numbers that are equal where they are
    std::uint32_t tile;
    std::uint8_t edge, forward;
  };
  const auto number = [](GridPoint p) { return std::bit_cast<std::uint64_t>(p); };
  std::vector<Use> uses;
  uses.reserve(3 * tiles.size());
  for (std::uint32_t t = 0; t < tiles.size(); ++t)
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint64_t a = number(tiles[t].edge(k).a), b = number(tiles[t].edge(k).b);
      uses.push_back({std::min(a, b), std::max(a, b), t, k, a < b});
    }
  std::sort(uses.begin(), uses.end(), [](const Use& u, const Use& v) {
    return u.low != v.low ? u.low < v.low : u.high != v.high ? u.high < v.high : u.tile < v.tile;
  });
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    const Use& first = uses[begin];
    bool one_sided = true;
    for (; end < uses.size() && uses[end].low == first.low && uses[end].high == first.high; ++end)
      one_sided &= uses[end].forward == first.forward;
    tiles[first.tile].may_bound[first.edge] = one_sided;
  }
}

/// Adds the pieces of an edge that no part covers.
void add_gaps(const GridEdge& edge, std::vector<Part>& parts, std::vector<BoundaryPiece>& pieces) {
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return compare(a.begin, b.begin) < 0; });
  parts.push_back({all_of_it, all_of_it});
  Fraction at;
  for (const Part& part : parts) {
    if (compare(at, part.begin) < 0) {
      const GridPoint begin = rounded({edge.a, edge.b, at}), end = rounded({edge.a, edge.b, part.begin});
      if (!(begin == end)) pieces.push_back({begin, end, edge.direction()});
    }
    if (compare(at, part.end) < 0) at = part.end;
  }
}

}  // namespace

std::vector<BoundaryPiece> union_boundary(std::span<const GridTriangle> triangles) {
  std::vector<Tile> tiles = tiles_of(triangles);
  std::vector<BoundaryPiece> pieces;
  if (tiles.empty()) return pieces;
  mark_edges(tiles);
  const Cells cells(tiles);
  std::vector<Part> parts;
  const auto keep = [&](const Part& part) {
    if (!part.is_empty()) parts.push_back(part);
  };
  for (std::uint32_t t = 0; t < tiles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      if (!tiles[t].may_bound[k]) continue;
      const GridEdge edge = tiles[t].edge(k);
      const GridBox box = Cells::box_of(std::array{edge.a, edge.b});
      parts.clear();
      cells.for_each_near(box, [&](std::uint32_t other) {
        const Tile& tile = tiles[other];
        const GridBox around = Cells::box_of(tile.corners);
        if (around.high.x < box.low.x || box.high.x < around.low.x || around.high.y < box.low.y ||
            box.high.y < around.low.y)
          return;
        keep(covered(tile, edge));
        // Of edges on one line, the first has what they share.
        for (std::size_t other_k = 0; other_k < 3; ++other_k)
          if (tile.may_bound[other_k] && 3 * std::size_t{other} + other_k < 3 * std::size_t{t} + k)
            keep(shared(tile.edge(other_k), edge));
      });
      add_gaps(edge, parts, pieces);
    }
  return pieces;
}

}  // namespace bch::detail
