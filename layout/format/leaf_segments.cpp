// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/format/leaf_segments.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace bch::detail {
namespace {

bool is_run(std::span<const std::uint32_t> segments) {
  return segments.front() <= leaf_first_mask &&
         std::adjacent_find(segments.begin(), segments.end(),
                            [](std::uint32_t a, std::uint32_t b) { return b != a + 1; }) == segments.end();
}

}  // namespace

void add_leaf(std::span<const std::uint32_t> segments, std::size_t leaf, std::size_t leaves,
              std::vector<std::uint32_t>& words) {
  words.resize(std::max(words.size(), leaves));
  words[leaf] = 0;
  if (segments.size() > max_leaf_segments) return;
  const auto size = static_cast<std::uint32_t>(segments.size());
  if (is_run(segments)) {
    words[leaf] = size << leaf_count_shift | segments.front();
    return;
  }
  words[leaf] = leaf_list | static_cast<std::uint32_t>(words.size());
  words.push_back(size);
  words.insert(words.end(), segments.begin(), segments.end());
}

std::vector<std::uint32_t> segments_of(std::span<const std::uint32_t> words, std::size_t leaf) {
  const std::uint32_t word = words[leaf];
  if (word >= leaf_list) {
    const auto list = words.subspan((word & ~leaf_list) + 1, words[word & ~leaf_list]);
    return {list.begin(), list.end()};
  }
  std::vector<std::uint32_t> run(word >> leaf_count_shift);
  std::iota(run.begin(), run.end(), word & leaf_first_mask);
  return run;
}

std::size_t leaf_segments_size(std::span<const std::uint32_t> words, std::size_t leaves) {
  std::size_t end = leaves;
  for (const std::uint32_t word : words.first(leaves))
    if (word >= leaf_list)
      end = std::max<std::size_t>(end, (word & ~leaf_list) + 1 + words[word & ~leaf_list]);
  return end;
}

}  // namespace bch::detail
