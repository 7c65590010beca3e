// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "baselines/contact_reference.hpp"

#include "baselines/disc_tree.hpp"
#include "baselines/placement.hpp"

namespace bch::baselines {

std::vector<std::pair<std::uint32_t, std::uint32_t>> contacts(const CutLists& cuts, const Agents& agents,
                                                              Pair pair) {
  const FloatPlacement place = float_placement(agents, pair);
  const auto overlap = [&](const Disc& of_first, const Disc& of_second) {
    return pair.first <= pair.second
               ? discs_overlap(place, of_first, of_first.radius, of_second, of_second.radius)
               : discs_overlap(place, of_second, of_second.radius, of_first, of_first.radius);
  };
  const std::span<const Disc> first = cuts.of(agents, pair.first), second = cuts.of(agents, pair.second);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  for (std::uint32_t i = 0; i < first.size(); ++i)
    for (std::uint32_t j = 0; j < second.size(); ++j)
      if (overlap(first[i], second[j])) found.push_back({i, j});
  return found;
}

}  // namespace bch::baselines
