// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/stability/trial.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "baselines/oracle.hpp"

namespace bch::bench {
namespace {

using baselines::ExactCut;
using baselines::ExactDisc;
using baselines::Quad;
using baselines::QuadVector;

struct DoubleDisc {
  double x, y, radius;
};

std::vector<DoubleDisc> in_double(const ExactCut& cut) {
  std::vector<DoubleDisc> rounded;
  for (const ExactDisc& disc : cut.discs)
    rounded.push_back({static_cast<double>(disc.centre.x), static_cast<double>(disc.centre.y),
                       static_cast<double>(disc.radius)});
  return rounded;
}

ExactCut posed(const PlacedSpecimen& placed) {
  return placed.specimen->discs.posed(baselines::quad_rotation(placed.heading));
}

/// What is said of every two discs, one of either cut or above it, put together with what is said of the pairs of all discs
/// above the two.
template <class Value>
class PairsWithAbove {
 public:
  /// Computes all values. `of(i, j)`: of two discs; `both(v, w)` puts together.
  template <class Of, class Both>
  PairsWithAbove(const ExactCut& a, const ExactCut& b, Of of, Both both) : a_(a), b_(b) {
    // Who is above comes first.
    for (std::size_t i = 0; i < a.discs.size(); ++i)
      for (std::size_t j = 0; j < b.discs.size(); ++j) {
        Value value = of(i, j);
        if (i > 0) value = both(value, (*this)(a.above[i], j));
        if (j > 0) value = both(value, (*this)(i, b.above[j]));
        values_.push_back(value);
      }
  }

  const Value& operator()(std::size_t i, std::size_t j) const { return values_[i * b_.discs.size() + j]; }
  /// Returns the value of two discs of the cuts that is the first by an order.
  template <class Less>
  const Value& least(Less less) const {
    const Value* found = &(*this)(a_.cut[0], b_.cut[0]);
    for (const std::uint32_t i : a_.cut)
      for (const std::uint32_t j : b_.cut)
        if (less((*this)(i, j), *found)) found = &(*this)(i, j);
    return *found;
  }

 private:
  const ExactCut &a_, &b_;
  std::vector<Value> values_;
};

QuadVector shift(const PlacedSpecimen& a, const PlacedSpecimen& b) {
  return {Quad{b.x} - Quad{a.x}, Quad{b.y} - Quad{a.y}};
}

/// The interval where two discs, and all above them, overlap as b moves along a direction: from `begin` to
/// `end`, metres, if that is not less. Discs i and j are those that separate there. `along` and `across` are
/// the components of the line of their centres along the direction and to its left.
struct OverlapInterval {
  double begin, end;
  std::size_t i, j;
  double along, across;
  bool some() const { return begin <= end; }
};

OverlapInterval common(const OverlapInterval& one, const OverlapInterval& other) {
  OverlapInterval both = other.end < one.end ? other : one;
  both.begin = std::max(one.begin, other.begin);
  return both;
}

bool ends_later(const OverlapInterval& one, const OverlapInterval& other) {
  return one.some() && (!other.some() || one.end > other.end);
}

/// The last two of the cuts to overlap as b moves along (x, y). Where they do is said from a's agent to b's.
OverlapInterval last_overlap(const ExactCut& cut_a, const ExactCut& cut_b, double x, double y) {
  const auto a = in_double(cut_a), b = in_double(cut_b);
  // The line goes through where the centres of two discs of the cuts are one point, so that some discs overlap on it.
  const DoubleDisc &p = a[cut_a.cut[0]], &q = b[cut_b.cut[0]];
  const double from_x = p.x - q.x, from_y = p.y - q.y;
  const auto overlap = [&](std::size_t i, std::size_t j) -> OverlapInterval {
    const double dx = a[i].x - b[j].x - from_x, dy = a[i].y - b[j].y - from_y,
                 radii = a[i].radius + b[j].radius;
    const double across = y * dx - x * dy;  // of b's centre from a's
    const double square = radii * radii - across * across;
    if (!(square >= 0)) return {HUGE_VAL, -HUGE_VAL, i, j, 1, 0};
    const double along = std::sqrt(square), middle = dx * x + dy * y;
    return {middle - along, middle + along, i, j, along / radii, across / radii};
  };
  OverlapInterval last = PairsWithAbove<OverlapInterval>(cut_a, cut_b, overlap, common).least(ends_later);
  const double start = from_x * x + from_y * y;
  last.begin += start, last.end += start;
  return last;
}

/// Returns the largest gap of two discs and all above them, as far as they count; exactly. `at` leads from
/// a's agent to b's.
template <class Counts>
Quad largest_gap(const ExactCut& a, std::uint32_t disc_a, const ExactCut& b, std::uint32_t disc_b,
                 QuadVector at, Counts counts) {
  Quad largest = -1e300;
  const auto path_b = b.path(disc_b);
  for (const std::uint32_t i : a.path(disc_a))
    for (const std::uint32_t j : path_b) {
      if (!counts(i, j)) continue;
      const ExactDisc &p = a.discs[i], &q = b.discs[j];
      largest =
          std::max(largest, baselines::square_root(square(at + q.centre - p.centre)) - (p.radius + q.radius));
    }
  return largest;
}

/// Returns Trial::gap() of two cuts.
Quad gap_of_discs(const ExactCut& a, const ExactCut& b, QuadVector at, double max_extents) {
  const double x = static_cast<double>(at.x), y = static_cast<double>(at.y);
  const auto discs_a = in_double(a), discs_b = in_double(b);
  const auto rough = [&](std::size_t i, std::size_t j) {
    const double dx = x + discs_b[j].x - discs_a[i].x, dy = y + discs_b[j].y - discs_a[i].y;
    return std::sqrt(dx * dx + dy * dy) - (discs_a[i].radius + discs_b[j].radius);
  };
  const auto larger = [](double one, double other) { return std::max(one, other); };
  const PairsWithAbove<double> gaps(a, b, rough, larger);
  const double least = gaps.least(std::less<>());
  // What double may have mistaken for it is asked again.
  const double doubt = 1e-14 * (max_extents + std::abs(x) + std::abs(y));
  if (std::abs(least) > 1000 * doubt) return least;
  Quad exact = 1e300;
  for (const std::uint32_t i : a.cut)
    for (const std::uint32_t j : b.cut) {
      if (gaps(i, j) > least + 2 * doubt) continue;
      const auto counts = [&](std::uint32_t p, std::uint32_t q) {
        return rough(p, q) >= gaps(i, j) - 2 * doubt;
      };
      exact = std::min(exact, largest_gap(a, i, b, j, at, counts));
    }
  return exact;
}

/// Returns how far the heights of two agents are apart, metres; exactly.
Quad gap_of_heights(const PlacedSpecimen& a, const PlacedSpecimen& b) {
  const Heights of_a = a.specimen->shape.heights, of_b = b.specimen->shape.heights;
  const Quad dz = Quad{b.z} - Quad{a.z};
  return std::max(Quad{of_b.bottom} + dz - Quad{of_a.top}, Quad{of_a.bottom} - Quad{of_b.top} - dz);
}

/// The plain test: discs in the world's coordinates, everything in one type.
template <class Real>
class PlainDiscs {
 public:
  explicit PlainDiscs(const PlacedSpecimen& placed) : cut_(placed.specimen->discs) {
    const QuadVector turn = baselines::quad_rotation(static_cast<double>(static_cast<Real>(placed.heading)));
    const Real c = static_cast<Real>(turn.x), s = static_cast<Real>(turn.y);
    const Real at_x = static_cast<Real>(placed.x), at_y = static_cast<Real>(placed.y);
    for (const ExactDisc& disc : cut_.discs) {
      const Real x = static_cast<Real>(disc.centre.x), y = static_cast<Real>(disc.centre.y);
      discs_.push_back({at_x + (c * x - s * y), at_y + (s * x + c * y), static_cast<Real>(disc.radius)});
    }
  }

  bool hit(const PlainDiscs& other) const {
    const auto apart = [&](std::size_t i, std::size_t j) -> int {
      const Disc &p = discs_[i], &q = other.discs_[j];
      const Real dx = q.x - p.x, dy = q.y - p.y, radii = p.radius + q.radius;
      return dx * dx + dy * dy <= radii * radii ? 0 : 1;
    };
    const auto either = [](int one, int another) { return one | another; };
    return PairsWithAbove<int>(cut_, other.cut_, apart, either).least(std::less<>()) == 0;
  }

 private:
  struct Disc {
    Real x, y, radius;
  };
  const ExactCut& cut_;
  std::vector<Disc> discs_;
};

template <class Real>
bool plain_heights_meet(const PlacedSpecimen& a, const PlacedSpecimen& b) {
  const auto at = [](const PlacedSpecimen& placed, float height) {
    return static_cast<Real>(static_cast<Real>(placed.z) + static_cast<Real>(height));
  };
  const Heights of_a = a.specimen->shape.heights, of_b = b.specimen->shape.heights;
  return at(a, of_a.bottom) <= at(b, of_b.top) && at(b, of_b.bottom) <= at(a, of_a.top);
}

template <class Real>
bool plain_hit(const PlacedSpecimen& a, const PlacedSpecimen& b) {
  return plain_heights_meet<Real>(a, b) && PlainDiscs<Real>(a).hit(PlainDiscs<Real>(b));
}

/// The part of an outline that goes far along a direction, segment by segment, where there is too much of it to examine all.
Outline front(const Outline& outline, const PlacedSpecimen& placed, double x, double y) {
  constexpr std::size_t most = 200;  // points
  if (outline.points.size() <= most) return outline;
  const QuadVector turn = baselines::quad_rotation(placed.heading);
  const double c = static_cast<double>(turn.x), s = static_cast<double>(turn.y);
  const auto extent = [&](Vec2 p) {
    const double px = static_cast<double>(p.x), py = static_cast<double>(p.y);
    return (c * px - s * py) * x + (s * px + c * py) * y;
  };
  std::vector<double> extents;
  for (const Vec2 p : outline.points) extents.push_back(extent(p));
  std::vector<double> sorted = extents;
  std::nth_element(sorted.begin(), sorted.begin() + most / 2, sorted.end(), std::greater<>());
  Outline part;
  for (std::size_t k = 0; k < outline.contours(); ++k) {
    const std::size_t begin = outline.contour_begin[k], end = outline.contour_begin[k + 1];
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t next = i + 1 < end ? i + 1 : begin;
      if (extents[i] < sorted[most / 2] || extents[next] < sorted[most / 2]) continue;
      part.points.insert(part.points.end(), {outline.points[i], outline.points[next]});
      part.contour_begin.push_back(static_cast<std::uint32_t>(part.points.size()));
    }
  }
  return part;
}

/// Makes the oracle of two agents, of which (x, y) leads from a to b.
baselines::Oracle oracle(const PlacedSpecimen& a, const PlacedSpecimen& b, double x, double y) {
  const std::uint32_t shape[] = {0, 1};
  const double at_x[] = {a.x, b.x}, at_y[] = {a.y, b.y}, heading[] = {a.heading, b.heading};
  return {front(a.specimen->geometry, a, x, y), front(b.specimen->geometry, b, -x, -y),
          baselines::exact_placement({shape, at_x, at_y, heading}, 0, 1)};
}

}  // namespace

Trial::Trial(const PlacedSpecimen& first, const PlacedSpecimen& second)
    : a(first), b(second), cut_a_(posed(first)), cut_b_(posed(second)) {}

void Trial::store_discs_in_contact(double x, double y, const std::function<double(double)>& gap) {
  const OverlapInterval last = last_overlap(cut_a_, cut_b_, x, y);
  const ExactDisc &p = cut_a_.discs[last.i], &q = cut_b_.discs[last.j];
  const QuadVector line{x * last.along - y * last.across, y * last.along + x * last.across};
  const Quad radii = p.radius + q.radius;
  const Quad stretch = (radii + gap(static_cast<double>(radii))) / baselines::square_root(square(line));
  const QuadVector between = p.centre - q.centre;
  b.x = static_cast<double>(Quad{a.x} + between.x + line.x * stretch);
  b.y = static_cast<double>(Quad{a.y} + between.y + line.y * stretch);
}

void Trial::store_outlines_in_contact(double x, double y, double gap) {
  const double far = 1.01 * max_extents();
  PlacedSpecimen away = b;
  away.x = a.x + far * x, away.y = a.y + far * y;
  // In a's frame it is a that moves.
  const QuadVector displacement = turned_back(baselines::quad_rotation(a.heading), {far * x, far * y});
  const long double time =
      oracle(a, away, x, y)
          .time_of_impact(static_cast<long double>(displacement.x), static_cast<long double>(displacement.y));
  const double distance = time <= 1 ? static_cast<double>(far * (1 - time)) : 0;
  b.x = a.x + (distance + gap) * x;
  b.y = a.y + (distance + gap) * y;
}

void Trial::put_on_top(double gap) {
  const Quad between = Quad{a.specimen->shape.heights.top} - Quad{b.specimen->shape.heights.bottom};
  b.z = static_cast<double>(Quad{a.z} + between + Quad{gap});
}

double Trial::gap() const {
  return static_cast<double>(
      std::max(gap_of_discs(cut_a_, cut_b_, shift(a, b), max_extents()), gap_of_heights(a, b)));
}

bool Trial::outlines_meet() const {
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  const double x = length > 0 ? dx / length : 1, y = length > 0 ? dy / length : 0;
  return oracle(a, b, x, y).cross();
}

bool Trial::plain_float_hit() const {
  return plain_hit<float>(a, b);
}

bool Trial::plain_double_hit() const {
  return plain_hit<double>(a, b);
}

}  // namespace bch::bench
