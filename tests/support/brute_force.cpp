// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/brute_force.hpp"

#include "baselines/exact_tests.hpp"

namespace bch::test {
namespace {

using baselines::Body;
using baselines::Placement;
using baselines::Point2;
using baselines::Point3;

struct Box {
  double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void add(const Point3& p) {
    const double at[] = {p.x, p.y, p.z};
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], at[i]);
      high[i] = std::max(high[i], at[i]);
    }
  }
  bool meets(const Box& other) const {
    for (int i = 0; i < 3; ++i)
      if (low[i] > other.high[i] || other.low[i] > high[i]) return false;
    return true;
  }
};

template <class Facet>
struct Boxed {
  Facet facet;
  Box box;
};

template <class Facet>
Box whole(const std::vector<Boxed<Facet>>& facets) {
  Box box;
  for (const auto& [facet, of] : facets) {
    box.add({of.low[0], of.low[1], of.low[2]});
    box.add({of.high[0], of.high[1], of.high[2]});
  }
  return box;
}

template <class Facet, class Meet>
bool any_meet(std::vector<Boxed<Facet>> a, std::vector<Boxed<Facet>> b, Meet meet) {
  const Box box_a = whole(a), box_b = whole(b);
  std::erase_if(a, [&](const Boxed<Facet>& f) { return !f.box.meets(box_b); });
  std::erase_if(b, [&](const Boxed<Facet>& f) { return !f.box.meets(box_a); });
  for (const auto& s : a)
    for (const auto& t : b)
      if (s.box.meets(t.box) && meet(s.facet, t.facet)) return true;
  return false;
}

/// Triangles in space, or dropped to the ground.
std::vector<Boxed<baselines::Triangle3>> triangles(const Body& body, const Placement* at, bool flat) {
  std::vector<Point3> placed;
  for (const Vec3& p : body.positions) {
    const Vec2 ground{p.x, p.y};
    const Point2 q = at != nullptr ? at->place(ground) : baselines::exact(ground);
    const double rise = at != nullptr ? at->z : 0;
    placed.push_back({q.x, q.y, flat ? 0.0 : rise + static_cast<double>(p.z)});
  }
  std::vector<Boxed<baselines::Triangle3>> result;
  for (const auto& [i, j, k] : body.triangles) {
    auto& [facet, box] = result.emplace_back();
    facet = {placed[i], placed[j], placed[k]};
    for (const Point3& p : facet) box.add(p);
  }
  return result;
}

std::vector<Boxed<baselines::Segment2>> segments(const Outline& outline, const Placement* at) {
  std::vector<Boxed<baselines::Segment2>> result;
  for (std::size_t c = 0; c < outline.contours(); ++c) {
    const auto points = outline.contour(c);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 from = points[i], to = points[(i + 1) % points.size()];
      auto& [facet, box] = result.emplace_back();
      facet = at != nullptr ? baselines::Segment2{at->place(from), at->place(to)}
                            : baselines::Segment2{baselines::exact(from), baselines::exact(to)};
      box.add({facet.a.x, facet.a.y, 0});
      box.add({facet.b.x, facet.b.y, 0});
    }
  }
  return result;
}

}  // namespace

bool meshes_meet(const Body& a, const Body& b, const Placement& at) {
  return any_meet(triangles(a, nullptr, false), triangles(b, &at, false),
                  [](const auto& s, const auto& t) { return baselines::triangles_meet(s, t); });
}

bool outlines_meet(const Outline& a, const Outline& b, const Placement& at) {
  return any_meet(segments(a, nullptr), segments(b, &at),
                  [](const auto& s, const auto& t) { return baselines::segments_meet(s, t); });
}

bool projections_meet(const Body& a, const Body& b, const Placement& at) {
  const auto flat = [](const baselines::Triangle3& t) {
    return baselines::Triangle2{Point2{t[0].x, t[0].y}, Point2{t[1].x, t[1].y}, Point2{t[2].x, t[2].y}};
  };
  return any_meet(triangles(a, nullptr, true), triangles(b, &at, true),
                  [&](const auto& s, const auto& t) { return baselines::triangles_meet(flat(s), flat(t)); });
}

}  // namespace bch::test
