// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/outline_arrangement.hpp"

namespace bch::test {
namespace {

__extension__ using Wide = __int128;

int sign(Wide value) {
  return (value > 0) - (value < 0);
}

/// (x / d, y / d), d > 0. Of crossings x and y have at most 2^75, d at most 2^49: products stay below 2^127.
struct Point {
  Wide x, y, d;
};

int compare_x(const Point& a, const Point& b) {
  return sign(a.x * b.d - b.x * a.d);
}
int compare_y(const Point& a, const Point& b) {
  return sign(a.y * b.d - b.y * a.d);
}
struct Lexicographic {
  bool operator()(const Point& a, const Point& b) const {
    const int x = compare_x(a, b);
    return x != 0 ? x < 0 : compare_y(a, b) < 0;
  }
};

/// The ends in lexicographic order.
struct Line {
  IntegerPoint a, b;
  friend bool operator<(const Line& s, const Line& t) {
    return std::tuple(s.a.x, s.a.y, s.b.x, s.b.y) < std::tuple(t.a.x, t.a.y, t.b.x, t.b.y);
  }
};

IntegerPoint way(const Line& line) {
  return {line.b.x - line.a.x, line.b.y - line.a.y};
}
std::int64_t cross(IntegerPoint v, IntegerPoint w) {
  return v.x * w.y - v.y * w.x;
}
std::int64_t side(const Line& line, IntegerPoint p) {
  return cross(way(line), {p.x - line.a.x, p.y - line.a.y});
}
int side(const Line& line, const Point& p) {
  const auto [x, y] = way(line);
  return sign(x * (p.y - line.a.y * p.d) - y * (p.x - line.a.x * p.d));
}
Point exactly(IntegerPoint p) {
  return {p.x, p.y, 1};
}

/// Directions by their angle in (-180, 180] degrees.
bool angle_less(IntegerPoint v, IntegerPoint w) {
  const auto upper = [](IntegerPoint u) { return u.y > 0 || (u.y == 0 && u.x < 0); };
  return upper(v) != upper(w) ? upper(w) : cross(v, w) > 0;
}

class Arrangement {
 public:
  explicit Arrangement(const std::vector<IntegerTriangle>& triangles) {
    std::set<Line> lines;
    for (const IntegerTriangle& t : triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        IntegerPoint a = t[k], b = t[(k + 1) % 3];
        if (a == b) continue;
        if (std::pair(b.x, b.y) < std::pair(a.x, a.y)) std::swap(a, b);
        lines.insert({a, b});
      }
    lines_.assign(lines.begin(), lines.end());
    for (const Line& line : lines_) cut(line);
  }

  std::vector<IntegerContour> contours() {
    std::vector<IntegerContour> result;
    std::vector<Face> faces;
    for (const auto& dart : darts_) {  // in lexicographic order
      const auto& point = dart.first;
      if (reached_.contains(point)) continue;
      reach_all_from(point);
      if (std::any_of(faces.begin(), faces.end(), [&](const Face& face) { return inside(face, point); }))
        continue;
      faces.push_back(face_from(point));
      result.push_back(corners(faces.back()));
    }
    return result;
  }

 private:
  struct AngleLess {
    bool operator()(IntegerPoint v, IntegerPoint w) const { return angle_less(v, w); }
  };
  /// Pieces that begin at a point: their direction, up to length, and where they end.
  using Ways = std::map<IntegerPoint, Point, AngleLess>;
  struct Dart {
    Point from;
    IntegerPoint way;
    Point to;
  };
  using Face = std::vector<Dart>;

  /// Adds the pieces into which the other lines cut this one.
  void cut(const Line& line) {
    std::set<Point, Lexicographic> points = {exactly(line.a), exactly(line.b)};
    const auto along = [&](const Point& p) {
      const Lexicographic less;
      return side(line, p) == 0 && !less(p, exactly(line.a)) && !less(exactly(line.b), p);
    };
    for (const Line& other : lines_) {
      for (const IntegerPoint end : {other.a, other.b})
        if (along(exactly(end))) points.insert(exactly(end));
      const std::int64_t a = side(line, other.a), b = side(line, other.b);
      const std::int64_t c = side(other, line.a), d = side(other, line.b);
      if (sign(a) * sign(b) >= 0 || sign(c) * sign(d) > 0) continue;
      const Wide whole = c > d ? c - d : d - c, part = c > d ? c : -c;
      const auto [x, y] = way(line);
      points.insert({line.a.x * whole + x * part, line.a.y * whole + y * part, whole});
    }
    const auto [x, y] = way(line);
    for (auto p = points.begin(), q = std::next(p); q != points.end(); ++p, ++q) {
      darts_[*p].insert({{x, y}, *q});
      darts_[*q].insert({{-x, -y}, *p});
    }
  }

  void reach_all_from(const Point& point) {
    std::vector<Point> open = {point};
    reached_.insert(point);
    while (!open.empty()) {
      const Point p = open.back();
      open.pop_back();
      for (const auto& [way, to] : darts_[p])
        if (reached_.insert(to).second) open.push_back(to);
    }
  }

  Dart next(const Point& at, IntegerPoint back) {
    const Ways& ways = darts_[at];
    auto found = ways.upper_bound(back);
    if (found == ways.end()) found = ways.begin();
    return {at, found->first, found->second};
  }

  Face face_from(const Point& leftmost) {
    Face face = {next(leftmost, {-1, 0})};
    for (;;) {
      const Dart& last = face.back();
      const Dart dart = next(last.to, {-last.way.x, -last.way.y});
      const Lexicographic less;
      if (!less(dart.from, face[0].from) && !less(face[0].from, dart.from) &&
          !angle_less(dart.way, face[0].way) && !angle_less(face[0].way, dart.way))
        return face;
      face.push_back(dart);
    }
  }

  /// The point is a corner of a triangle, d = 1, else the products would not fit.
  static bool inside(const Face& face, const Point& point) {
    int winding = 0;
    for (const Dart& dart : face) {
      const bool begins_above = compare_y(dart.from, point) > 0, ends_above = compare_y(dart.to, point) > 0;
      if (begins_above == ends_above) continue;
      const Wide s = dart.way.x * (point.y * dart.from.d - dart.from.y * point.d) -
                     dart.way.y * (point.x * dart.from.d - dart.from.x * point.d);
      if (ends_above && s > 0) ++winding;
      if (begins_above && s < 0) --winding;
    }
    return winding != 0;
  }

  static IntegerPoint rounded(const Point& p) {
    const auto nearest = [&](Wide v) {
      const Wide numerator = 2 * v + p.d, denominator = 2 * p.d;
      const Wide quotient = numerator / denominator;
      return static_cast<std::int64_t>(quotient - (quotient * denominator > numerator ? 1 : 0));
    };
    return {nearest(p.x), nearest(p.y)};
  }

  static IntegerContour corners(const Face& face) {
    IntegerContour contour;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const IntegerPoint before = face[i == 0 ? face.size() - 1 : i - 1].way, after = face[i].way;
      if (!angle_less(before, after) && !angle_less(after, before)) continue;
      const IntegerPoint p = rounded(face[i].from);
      if (contour.empty() || !(contour.back() == p)) contour.push_back(p);
    }
    if (contour.front() == contour.back()) contour.pop_back();
    return contour;
  }

  std::vector<Line> lines_;
  std::map<Point, Ways, Lexicographic> darts_;
  std::set<Point, Lexicographic> reached_;
};

}  // namespace

std::vector<IntegerContour> arrangement_outline(const std::vector<IntegerTriangle>& triangles) {
  return Arrangement(triangles).contours();
}

}  // namespace bch::test
