// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/all_queries.hpp"

#include <vector>

#include "kernel/collide/collide.hpp"
#include "kernel/contact/contacts.hpp"
#include "kernel/crowd/collide_all.hpp"
#include "kernel/distance/clearance.hpp"
#include "kernel/distance/time_of_impact.hpp"
#include "kernel/penetration/penetration.hpp"
#include "layout/shape_set/dynamic_shape_set.hpp"
#include "layout/shape_set/flat_shape.hpp"

namespace bch::test {

void ask_all(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
             const kernel::Implementation& implementation) {
  std::vector<std::uint8_t> hits(pairs.size());
  collide(set, agents, pairs, hits, {Semantics::boundary, &implementation});
  if (set.solid()) collide(set, agents, pairs, hits, {Semantics::solid, &implementation});
  CrowdCollider().collide_all(set, agents, {Semantics::boundary, &implementation});
  ContactTable table;
  contacts(set, agents, pairs, table, {&implementation});
  std::vector<Penetration> ways(pairs.size());
  penetration(set, agents, pairs, 4, ways, {&implementation});
  std::vector<float> values(pairs.size());
  std::vector<Vec2> directions(pairs.size());
  std::vector<ClosestDiscs> nodes(pairs.size());
  clearance(set, agents, pairs, {values, directions, nodes}, {.implementation = &implementation});
  const std::vector<double> way(pairs.size(), 0.5);
  time_of_impact(set, agents, pairs, {way, way}, values, {.implementation = &implementation});
}

void ask_all_of_a_dynamic_copy(const ShapeSet& set, const Agents& agents, std::span<const Pair> pairs,
                               const kernel::Implementation& implementation) {
  DynamicShapeSet dynamic(set);
  ask_all(dynamic.set(), agents, pairs, implementation);
  if (set.roots_only() || set.shape_count() == 0) return;
  FlatShape last = flat_shape(set.arrays(), set.shape_count() - 1);
  last.plan = set.plan();
  dynamic.try_replace(set.shape_count() - 1, last);
  dynamic.replace(0, last);
  ask_all(dynamic.set(), agents, pairs, implementation);
}

}  // namespace bch::test
