// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/all_queries.hpp"

#include "layout/shape_set/flat_shape.hpp"
#include "tests/support/obstacle_scenes.hpp"

namespace bch::test {
namespace {

/// A wall, and a pillar on it.
void query_all_of_obstacles(const ShapeSet& set, const Agents& agents, const detail::AllOptions& options) {
  const ObstacleSet obstacles =
      obstacles_from_wkt("LINESTRING(-9 0.1, 9 0.2) POLYGON((-1 -1, 1 -1, 1 1, -1 1))");
  const std::vector<double> way(agents.size(), 0.5);
  for (const Leaves leaves : {Leaves::discs, Leaves::segments}) {
    detail::AllOptions how = options;
    how.distance_leaves = leaves;
    all_answers(set, agents, obstacles, how, way, {way, way});
  }
  bch::Crowd crowd;
  crowd.obstacles(set, agents, obstacles, options);
}

}  // namespace

void query_all(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
               const Implementation& implementation) {
  std::vector<std::uint8_t> hits(pairs.size());
  collide(set, agents, pairs, hits, {&implementation});
  bch::Crowd crowd;
  crowd.collisions(set, agents, {.implementation = &implementation}).by_agent();
  crowd.contacts(set, agents, {.implementation = &implementation});
  crowd.contacts(set, agents, pairs, {.implementation = &implementation});
  crowd.clearances(set, agents, {.implementation = &implementation, .max_distance = 0.5});
  crowd.penetrations(set, agents, 16, {.implementation = &implementation});
  std::vector<Penetration> ways(pairs.size());
  penetration(set, agents, pairs, 4, ways, &implementation);
  std::vector<float> values(pairs.size());
  std::vector<Vec2> directions(pairs.size());
  std::vector<DiscPair> nodes(pairs.size());
  clearance(set, agents, pairs, {values, directions, nodes}, {.implementation = &implementation});
  std::vector<NearestPoints> points(pairs.size());
  clearance(set, agents, pairs, {values, directions, nodes, points},
            {.implementation = &implementation, .leaves = Leaves::segments});
  const std::vector<double> way(pairs.size(), 0.5);
  within(set, agents, pairs, way, hits, &implementation);
  time_of_impact(set, agents, pairs, {way, way}, values, &implementation);
  query_all_of_obstacles(set, agents, {.implementation = &implementation});
}

void query_all_of_a_dynamic_copy(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
                                 const Implementation& implementation) {
  DynamicShapeSet dynamic(set);
  query_all(dynamic.set(), agents, pairs, implementation);
  if (set.roots_only() || set.shape_count() == 0) return;
  BuiltShape last(set.plan());
  last.flat() = detail::flat_body(set.arrays(), set.shape_count() - 1);
  last.flat().plan = set.plan();
  dynamic.try_replace(set.shape_count() - 1, last);
  dynamic.replace(0, last);
  query_all(dynamic.set(), agents, pairs, implementation);
}

}  // namespace bch::test
