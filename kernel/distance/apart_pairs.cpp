// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "kernel/distance/apart_pairs.hpp"

#include "kernel/collide/answer.hpp"

namespace bch::detail {

void ApartPairs::collect_apart(const Implementation& implementation, Arguments in,
                               std::span<const Pair> pairs) noexcept {
  std::uint8_t states[capacity];
  in.pairs = pairs.data(), in.states = states;
  answer(implementation, in, 0, pairs.size());
  collect(pairs, states);
}

void ApartPairs::collect_all(std::span<const Pair> pairs) noexcept {
  static constexpr std::uint8_t all_apart[capacity] = {};
  collect(pairs, all_apart);
}

/// Without a branch that depends on an answer.
void ApartPairs::collect(std::span<const Pair> pairs, const std::uint8_t* states) noexcept {
  size_ = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pair_[size_] = pairs[i];
    index_[size_] = static_cast<std::uint16_t>(i);
    size_ += states[i] == apart;
  }
}

}  // namespace bch::detail
