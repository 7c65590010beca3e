// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <cmath>
#include <limits>

#include <bch/obstacles.hpp>

#include "kernel/distance/distance_input.hpp"
#include "kernel/obstacles/exit_moves.hpp"
#include "kernel/obstacles/query_input.hpp"
#include "kernel/obstacles/shape_tree.hpp"
#include "kernel/simd/tree_nodes.hpp"
#include "layout/base/rounding.hpp"

namespace bch {

using namespace detail;

namespace {

using Vector = ObstaclePlace::Vector;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns when a disc during its displacement touches a segment: the least t in [0, 1], or infinity. Every quotient is of lengths
/// that were not subtracted from each other where they are large.
double touch_time(const LocalSegment& segment, const Disc& disc, Vector displacement) noexcept {
  const double x = disc.x, y = disc.y, r = double{disc.radius} + segment.slack;
  if (segment.touches(x, y, double{disc.radius})) return 0;
  const double along = segment.along(x, y), across = segment.across(x, y);
  const double forward = segment.x * displacement.x + segment.y * displacement.y,
               aside = segment.x * displacement.y - segment.y * displacement.x;
  double time = infinity;
  const double towards = across > 0 ? -aside : aside, left = std::abs(across) - r;
  if (towards > 0 && left >= 0) {
    const double t = left / towards, at = along + t * forward;
    if (at >= segment.from && at <= segment.to) time = t;
  }
  const double square = forward * forward + aside * aside;
  for (const double end : {segment.from, segment.to}) {
    const double dx = end - along, dy = -across;
    const double near = dx * forward + dy * aside, cross = dx * aside - dy * forward;
    const double under_root = r * r * square - cross * cross;
    const double outside = dx * dx + dy * dy - r * r;
    if (near > 0 && under_root >= 0 && outside >= 0)
      time = std::min(time, outside / (near + std::sqrt(under_root)));
  }
  return time <= 1 ? time : infinity;
}

/// Returns whether nothing in a disc can touch a segment before a time.
bool passes(const LocalSegment& segment, const Disc& disc, Vector displacement, double time) noexcept {
  const double x = disc.x, y = disc.y, r = (double{disc.radius} + segment.slack) * (1 + 0x1p-20);
  const double along = segment.along(x, y), across = segment.across(x, y);
  const double forward = time * (segment.x * displacement.x + segment.y * displacement.y),
               aside = time * (segment.x * displacement.y - segment.y * displacement.x);
  return along + std::max(forward, 0.0) + r < segment.from ||
         along + std::min(forward, 0.0) - r > segment.to || across + std::min(aside, 0.0) > r ||
         across + std::max(aside, 0.0) < -r;
}

/// Finds when a body touches a segment, if that is before `best`.
void find_time(const PlacedBody& body, const LocalSegment& segment, Vector displacement, double& best) {
  const ShapeTree<void> own(body.shapes, body.root_index());
  const auto visit = [&](std::uint32_t node, OpenBlock& block) {
    const Discs discs = TreeNodes<void>::outer_discs(own.nodes, node, own.tree.stride);
    for (unsigned lane = 0; lane < block_width; ++lane) {
      const Disc disc{discs.x[lane], discs.y()[lane], discs.radius()[lane]};
      if (!(disc.x < __builtin_inff()) || passes(segment, disc, displacement, std::min(best, 1.0))) continue;
      if (node < leaf_bit)
        block.lanes |= 1u << lane;
      else
        best = std::min(best, touch_time(segment, disc, displacement));
    }
    return best <= 0;
  };
  if (best > 0) own.walk(visit, [](const OpenBlock& block) { return block.first(); });
}

/// Returns when a body during its displacement touches an obstacle, or infinity.
double impact(BodyQuery& query, const PlacedBody& body, Vector world_displacement) {
  const Vec2 centre = body.centre();
  query.near_body(body);
  if (query.is_inside(body)) return 0;
  const Vector displacement = body.place.turned_back(world_displacement.x, world_displacement.y);
  double best = infinity;
  for (const LocalSegment& segment :
       query.near().find_along(body.place, centre, body.outer_radius(), world_displacement))
    find_time(body, segment, displacement, best);
  return best;
}

}  // namespace

void penetration(const ShapeSet& shapes, const Agents& agents, const ObstacleSet& obstacles,
                 std::span<Penetration> out, const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  check_size({"penetration", "agent", agents.size()}, out.size(), "answers");
  const auto make = queries_of(shapes, agents, obstacles, wanted, "penetration");
  for_agents(agents.size(), make, 0, SearchMode::touching, [&](BodyQuery& query, std::uint32_t agent) {
    ExitMove longest;
    if (const PlacedBody* const body = query.body(agent)) longest = ExitMoves(query, *body).longest();
    const auto [depth, direction] = longest;
    out[agent] = {depth > 0 ? rounding::round_up(depth) : 0.0f, direction.x, direction.y};
  });
}

void time_of_impact(const ShapeSet& shapes, const Agents& agents, const Displacements& displacements,
                    const ObstacleSet& obstacles, std::span<float> times, const Implementation* wanted) {
  const FloatingPointStateGuard floats;
  require_valid({"time_of_impact", "agent", agents.size()}, displacements, times.size());
  require_on_ground({"time_of_impact", "agent", agents.size()}, displacements);
  const auto make = queries_of(shapes, agents, obstacles, wanted, "time_of_impact");
  double farthest = 0;
  for (std::size_t i = 0; i < agents.size(); ++i)
    farthest = std::max(farthest, std::abs(displacements.x[i]) + std::abs(displacements.y[i]));
  for_agents(agents.size(), make, farthest, SearchMode::touching, [&](BodyQuery& query, std::uint32_t agent) {
    const PlacedBody* const body = query.body(agent);
    times[agent] =
        body == nullptr
            ? static_cast<float>(infinity)
            : rounding::round_down(impact(query, *body, {displacements.x[agent], displacements.y[agent]}));
  });
}

}  // namespace bch
