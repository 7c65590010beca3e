// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <bch/query.hpp>

#include "kernel/runtime/task_ranges.hpp"

namespace bch::detail {

/// Collects rows whose lengths are known only when they are found, in tasks. Reuses its memory.
template <class Value>
class RowBlocks {
 public:
  /// Returns `rows` rows, valid until the next call. Each task calls make(), which returns a find(begin, end, add). That calls
  /// add(row, fill) once for each row in [begin, end) that has values; fill(values) appends them to a vector.
  template <class Make>
  Rows<Value> collect(std::size_t rows, std::size_t rows_at_once, const Make& make) {
    const std::size_t count = (rows + rows_at_once - 1) / rows_at_once;
    if (blocks_.size() < count) blocks_.resize(count);
    offsets_.assign(rows + 1, 0);
    for_ranges(count, 1, [&](std::size_t first, std::size_t last) {
      auto find = make();
      for (std::size_t block = first; block < last; ++block) {
        std::vector<Value>& found = blocks_[block];
        found.clear();
        const auto add = [&](std::size_t row, const auto& fill) {
          const std::size_t before = found.size();
          fill(found);
          offsets_[row + 1] = found.size() - before;
        };
        find(block * rows_at_once, std::min((block + 1) * rows_at_once, rows), add);
      }
    });
    for (std::size_t i = 0; i < rows; ++i) offsets_[i + 1] += offsets_[i];
    values_.clear();
    for (std::size_t block = 0; block < count; ++block)
      values_.insert(values_.end(), blocks_[block].begin(), blocks_[block].end());
    return {offsets_, values_};
  }

 private:
  std::vector<std::vector<Value>> blocks_;  ///< what a task found, one row after the other
  std::vector<std::uint64_t> offsets_;
  std::vector<Value> values_;
};

}  // namespace bch::detail
