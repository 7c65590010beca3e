// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/penetration/free_sources.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/body/body_hits.hpp"
#include "kernel/collide/answer.hpp"
#include "kernel/penetration/agent_discs.hpp"
#include "kernel/penetration/free_bodies.hpp"
#include "kernel/runtime/pair_heights.hpp"
#include "kernel/runtime/pair_validation.hpp"
#include "kernel/simd/leaf_segments.hpp"
#include "kernel/simd/segment_test.hpp"
#include "layout/base/rounding.hpp"
#include "layout/body/body_record.hpp"
#include "layout/body/sphere_rounding.hpp"
#include "layout/format/cut_discs.hpp"

namespace bch::detail {
namespace {

/// Sound, in units of u S: collide() of the displaced agents accepts spheres that are up to 30 apart (sphere_error), discs up to 23
/// (query_error), and segments up to the margins of both shapes and (segment_place). Two that collide have |d| <= |a| + |b| + R and so |m| <=
/// 2 |a| + 2 |b| + R. A way is t = m + s <= 2 (|a| + r_A + |b| + r_B) <= 2.83 S, because |a|^2 + r_A^2 <= P_A^2. Products and their sums put m
/// and w off by 3 each, differences by 1 each, z by 1, so the distance by 7; rounding e to float turns A's way by 1.1 t and makes it shorter
/// by as much; m + s, its rounding and that of moved positions: 3 t. R^2 - h^2 is off by 3 u R^2, as if R were by 1.5 u.
///
/// Ends of segments are placed in float as well: arm, twice position, thrice sum; their middles and halves are off by 2, the part of a side by 3 of
/// its length, which is at most 2 P, and its sums by 4. Nothing of the strip is lost, because the place across is no farther off than the margin.
///
/// A neighbour may be farther away than S, d, where others are in the way: all of this is in units of u max(S, d) then. Walls are placed in
/// double, by LocalSegment, whose slack they add, and cut off where no way within S comes to: each of their numbers is off by 1, a stadium's
/// sides by another 4, and less than what placing takes of outlines.
constexpr double way_error = 7 + (2 * 1.1 + 3) * 2.83;
constexpr double sphere_slack = 56 * rounding::unit_roundoff;
static_assert(rounding::terms::sphere_error >= rounding::terms::query_error);
static_assert(sphere_slack >= (rounding::terms::sphere_error + way_error + 1.5) * rounding::unit_roundoff);
constexpr double segment_slack = 80 * rounding::unit_roundoff;
static_assert(segment_slack >=
              (rounding::terms::segment_place + rounding::terms::arm + 2 * rounding::terms::position +
               3 * rounding::terms::sum + 2 + 3 * 2 + 4 + way_error) *
                  rounding::unit_roundoff);

constexpr auto unmoved = [](const auto& of_a) { return of_a; };
constexpr Transform unmoved_ground{1, 0, 0, 0};

/// Returns how far two that a move may bring together are off.
double extents_of(const Agents& agents, Pair pair, double max_extents) {
  const double x = agents.x[pair.second] - agents.x[pair.first],
               y = agents.y[pair.second] - agents.y[pair.first];
  return std::max(max_extents, std::sqrt(x * x + y * y));
}

double extent_of(const FreeBody& body) {
  double max_extent = 0;
  for (std::uint32_t i = 0; i < body.size(); ++i) {
    const FreeElement each = body.element(i);
    max_extent = std::max(max_extent, std::abs(double{each.x}) + std::abs(double{each.y}) +
                                          std::abs(double{each.z}) + double{each.radius});
  }
  return max_extent;
}

}  // namespace

double OutlineSource::max_extent(std::uint32_t agent) const {
  const auto index = static_cast<std::uint32_t>(agents_.root(agent, view_.level_count));
  const Root& root = view_.roots[index];
  return std::abs(double{root.x}) + std::abs(double{root.y}) + outer_radius(view_, index);
}

bool OutlineSource::may_meet(Pair pair) const {
  return heights_meet(arguments_for(view_, agents_, {}), pair);
}

void OutlineSource::find_hits(const Agents& agents, std::span<const Pair> pairs, std::uint8_t* hits) const {
  Arguments arguments = arguments_for(view_, agents, pairs);
  arguments.states = hits;
  arguments.exact_leaves = exact_;
  answer(implementation_, arguments, 0, pairs.size());
}

bool OutlineSource::has_segments(std::uint32_t agent) const {
  return exact_ && view_.trees[agents_.root(agent, view_.level_count)].segments != no_segments;
}

bool OutlineSource::has_wide_leaves(std::uint32_t agent) const {
  const Tree& tree = view_.trees[agents_.root(agent, view_.level_count)];
  const LeafSegments<void> leaves{view_.leaf_segments};
  for (std::uint32_t disc = 0; disc < tree.count; ++disc)
    if (leaves.segments(tree, tree.discs + disc).count == 0) return true;
  return false;
}

void OutlineSource::begin(FreePair& search, Pair pair) const {
  const auto [a, b] = pair;
  const SpaceFrame frame(agents_, a, b);
  const Transform& b_in_a = frame.ground();
  const Kernels& kernels = *implementation_.kernels;
  const AgentDiscs of_a(view_, agents_, a), of_b(view_, agents_, b);
  const double max_extents = extents_of(agents_, pair, double{of_a.max_extent} + double{of_b.max_extent});
  // Where discs inside the outlines overlap, the two collide.
  search.clear_bound();
  const CutDiscs in_a = inscribed_discs(view_, agents_.shape[a]),
                 in_b = inscribed_discs(view_, agents_.shape[b]);
  for (std::uint32_t j = 0; j < in_b.count; ++j) {
    const auto [x, y] = b_in_a.apply(in_b.x[j], in_b.y[j]);
    for (std::uint32_t i = 0; i < in_a.count; ++i)
      search.bound_by({in_a.x[i], in_a.y[i], 0, in_a.radius[i]}, {x, y, 0, in_b.radius[j]});
  }
  const bool by_segments = has_segments(a) && has_segments(b);
  if (by_segments) {
    take_segments(kernels, view_, agents_.shape[a], unmoved_ground, search.a);
    take_segments(kernels, view_, agents_.shape[b], b_in_a, search.b);
  } else {
    take_discs(of_a.discs, unmoved_ground, search.a);
    take_discs(of_b.discs, b_in_a, search.b);
  }
  if (!by_segments)
    return search.begin(implementation_, FreeKind::spheres, sphere_slack * max_extents, max_extents);
  const double margin = segment_margin<BaseLanes>(view_, agents_.shape[a], agents_.shape[b]);
  search.begin(implementation_, FreeKind::segments, margin + segment_slack * max_extents, max_extents);
}

void OutlineSource::begin_walls(FreePair& search, std::uint32_t agent, double slack) const {
  const AgentDiscs of_agent(view_, agents_, agent);
  const double max_extents = double{of_agent.max_extent} + extent_of(search.b);
  const bool by_segments = has_segments(agent) && !has_wide_leaves(agent);
  if (by_segments)
    take_segments(*implementation_.kernels, view_, agents_.shape[agent], unmoved_ground, search.a);
  else
    take_discs(of_agent.discs, unmoved_ground, search.a);
  if (!by_segments)
    return search.begin(implementation_, FreeKind::walls, slack + segment_slack * max_extents, max_extents);
  const double margin = view_.segment_margin[agents_.shape[agent]];
  search.begin(implementation_, FreeKind::segments, margin + slack + segment_slack * max_extents,
               max_extents);
}

float OutlineSource::leave_all(const Agents& agents, Pair pair, double x, double y) const {
  const Vec2 along{static_cast<float>(x), static_cast<float>(y)};
  Penetration rest;
  penetration_along(shapes_, agents, {&pair, 1}, {&along, 1}, {&rest, 1}, &implementation_);
  return rest.depth;
}

double SphereSource::max_extent(std::uint32_t agent) const {
  return double{header_of(record(agent)).max_extent};
}

Heights SphereSource::heights(std::uint32_t agent) const {
  const BodyHeader& header = header_of(record(agent));
  return {header.bottom, header.top};
}

void SphereSource::find_hits(const Agents& agents, std::span<const Pair> pairs, std::uint8_t* hits) const {
  detail::find_hits(implementation_, bodies_, agents, pairs, hits);
}

void SphereSource::begin(FreePair& search, Pair pair) const {
  const SpaceFrame frame(agents_, pair.first, pair.second);
  take_record(record(pair.first), unmoved, search.a);
  take_record(
      record(pair.second), [&](const auto& each) { return frame.placed(each); }, search.b);
  const double max_extents = extents_of(agents_, pair, max_extent(pair.first) + max_extent(pair.second));
  search.begin(implementation_, FreeKind::spheres, sphere_slack * max_extents, max_extents);
  search.clear_bound();
  search.sample();
}

void SphereSource::begin_walls(FreePair& search, std::uint32_t agent, double slack) const {
  take_record(record(agent), unmoved, search.a);
  const double max_extents = max_extent(agent) + extent_of(search.b);
  search.begin(implementation_, FreeKind::walls, slack + segment_slack * max_extents, max_extents);
}

}  // namespace bch::detail
