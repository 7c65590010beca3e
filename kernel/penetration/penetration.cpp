// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/pairs.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

#include "kernel/penetration/agent_discs.hpp"
#include "kernel/penetration/spread_axes.hpp"
#include "kernel/runtime/pair_heights.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/runtime/task_ranges.hpp"
#include "layout/base/floating_point_state.hpp"
#include "layout/base/heading.hpp"
#include "layout/base/number_class.hpp"
#include "layout/base/rounding.hpp"
#include "layout/body/body_record.hpp"
#include "layout/body/sphere_rounding.hpp"
#include "layout/format/cut_discs.hpp"

namespace bch {

using namespace detail;

namespace {

constexpr std::size_t penetration_grain = 128;  ///< pairs a task, up to 10 us each

/// Rounding, in the notation of layout/base/rounding.hpp, all as lengths. An axis, in double within 1e-9 of a unit vector,
/// is turned into the agent's frame and rounded to float there: 0.75 u. An extent along it is off by 0.75 u P for that,
/// 1.42 u P for the products, u P and 2 u P for the sums: 5.2 u P. The rest is done in double. For A's discs not to pass
/// collide()'s test with B's, they have to be 23 u S apart, or spheres 30 u S: 35.2 u S together. And an axis falls short of a unit vector by
/// 4e-10, or by 0.75 u more where the caller rounds it to float. Tests see the margin; only the proof needs the lengthening.
constexpr double margin = 40 * rounding::unit_roundoff;
constexpr double extent_error = 5.2;  // in units of u
static_assert(extent_error >= 0.75 + rounding::terms::root_2 + 1 + 2);
static_assert(margin >= (extent_error + rounding::terms::query_error) * rounding::unit_roundoff);
static_assert(margin >= (extent_error + rounding::terms::sphere_error) * rounding::unit_roundoff);
constexpr double lengthening = 1 + 4 * rounding::unit_roundoff;
static_assert(lengthening - 1 >= 0.75 * rounding::unit_roundoff + 4e-10);

/// The intervals that an agent takes along axes, about its position.
struct Extents {
  float low[max_axes], high[max_axes];
  double max_extent;  ///< as in rounding.hpp
};

/// How far A has to move along each axis, or against it, until no disc of B is in its way.
struct Depths {
  double along[max_axes], against[max_axes];
  double max_extent;  ///< of both

  explicit Depths(std::uint32_t axes) {
    std::fill_n(along, axes, -std::numeric_limits<double>::infinity());
    std::fill_n(against, axes, -std::numeric_limits<double>::infinity());
    max_extent = 0;
  }
};

/// The spheres of an agent as seen from above.
class AgentSpheres {
 public:
  AgentSpheres(const BodySetView& bodies, const Agents& agents, std::uint32_t agent) noexcept
      : AgentSpheres(bodies.record(agents.shape[agent])) {}

  const CutDiscs discs;
  const float max_extent;

 private:
  explicit AgentSpheres(const float* record) noexcept
      : discs{x_, y_, radius_, header_of(record).sphere_count}, max_extent(header_of(record).max_extent) {
    for (std::uint32_t slot = 0; slot < discs.count; ++slot) {
      const Sphere sphere = sphere_of(record, slot);
      x_[slot] = sphere.x, y_[slot] = sphere.y, radius_[slot] = sphere.radius;
    }
  }

  float x_[max_spheres], y_[max_spheres], radius_[max_spheres];
};

/// A query of shapes, whose agents have discs, or of bodies.
template <class Set, class Discs>
struct Query {
  const Set& set;
  const Agents& agents;
  const Implementation& implementation;
  const Arguments arguments;

  void measure(std::uint32_t agent, const Axes& axes, Extents& extents) const noexcept;
  void compare(Pair pair, const Axes& axes, const Extents& a, const Extents& b,
               Depths& depths) const noexcept;
};

template <class Set, class Discs>
void Query<Set, Discs>::measure(std::uint32_t agent, const Axes& axes, Extents& extents) const noexcept {
  const Rotation turn = rotation(agents.heading[agent]);
  float x[max_axes], y[max_axes];
  for (std::uint32_t i = 0; i < axes.count; ++i) {
    x[i] = static_cast<float>(turn.cosine * axes.x[i] + turn.sine * axes.y[i]);
    y[i] = static_cast<float>(turn.cosine * axes.y[i] - turn.sine * axes.x[i]);
  }
  const Discs of(set, agents, agent);
  implementation.kernels->extents(of.discs, x, y, axes.count, extents.low, extents.high);
  extents.max_extent = double{of.max_extent};
}

/// `a` belongs to the lower index, whatever the pair's order: so that both orders agree.
template <class Set, class Discs>
void Query<Set, Discs>::compare(Pair pair, const Axes& axes, const Extents& a, const Extents& b,
                                Depths& depths) const noexcept {
  const auto [low, high] = std::minmax(pair.first, pair.second);
  const double dx = agents.x[high] - agents.x[low], dy = agents.y[high] - agents.y[low];
  for (std::uint32_t i = 0; i < axes.count; ++i) {
    const double between = dx * axes.x[i] + dy * axes.y[i];
    const double along = static_cast<double>(b.high[i]) - static_cast<double>(a.low[i]) + between;
    const double against = static_cast<double>(a.high[i]) - static_cast<double>(b.low[i]) - between;
    depths.along[i] = std::max(depths.along[i], along);
    depths.against[i] = std::max(depths.against[i], against);
  }
  depths.max_extent = std::max(depths.max_extent, a.max_extent + b.max_extent);
}

Penetration answer_of(Pair pair, const Axes& axes, bool both_ways, const Depths& depths) noexcept {
  double least = std::numeric_limits<double>::infinity(), x = 0, y = 0;
  const auto offer = [&](double depth, double along_x, double along_y) {
    if (depth < least) least = depth, x = along_x, y = along_y;
  };
  for (std::uint32_t i = 0; i < axes.count; ++i) {
    offer(depths.along[i], axes.x[i], axes.y[i]);
    if (both_ways) offer(depths.against[i], -axes.x[i], -axes.y[i]);
  }
  if (pair.second < pair.first) x = -x, y = -y;
  const double depth = (least + margin * depths.max_extent) * lengthening;
  return {depth > 0 ? rounding::round_up(depth) : 0.0f, x, y};
}

/// Checks the arguments of a query. `ground` is the set's discs, of bodies those that hold them.
template <class Discs, class Set>
Query<Set, Discs> checked_query(const Set& set, const ShapeSetView& ground, const Agents& agents,
                                std::span<const Pair> pairs, std::span<Penetration> out,
                                const Implementation* wanted) {
  check_size({"penetration", "pair", pairs.size()}, out.size(), "answers");
  const Implementation& implementation = chosen(wanted, "penetration");
  require_valid(implementation, ground, agents, pairs);
  return {set, agents, implementation, arguments_for(ground, agents, {})};
}

auto query_of(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
              std::span<Penetration> out, const Implementation* wanted) {
  return checked_query<AgentDiscs>(shapes.view(), shapes.view(), agents, pairs, out, wanted);
}

auto query_of(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
              std::span<Penetration> out, const Implementation* wanted) {
  return checked_query<AgentSpheres>(bodies.view(), bodies.view().ground, agents, pairs, out, wanted);
}

void require_directions(std::span<const Vec2> directions, std::size_t pairs) {
  check_size({"penetration", "pair", pairs}, directions.size(), "directions");
  for (std::size_t i = 0; i < pairs; ++i) {
    const auto [x, y] = directions[i];
    if (is_finite(x) && is_finite(y) && (x != 0 || y != 0)) continue;
    std::ostringstream message;
    message << "penetration: pair " << i << ": expected a finite direction other than (0, 0), found (" << x
            << ", " << y << ")";
    throw std::invalid_argument(message.str());
  }
}

template <class Set>
void measure_along(const Set& set, const Agents& agents, std::span<const Pair> pairs,
                   std::span<const Vec2> directions, std::span<Penetration> out,
                   const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  const auto query = query_of(set, agents, pairs, out, wanted);
  require_directions(directions, pairs.size());
  for_pair_ranges(pairs.size(), penetration_grain, [&](std::size_t begin, std::size_t size) {
    Axes axis;
    Extents a, b;
    axis.count = 1;
    for (std::size_t i = begin; i < begin + size; ++i) {
      const auto [low, high] = std::minmax(pairs[i].first, pairs[i].second);
      const double x = directions[i].x, y = directions[i].y;
      const double length = std::sqrt(x * x + y * y) * (pairs[i].second < pairs[i].first ? -1 : 1);
      axis.x[0] = x / length, axis.y[0] = y / length;
      Depths depths(axis.count);
      if (heights_meet(query.arguments, pairs[i])) {
        query.measure(low, axis, a);
        query.measure(high, axis, b);
        query.compare(pairs[i], axis, a, b, depths);
      }
      out[i] = answer_of(pairs[i], axis, false, depths);
    }
  });
}

template <class Set>
void measure_least(const Set& set, const Agents& agents, std::span<const Pair> pairs,
                   std::uint32_t directions, std::span<Penetration> out, const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  const auto query = query_of(set, agents, pairs, out, wanted);
  const Axes axes = spread_axes("penetration", directions);
  for_pair_ranges(pairs.size(), penetration_grain, [&](std::size_t begin, std::size_t size) {
    Extents a, b;
    std::size_t measured = agents.size();
    for (std::size_t i = begin; i < begin + size; ++i) {
      const auto [low, high] = std::minmax(pairs[i].first, pairs[i].second);
      Depths depths(axes.count);
      if (heights_meet(query.arguments, pairs[i])) {
        // Pairs often come agent by agent.
        if (measured != low) query.measure(low, axes, a);
        measured = low;
        query.measure(high, axes, b);
        query.compare(pairs[i], axes, a, b, depths);
      }
      out[i] = answer_of(pairs[i], axes, true, depths);
    }
  });
}

}  // namespace

void penetration_along(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                       std::span<const Vec2> directions, std::span<Penetration> out,
                       const Implementation* wanted) {
  measure_along(shapes, agents, pairs, directions, out, wanted);
}

void penetration_along(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                       std::span<const Vec2> directions, std::span<Penetration> out,
                       const Implementation* wanted) {
  measure_along(bodies, agents, pairs, directions, out, wanted);
}

void penetration(const ShapeSet& shapes, const Agents& agents, std::span<const Pair> pairs,
                 std::uint32_t directions, std::span<Penetration> out, const Implementation* wanted) {
  measure_least(shapes, agents, pairs, directions, out, wanted);
}

void penetration(const BodySet& bodies, const Agents& agents, std::span<const Pair> pairs,
                 std::uint32_t directions, std::span<Penetration> out, const Implementation* wanted) {
  measure_least(bodies, agents, pairs, directions, out, wanted);
}

}  // namespace bch
