// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bch::cli {

/// Returns how many letters have to be inserted, removed or replaced to make one word of the other (Levenshtein's distance).
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

/// Returns ", did you mean NAME?" with the name that is nearest to a mistyped word, or nothing where none is near.
inline std::string did_you_mean(std::string_view word, std::span<const std::string> names) {
  std::size_t least = 2 + word.size() / 4;
  const std::string* nearest = nullptr;
  for (const std::string& name : names)
    if (const std::size_t distance = edit_distance(word, name); distance < least)
      least = distance, nearest = &name;
  return nearest == nullptr ? "" : ", did you mean " + *nearest + "?";
}

}  // namespace bch::cli
