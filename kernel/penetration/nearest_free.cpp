// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <bch/pairs.hpp>

#include "kernel/body/body_arguments.hpp"
#include "kernel/body/near_spheres.hpp"
#include "kernel/body/space_frame.hpp"
#include "kernel/penetration/spread_axes.hpp"
#include "kernel/runtime/kernels.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/rounding.hpp"
#include "layout/base/space_point.hpp"
#include "layout/body/sphere_rounding.hpp"

// The least displacement along a direction e after which A is free of B. A sphere of A and one of B, whose centre is c from the other's
// and whose radii sum to r, overlap where A has moved by t e with
//
//     |c - t e| < R = r + way_margin S,    m = c e,    n = e e,    t = (m -+ sqrt(m^2 - n (c c - R^2))) / n
//
// an open interval, in double from the floats that tests of spheres see. The answer is the least t >= 0 in none of these intervals. It is
// the end of one or 0, so it does not depend on how intervals are found.
//
// Sound: at t all centres are R apart or more. Of the displaced agents, collide() accepts spheres that are up to 30 u S apart beyond r
// (sphere_error). Rounding e to float turns A's way by 1.1 u t and changes its length by as much, rounding t up moves A by 2 u t, and
// t <= 2 S, because c and both radii are at most S in sum: 6.2 u S. Double loses 2^-50 of the squares, less than u S where R >= way_margin S.

namespace bch {

using namespace detail;

namespace {

constexpr double way_margin = 40 * rounding::unit_roundoff;
static_assert(way_margin >= (rounding::terms::sphere_error + 6.2 + 2) * rounding::unit_roundoff);

constexpr double never = std::numeric_limits<double>::infinity();

/// Holds the places of A, along a direction, at which two spheres overlap: none, or those between two.
struct Interval {
  double low = never, high = -never;
  bool holds(double t) const { return low < t && t < high; }
};

/// Holds two spheres: the vector from one centre to the other, and the least distance of the two that is free.
struct SpherePair {
  SpacePoint between;
  double radius;
  double gap() const { return dot(between, between) - radius * radius; }  ///< of squares

  Interval along(const SpacePoint& e) const {
    const double m = dot(between, e), n = dot(e, e), under_root = m * m - n * gap();
    if (!(under_root > 0)) return {};
    const double root = std::sqrt(under_root);
    return {(m - root) / n, (m + root) / n};
  }
};

/// Finds ways of a body A out of a body B, in A's frame.
class WayOut {
 public:
  WayOut(const float* a, const float* b, const SpaceFrame& frame, std::vector<SpherePair>& memory)
      : spheres_(a, b, frame), first_(memory) {
    const double reaches = double{header_of(a).reach} + double{header_of(b).reach};
    widening_ = way_margin * reaches, slack_ = rounding::bound_margin * reaches + widening_;
    first_.clear();
    visit({}, [&](const SpherePair& spheres) {
      if (spheres.gap() <= 0) first_.push_back(spheres);
    });
  }

  /// Returns a place that the answer along a direction is not before.
  double bound(const SpacePoint& e) const {
    constexpr double touching =
        -0x1p-30;  // of the square of a radius: rounding decides on which side of 0 an interval ends
    double most = 0;
    for (const SpherePair& spheres : first_)
      if (spheres.gap() < touching * spheres.radius * spheres.radius)
        most = std::max(most, dot(spheres.between, e));
    return most / dot(e, e);
  }

  /// Returns the first free place along a direction, or something above a limit where that is less.
  double find(const SpacePoint& e, double limit) {
    double place = 0, next = 0;
    const auto leave = [&](const SpherePair& spheres) {
      const Interval interval = spheres.along(e);
      if (interval.holds(place)) next = std::max(next, interval.high);
    };
    for (const SpherePair& spheres : first_) leave(spheres);
    while (place < next && next <= limit) {
      place = next;
      visit(place * e, leave);
    }
    return next;
  }

 private:
  /// Calls use() for spheres that may overlap where A has moved, and for some others.
  template <class Use>
  void visit(const SpacePoint& moved, const Use& use) {
    spheres_.visit(
        [&](const Cylinder& a, const Cylinder& b) {
          const double x = b.x - a.x - moved.x, y = b.y - a.y - moved.y,
                       radius = a.radius + b.radius + slack_;
          return b.bottom - a.top <= slack_ && a.bottom - b.top <= slack_ && x * x + y * y <= radius * radius;
        },
        [&](std::uint32_t, std::uint32_t, const Sphere& a, const Sphere& b) {
          use({{double{b.x} - double{a.x}, double{b.y} - double{a.y}, double{b.z} - double{a.z}},
               double{a.radius} + double{b.radius} + widening_});
        });
  }

  NearSpheres spheres_;
  double widening_, slack_;
  std::vector<SpherePair>& first_;  ///< those of A where it is
};

/// Returns the best way of a pair that collides, as seen from the agent with the lower index.
Penetration best_way(const BodySetView& view, const Agents& agents, std::uint32_t a, std::uint32_t b,
                     const Axes& axes, std::vector<SpherePair>& memory) {
  struct Way {
    double x, y;
    SpacePoint e;
    double bound;
  };
  const SpaceFrame frame(agents, a, b);
  WayOut out(view.record(agents.shape[a]), view.record(agents.shape[b]), frame, memory);
  std::array<Way, most_directions> ways;
  std::array<std::uint32_t, most_directions> order;
  const std::uint32_t count = 2 * axes.count;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double sign = i % 2 == 0 ? 1 : -1, x = sign * axes.x[i / 2], y = sign * axes.y[i / 2];
    const SpacePoint e = frame.way(x, y, 0);
    ways[i] = {x, y, e, out.bound(e)}, order[i] = i;
  }
  std::sort(order.begin(), order.begin() + count, [&](std::uint32_t i, std::uint32_t j) {
    return ways[i].bound != ways[j].bound ? ways[i].bound < ways[j].bound : i < j;
  });
  double least = never;
  std::uint32_t best = 0;
  for (const std::uint32_t i : std::span(order).first(count)) {
    if (ways[i].bound > least) break;
    const double place = out.find(ways[i].e, least);
    if (place < least || (place == least && i < best)) least = place, best = i;
  }
  return {rounding::round_up(least), ways[best].x, ways[best].y};
}

constexpr std::size_t pairs_at_once = 64;

}  // namespace

void nearest_free(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                  std::uint32_t directions, std::span<Penetration> out, const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  require_as_many({"nearest_free", "pair", pairs.size()}, out.size(), "answers");
  const Implementation& implementation = chosen(wanted, "nearest_free");
  const BodySetView& view = bodies.view();
  require_valid(implementation, view.ground, agents, pairs);
  const Axes axes = spread_axes("nearest_free", directions);
  for_pair_ranges(pairs.size(), pairs_at_once, [&](std::size_t begin, std::size_t size) {
    std::vector<SpherePair> memory;
    std::uint8_t hits[pairs_at_once];
    BodyArguments arguments{arguments_for(view.ground, agents, pairs.subspan(begin, size)), &view};
    arguments.pairs.codes = hits;
    implementation.kernels->run_bodies(arguments, 0, size);
    for (std::size_t k = 0; k < size; ++k) {
      const auto [first, second] = pairs[begin + k];
      const auto [a, b] = std::minmax(first, second);
      Penetration way = hits[k] != 0 ? best_way(view, agents, a, b, axes, memory) : Penetration{0, 1, 0};
      if (second < first) way.x = -way.x, way.y = -way.y;
      out[begin + k] = way;
    }
  });
}

}  // namespace bch
