// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/contact_reference.hpp"

#include "baselines/disc_tree.hpp"
#include "baselines/placement.hpp"

namespace bch::baselines {

std::vector<std::pair<std::uint32_t, std::uint32_t>> contacts(const CutLists& cuts, const Agents& agents,
                                                              Pair pair) {
  const FloatPlacement place = float_placement(agents, pair);
  const auto overlap = [&](std::span<const Disc> of_first, std::span<const Disc> of_second) {
    return pair.first <= pair.second ? all_overlap(place, of_first, of_second)
                                     : all_overlap(place, of_second, of_first);
  };
  const CutList &first = cuts.list(agents, pair.first), &second = cuts.list(agents, pair.second);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  for (std::uint32_t i = 0; i < first.discs.size(); ++i)
    for (std::uint32_t j = 0; j < second.discs.size(); ++j)
      if (overlap(first.path(i), second.path(j))) found.push_back({i, j});
  return found;
}

}  // namespace bch::baselines
