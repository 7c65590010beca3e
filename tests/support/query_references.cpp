// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "tests/support/query_references.hpp"

#include "baselines/contact_reference.hpp"
#include "baselines/penetration_reference.hpp"

namespace bch::test {

using baselines::Method;

/// All segments against all others take as long as all else: 1 of so many pairs.
constexpr std::size_t segment_stride = 4;

BruteForce::BruteForce(std::span<const Shape> shapes, const ShapeSetPlan& plan)
    : collisions(shapes, plan),
      collisions_of_discs(shapes, plan, Leaves::discs),
      clearances(shapes, plan),
      segment_clearances(shapes, plan),
      times(shapes, plan),
      cuts(shapes, plan),
      segments(shapes, plan, Leaves::segments) {}

std::vector<PairAnswers> BruteForce::answers(const ShapeSet& set, const Questions& of) {
  std::vector<PairAnswers> answers = run_query(set, of);
  const Agents agents = of.crowd.agents();
  const auto set_nearest = [](NearestFeatures& found, const baselines::Clearance& expected) {
    const auto& [distance, direction, first, second] = expected;
    found = {distance, direction, {first, second}, found.points};
  };
  const auto contacts = [&](Pair pair, const baselines::LeafSegments* leaves) {
    std::vector<DiscPair> row;
    for (const auto& [first, second] : baselines::contacts(cuts, agents, pair, leaves))
      row.push_back({first, second});
    return row;
  };
  const auto penetration = [](const baselines::PenetrationDepth& way) {
    return Penetration{way.depth, way.x, way.y};
  };
  for (std::size_t i = 0; i < of.pairs.size(); ++i) {
    const Pair pair = of.pairs[i];
    PairAnswers& all = answers[i];
    const auto collide = [&](const baselines::Reference& reference) {
      return reference.boundary(agents, pair, Method::brute_force) ||
             reference.solid(agents, pair, Method::depth_first);
    };
    all.hit = collide(collisions), all.hit_of_discs = collide(collisions_of_discs);
    all.within =
        all.hit_of_discs != 0 || clearances.within(agents, pair, of.distances[i], Method::brute_force);
    const baselines::Clearance deepest = clearances.query(agents, pair, of.limit, Method::brute_force),
                               zero = baselines::at_least_zero(all.hit_of_discs != 0 ? baselines::Clearance{}
                                                                                     : deepest);
    set_nearest(all.deepest, deepest);
    set_nearest(all.nearest, zero);
    if (i % segment_stride == 0)
      all.exact.distance =
          all.hit != 0 ? 0 : segment_clearances.distance(agents, pair, of.limit).value_or(zero.distance);
    all.time =
        all.hit_of_discs != 0 ? 0 : times.query(agents, pair, of.way_x[i], of.way_y[i], Method::brute_force);
    all.best = penetration(baselines::penetration(cuts, agents, pair, of.lines));
    all.along = penetration(baselines::penetration_along(cuts, agents, pair, of.directions[i]));
    all.contacts = contacts(pair, &segments);
    all.contacts_of_discs = contacts(pair, nullptr);
  }
  return answers;
}

}  // namespace bch::test
