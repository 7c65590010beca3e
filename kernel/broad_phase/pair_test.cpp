// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/broad_phase/pair_test.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>

namespace bch::detail {
namespace {

Pair in_order(Pair pair) noexcept {
  return {std::min(pair.first, pair.second), std::max(pair.first, pair.second)};
}

bool precedes(Pair a, Pair b) noexcept {
  return std::tie(a.first, a.second) < std::tie(b.first, b.second);
}

void require_size(std::size_t agents, std::size_t size, const char* name) {
  if (size == 0 || size == agents) return;
  throw std::invalid_argument("filter: expected " + std::to_string(agents) + " values of " + name +
                              ", one per agent, or none, found " + std::to_string(size));
}

}  // namespace

void PairTest::set(const PairFilter& filter, std::size_t agents,
                   std::span<const std::uint32_t> origin_of_image) {
  require_size(agents, filter.category.size(), "category");
  require_size(agents, filter.mask.size(), "mask");
  for (std::size_t i = 0; i < filter.excluded.size(); ++i) {
    const std::uint32_t last = in_order(filter.excluded[i]).second;
    if (last >= agents)
      throw std::invalid_argument("filter: excluded pair " + std::to_string(i) + ": expected one of " +
                                  std::to_string(agents) + " agents, found " + std::to_string(last));
  }
  agents_ = agents;
  category_ = filter.category, mask_ = filter.mask, origin_of_image_ = origin_of_image;
  excluded_.resize(filter.excluded.size());
  std::transform(filter.excluded.begin(), filter.excluded.end(), excluded_.begin(), in_order);
  std::sort(excluded_.begin(), excluded_.end(), precedes);
}

bool PairTest::accepts(Pair pair) const noexcept {
  // Pairs of an agent and an image count; a pair of two images is also found as another pair.
  const Pair found = in_order(pair);
  if (found.first >= agents_ || origin(found.second) <= found.first) return false;
  const Pair agents{found.first, origin(found.second)};
  const auto has_bit_of = [&](std::uint32_t agent, std::uint32_t other) {
    const std::uint32_t mask = mask_.empty() ? ~std::uint32_t{0} : mask_[agent];
    return (mask & (category_.empty() ? 1u : category_[other])) != 0;
  };
  return has_bit_of(agents.first, agents.second) && has_bit_of(agents.second, agents.first) &&
         !std::binary_search(excluded_.begin(), excluded_.end(), agents, precedes);
}

}  // namespace bch::detail
