// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/contact_reference.hpp"

#include "baselines/disc_tree.hpp"
#include "baselines/placement.hpp"

namespace bch::baselines {

std::vector<std::pair<std::uint32_t, std::uint32_t>> contacts(const CutLists& cuts, const Agents& agents,
                                                              Pair pair, const LeafSegments* segments) {
  const FloatPlacement place = float_placement(agents, pair);
  const bool in_order = pair.first <= pair.second,
             exact = segments != nullptr && segments->decide(agents, pair);
  const CutList &first = cuts.list(agents, pair.first), &second = cuts.list(agents, pair.second);
  const auto is_hit = [&](std::uint32_t i, std::uint32_t j) {
    const auto path_a = in_order ? first.path(i) : second.path(j),
               path_b = in_order ? second.path(j) : first.path(i);
    const std::uint32_t node_a = in_order ? first.nodes[i] : second.nodes[j],
                        node_b = in_order ? second.nodes[j] : first.nodes[i];
    return all_overlap(place, path_a, path_b) &&
           (!exact || segments->meet(place, agents, pair, node_a, node_b));
  };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  for (std::uint32_t i = 0; i < first.discs.size(); ++i)
    for (std::uint32_t j = 0; j < second.discs.size(); ++j)
      if (is_hit(i, j)) found.push_back({i, j});
  return found;
}

}  // namespace bch::baselines
