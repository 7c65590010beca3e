// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <vector>

#include "kernel/runtime/task_ranges.hpp"

namespace bch::detail {

/// Lists the indices of items that are kept, ascending, and gathers their values. Reuses its memory.
class KeptItems {
 public:
  /// Keeps the items i < count with predicate(i).
  template <class Predicate>
  void select(std::size_t count, const Predicate& predicate) {
    const std::size_t blocks = (count + block - 1) / block;
    begin_.assign(blocks + 1, 0);
    const auto visit = [&](std::size_t b, const auto& use) {
      for (std::size_t i = b * block; i < std::min((b + 1) * block, count); ++i)
        if (predicate(i)) use(i);
    };
    for_ranges(blocks, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t b = first; b < last; ++b) visit(b, [&](std::size_t) { ++begin_[b + 1]; });
    });
    for (std::size_t b = 0; b < blocks; ++b) begin_[b + 1] += begin_[b];
    kept_.resize(begin_[blocks]);
    for_ranges(blocks, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t b = first; b < last; ++b) {
        std::size_t to = begin_[b];
        visit(b, [&](std::size_t i) { kept_[to++] = i; });
      }
    });
  }

  std::size_t size() const noexcept { return kept_.size(); }

  /// Sets `to` to value(i) for each item i that is kept.
  template <class Value, class Of>
  void gather(std::vector<Value>& to, const Of& value) const {
    to.resize(kept_.size());
    for_ranges(kept_.size(), block, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) to[k] = value(kept_[k]);
    });
  }

 private:
  static constexpr std::size_t block = 4096;

  std::vector<std::size_t> begin_;  ///< per block of items: how many are kept before it
  std::vector<std::size_t> kept_;
};

}  // namespace bch::detail
