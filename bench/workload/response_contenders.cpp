// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

#include <bch/collide.hpp>
#include <bch/contacts.hpp>
#include <bch/penetration.hpp>

#include "baselines/contact_reference.hpp"
#include "baselines/cut_lists.hpp"
#include "baselines/penetration_reference.hpp"
#include "bench/workload/contender.hpp"

namespace bch::bench {
namespace {

constexpr std::uint32_t penetration_directions = 16;

std::string wrong_contacts(Scene& scene, const Workload& workload, const Rows<DiscPair>& table) {
  const baselines::CutLists cuts(scene.shapes(), {});
  for (std::size_t i = 0; i < workload.pairs.size(); ++i) {
    const auto expected = baselines::contacts(cuts, workload.agents(), workload.pairs[i]);
    const auto same = [](const DiscPair& contact, const auto& discs) {
      return contact.first == discs.first && contact.second == discs.second;
    };
    const auto row = table[i];
    if (!std::equal(row.begin(), row.end(), expected.begin(), expected.end(), same))
      return fmt::format("pair {}: {} contacts where brute force finds {}, or others", i, row.size(),
                         expected.size());
  }
  return {};
}

std::string wrong_penetrations(Scene& scene, const Workload& workload, std::span<const Penetration> ways) {
  const baselines::CutLists cuts(scene.shapes(), {});
  for (std::size_t i = 0; i < workload.pairs.size(); ++i) {
    const auto [depth, x, y] =
        baselines::penetration(cuts, workload.agents(), workload.pairs[i], penetration_directions);
    if (ways[i] != Penetration{depth, x, y})
      return fmt::format("pair {}: {} m where brute force says {} m", i, ways[i].depth, depth);
  }
  return {};
}

/// Checks the answers for a crowd, whose workload has all pairs that can collide.
std::string wrong_neighbours(Scene& scene, const Workload& workload, const Rows<std::uint32_t>& rows) {
  const Hits& hits = scene.expected(disc_query, workload);
  std::vector<std::vector<std::uint32_t>> expected(workload.crowd.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i]) continue;
    const auto [first, second] = workload.pairs[i];
    expected[first].push_back(second);
    expected[second].push_back(first);
  }
  for (std::uint32_t agent = 0; agent < expected.size(); ++agent) {
    std::sort(expected[agent].begin(), expected[agent].end());
    const auto row = rows[agent];
    if (!std::equal(row.begin(), row.end(), expected[agent].begin(), expected[agent].end()))
      return fmt::format("agent {}: {} neighbours where brute force finds {}, or others", agent, row.size(),
                         expected[agent].size());
  }
  return {};
}

Contender contacts_kernel(Scene& scene, const Workload& workload, const Implementation& implementation) {
  const auto finder = std::make_shared<ContactFinder>();
  const auto call = [&set = scene.set(), &workload, finder, &implementation] {
    return finder->find(set, workload.agents(), workload.pairs,
                        {.implementation = &implementation, .leaves = Leaves::discs});
  };
  require_right(implementation.name, workload, wrong_contacts(scene, workload, call()));
  return {call, workload.pairs.size()};
}

Contender contacts_reference(Scene& scene, const Workload& workload) {
  const auto cuts = std::make_shared<baselines::CutLists>(scene.shapes(), ShapeSetPlan{});
  const std::size_t found =
      ContactFinder()
          .find(scene.set(), workload.agents(), workload.pairs, {.leaves = Leaves::discs})
          .values.size();
  const auto call = [cuts, &workload, expected = found] {
    std::size_t all = 0;
    for (const Pair pair : workload.pairs) all += baselines::contacts(*cuts, workload.agents(), pair).size();
    if (all != expected)
      throw std::runtime_error(fmt::format("{} contacts where the kernel finds {}", all, expected));
  };
  return {call, workload.pairs.size()};
}

Contender penetration_kernel(Scene& scene, const Workload& workload, const Implementation& implementation) {
  const auto ways = std::make_shared<std::vector<Penetration>>(workload.pairs.size());
  const auto call = [&set = scene.set(), &workload, ways, &implementation] {
    penetration(set, workload.agents(), workload.pairs, penetration_directions, *ways,
                {.implementation = &implementation});
  };
  call();
  require_right(implementation.name, workload, wrong_penetrations(scene, workload, *ways));
  return {call, workload.pairs.size()};
}

Contender penetration_reference(Scene& scene, const Workload& workload) {
  const auto cuts = std::make_shared<baselines::CutLists>(scene.shapes(), ShapeSetPlan{});
  const auto depths = std::make_shared<std::vector<float>>(workload.pairs.size());
  const auto call = [cuts, depths, &workload] {
    for (std::size_t i = 0; i < workload.pairs.size(); ++i)
      (*depths)[i] =
          baselines::penetration(*cuts, workload.agents(), workload.pairs[i], penetration_directions).depth;
  };
  call();
  std::vector<Penetration> ways(workload.pairs.size());
  penetration(scene.set(), workload.agents(), workload.pairs, penetration_directions, ways);
  const bool same = std::equal(depths->begin(), depths->end(), ways.begin(), ways.end(),
                               [](float depth, const Penetration& way) { return depth == way.depth; });
  require_right("reference", workload, same ? "" : "other depths than the kernel's");
  return {call, workload.pairs.size()};
}

Contender collide_all_kernel(Scene& scene, const Workload& workload, const Implementation& implementation) {
  const auto collider = std::make_shared<CrowdCollider>();
  const auto call = [&set = scene.set(), &workload, collider, &implementation] {
    return collider->collide_all(set, workload.agents(),
                                 {.implementation = &implementation, .leaves = Leaves::discs});
  };
  require_right(implementation.name, workload, wrong_neighbours(scene, workload, call()));
  return {call, workload.pairs.size()};
}

constexpr TimedQuery timed_responses[] = {{"contacts", contacts_kernel, contacts_reference},
                                          {"penetration", penetration_kernel, penetration_reference},
                                          {"collide_all", collide_all_kernel, nullptr}};

}  // namespace

std::span<const TimedQuery> response_queries() {
  return timed_responses;
}

}  // namespace bch::bench
