// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/stability_trial.hpp"

#include <algorithm>
#include <cmath>

#include "baselines/oracle.hpp"

namespace bch::bench {
namespace {

using baselines::ExactDisc;
using baselines::Quad;
using baselines::QuadVector;

struct DoubleDisc {
  double x, y, radius;
};

std::vector<DoubleDisc> in_double(std::span<const ExactDisc> discs) {
  std::vector<DoubleDisc> rounded;
  for (const ExactDisc& disc : discs)
    rounded.push_back({static_cast<double>(disc.centre.x), static_cast<double>(disc.centre.y),
                       static_cast<double>(disc.radius)});
  return rounded;
}

std::vector<ExactDisc> posed(const PlacedSpecimen& placed) {
  const QuadVector rotation = baselines::quad_rotation(placed.heading);
  std::vector<ExactDisc> discs;
  for (const ExactDisc& disc : placed.specimen->discs) discs.push_back(disc.posed(rotation));
  return discs;
}

QuadVector shift(const PlacedSpecimen& a, const PlacedSpecimen& b) {
  return {Quad{b.x} - Quad{a.x}, Quad{b.y} - Quad{a.y}};
}

/// Two discs that touch when b has moved by `distance` along a direction, the last ones to do so; `along` and `across`
/// are the direction and what is to its left as the line of their centres has them.
struct LastContact {
  std::size_t i = 0, j = 0;
  double distance = -1e300;
  double along = 1, across = 0;
};

LastContact last_contact(std::span<const DoubleDisc> a, std::span<const DoubleDisc> b, double x, double y) {
  LastContact last;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double dx = a[i].x - b[j].x, dy = a[i].y - b[j].y, radii = a[i].radius + b[j].radius;
      const double across = y * dx - x * dy;  // of b's centre from a's
      const double square = radii * radii - across * across;
      if (!(square >= 0)) continue;
      const double along = std::sqrt(square), distance = dx * x + dy * y + along;
      if (distance > last.distance) last = {i, j, distance, along / radii, across / radii};
    }
  return last;
}

/// The plain test: discs in the world's coordinates, everything in one type.
template <class Real>
class PlainDiscs {
 public:
  explicit PlainDiscs(const PlacedSpecimen& placed) {
    const QuadVector turn = baselines::quad_rotation(static_cast<double>(static_cast<Real>(placed.heading)));
    const Real c = static_cast<Real>(turn.x), s = static_cast<Real>(turn.y);
    const Real at_x = static_cast<Real>(placed.x), at_y = static_cast<Real>(placed.y);
    for (const ExactDisc& disc : placed.specimen->discs) {
      const Real x = static_cast<Real>(disc.centre.x), y = static_cast<Real>(disc.centre.y);
      discs_.push_back({at_x + (c * x - s * y), at_y + (s * x + c * y), static_cast<Real>(disc.radius)});
    }
  }

  bool hit(const PlainDiscs& other) const {
    for (const Disc& p : discs_)
      for (const Disc& q : other.discs_) {
        const Real dx = q.x - p.x, dy = q.y - p.y, radii = p.radius + q.radius;
        if (dx * dx + dy * dy <= radii * radii) return true;
      }
    return false;
  }

 private:
  struct Disc {
    Real x, y, radius;
  };
  std::vector<Disc> discs_;
};

/// The part of an outline that goes far along a direction, segment by segment, where there is too much of it to look at all.
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

baselines::Oracle oracle(const PlacedSpecimen& a, const PlacedSpecimen& b, double x, double y) {
  const std::uint32_t shape[] = {0, 1};
  const double at_x[] = {a.x, b.x}, at_y[] = {a.y, b.y}, heading[] = {a.heading, b.heading};
  return {front(a.specimen->geometry, a, x, y), front(b.specimen->geometry, b, -x, -y),
          baselines::exact_placement({shape, at_x, at_y, heading}, 0, 1)};
}

}  // namespace

Trial::Trial(const PlacedSpecimen& first, const PlacedSpecimen& second)
    : a(first), b(second), discs_a_(posed(first)), discs_b_(posed(second)) {}

void Trial::put_discs_in_contact(double x, double y, const std::function<double(double)>& gap) {
  const LastContact last = last_contact(in_double(discs_a_), in_double(discs_b_), x, y);
  const ExactDisc &p = discs_a_[last.i], &q = discs_b_[last.j];
  const QuadVector line{x * last.along - y * last.across, y * last.along + x * last.across};
  const Quad radii = p.radius + q.radius;
  const Quad stretch = (radii + gap(static_cast<double>(radii))) / baselines::square_root(square(line));
  const QuadVector between = p.centre - q.centre;
  b.x = static_cast<double>(Quad{a.x} + between.x + line.x * stretch);
  b.y = static_cast<double>(Quad{a.y} + between.y + line.y * stretch);
}

void Trial::put_outlines_in_contact(double x, double y, double gap) {
  const double far = 1.01 * reaches();
  PlacedSpecimen away = b;
  away.x = a.x + far * x, away.y = a.y + far * y;
  // In a's frame it is a that moves.
  const QuadVector way = turned_back(baselines::quad_rotation(a.heading), {far * x, far * y});
  const long double time =
      oracle(a, away, x, y).contact_time(static_cast<long double>(way.x), static_cast<long double>(way.y));
  const double distance = time <= 1 ? static_cast<double>(far * (1 - time)) : 0;
  b.x = a.x + (distance + gap) * x;
  b.y = a.y + (distance + gap) * y;
}

double Trial::gap() const {
  const QuadVector at = shift(a, b);
  const double x = static_cast<double>(at.x), y = static_cast<double>(at.y);
  const auto discs_a = in_double(discs_a_), discs_b = in_double(discs_b_);
  const auto rough = [&](std::size_t i, std::size_t j) {
    const double dx = x + discs_b[j].x - discs_a[i].x, dy = y + discs_b[j].y - discs_a[i].y;
    return std::sqrt(dx * dx + dy * dy) - (discs_a[i].radius + discs_b[j].radius);
  };
  double least = 1e300;
  for (std::size_t i = 0; i < discs_a.size(); ++i)
    for (std::size_t j = 0; j < discs_b.size(); ++j) least = std::min(least, rough(i, j));
  // What double may have mistaken for it is asked again.
  const double doubt = 1e-14 * (reaches() + std::abs(x) + std::abs(y));
  if (std::abs(least) > 1000 * doubt) return least;
  Quad exact = 1e300;
  for (std::size_t i = 0; i < discs_a.size(); ++i)
    for (std::size_t j = 0; j < discs_b.size(); ++j) {
      if (rough(i, j) > least + doubt) continue;
      const ExactDisc &p = discs_a_[i], &q = discs_b_[j];
      exact =
          std::min(exact, baselines::square_root(square(at + q.centre - p.centre)) - (p.radius + q.radius));
    }
  return static_cast<double>(exact);
}

bool Trial::outlines_meet() const {
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  return length > 0 ? oracle(a, b, dx / length, dy / length).cross() : oracle(a, b, 1, 0).cross();
}

bool Trial::plain_float_hit() const {
  return PlainDiscs<float>(a).hit(PlainDiscs<float>(b));
}

bool Trial::plain_double_hit() const {
  return PlainDiscs<double>(a).hit(PlainDiscs<double>(b));
}

}  // namespace bch::bench
