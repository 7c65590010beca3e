// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/part_references.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "baselines/penetration_reference.hpp"
#include "layout/base/rounding.hpp"

namespace bch::test {

using baselines::Method;
using baselines::SlabBodies;

namespace {

constexpr float never = std::numeric_limits<float>::infinity();

Pair in_order(Pair pair) {
  return {std::min(pair.first, pair.second), std::max(pair.first, pair.second)};
}

}  // namespace

void sort_contacts(std::vector<DiscPair>& contacts) {
  std::sort(contacts.begin(), contacts.end(), [](const DiscPair& a, const DiscPair& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
}

DiscPair exchanged(const DiscPair& discs) {
  return {discs.second, discs.first};
}

PartReferences::PartReferences(std::span<const Shape> shapes, const ShapeSetPlan& plan, const ShapeSet& set)
    : shapes_(shapes),
      set_(set),
      levels_(plan.depths.size()),
      bodies_(shapes, plan, Leaves::discs),
      exact_bodies_(shapes, plan, Leaves::segments),
      nearest_(bodies_.parts(), plan),
      outlines_(bodies_.parts(), plan),
      first_(bodies_.parts(), plan),
      cuts_(bodies_.parts(), plan),
      segments_(bodies_.parts(), plan, Leaves::segments) {}

baselines::Clearance PartReferences::clearance(const Agents& agents, Pair pair, double max_distance) {
  const Pair ordered = in_order(pair);
  baselines::Clearance best{never, {0, 0}, no_discs.first, no_discs.second};
  for (const SlabBodies::PartPair& parts : bodies_.part_pairs(agents, ordered)) {
    // Lower slabs come first.
    baselines::Clearance at = nearest_.query(parts.agents(), {0, 1}, max_distance, Method::brute_force);
    if (!(at.distance < best.distance)) continue;
    best = at;
    best.first += first_disc(agents, ordered.first, parts.slab[0]);
    best.second += first_disc(agents, ordered.second, parts.slab[1]);
  }
  if (ordered == pair || best.distance == never) return best;
  return {best.distance, {-best.direction.x, -best.direction.y}, best.second, best.first};
}

float PartReferences::exact_clearance(const Agents& agents, Pair pair, double max_distance) {
  if (exact_bodies_.collide(agents, pair, Method::depth_first)) return 0;
  float least = never;
  for (const SlabBodies::PartPair& parts : bodies_.part_pairs(agents, in_order(pair))) {
    const Agents both = parts.agents();
    const auto of_outlines = outlines_.distance(both, {0, 1}, max_distance);
    const auto of_discs = [&] {
      return baselines::at_least_zero(nearest_.query(both, {0, 1}, max_distance, Method::brute_force))
          .distance;
    };
    least = std::min(least, of_outlines ? *of_outlines : of_discs());
  }
  return least;
}

bool PartReferences::within(const Agents& agents, Pair pair, double distance) {
  for (const SlabBodies::PartPair& parts : bodies_.part_pairs(agents, in_order(pair)))
    if (nearest_.within(parts.agents(), {0, 1}, distance, Method::brute_force)) return true;
  return bodies_.collide(agents, pair, Method::depth_first);
}

float PartReferences::time(const Agents& agents, Pair pair, double x, double y) {
  if (bodies_.collide(agents, pair, Method::depth_first)) return 0;
  const double sign = in_order(pair) == pair ? 1 : -1;
  float soonest = never;
  for (const SlabBodies::PartPair& parts : bodies_.part_pairs(agents, in_order(pair)))
    soonest =
        std::min(soonest, first_.query(parts.agents(), {0, 1}, sign * x, sign * y, Method::brute_force));
  return soonest;
}

std::vector<DiscPair> PartReferences::contacts(const Agents& agents, Pair pair, Leaves leaves) {
  const Pair ordered = in_order(pair);
  std::vector<DiscPair> all;
  for (const SlabBodies::PartPair& parts : bodies_.part_pairs(agents, ordered))
    for (const auto& [i, j] : baselines::contacts(cuts_, parts.agents(), {0, 1},
                                                  leaves == Leaves::segments ? &segments_ : nullptr)) {
      const DiscPair discs{i + first_disc(agents, ordered.first, parts.slab[0]),
                           j + first_disc(agents, ordered.second, parts.slab[1])};
      all.push_back(ordered == pair ? discs : exchanged(discs));
    }
  sort_contacts(all);
  return all;
}

PartReferences::Depth PartReferences::depth(const Agents& agents, Pair pair, Vec2 along) {
  const Vec2 of_lower = in_order(pair) == pair ? along : Vec2{-along.x, -along.y};
  Depth most{0, 0};
  for (const SlabBodies::PartPair& parts : bodies_.part_pairs(agents, in_order(pair))) {
    const Agents of = parts.agents();
    most.depth = std::max(most.depth, baselines::penetration_along(cuts_, of, {0, 1}, of_lower).depth);
    most.slack = std::max(most.slack, 40 * detail::rounding::unit_roundoff *
                                          static_cast<double>(cuts_.reach(of, 0) + cuts_.reach(of, 1)));
  }
  return most;
}

std::uint32_t PartReferences::first_disc(const Agents& agents, std::uint32_t agent,
                                         std::uint32_t slab) const {
  const std::uint32_t shape = agents.shape[agent];
  if (shapes_[shape].slabs.empty()) return 0;
  return set_.slab_begin(shape, static_cast<std::uint32_t>(agents.root(agent, levels_) % levels_))[slab];
}

}  // namespace bch::test
