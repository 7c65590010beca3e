// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/clip_match.hpp"

#include <algorithm>

namespace bch::detail::importing {
namespace {

constexpr double least_alignment = 0.7;
constexpr std::size_t max_names = 5;
constexpr std::size_t longest_name = 40;

bool at_least_half(std::size_t part, std::size_t whole) {
  return 2 * part >= whole;
}

/// "Hips, Spine and 7 more".
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  const std::size_t shown = std::min(names.size(), max_names);
  for (std::size_t i = 0; i < shown; ++i) text += (i > 0 ? ", " : "") + names[i].substr(0, longest_name);
  if (shown < names.size()) text += " and " + std::to_string(names.size() - shown) + " more";
  return text.empty() ? "none" : text;
}

std::string names_of(const ClipMatch& match) {
  return " (in both: " + listed(match.matched) + "; in the clip alone: " + listed(match.unmatched) + ")";
}

}  // namespace

std::string mismatch(const ClipMatch& match) {
  const std::size_t channels = match.matched.size() + match.unmatched.size();
  const std::string counts = std::to_string(match.matched.size()) + " of its " + std::to_string(channels) +
                             " channels move joints of the character, and its file has " +
                             std::to_string(match.joints_in_file) + " of these " +
                             std::to_string(match.joints) + " joints";
  if (!at_least_half(match.matched.size(), channels) && !at_least_half(match.joints_in_file, match.joints))
    return counts + ", less than half" + names_of(match);
  if (match.bones > 0 && match.bones_in_file == 0)
    return counts + ", but no bone that could be compared" + names_of(match);
  if (match.alignment < least_alignment)
    return "its joints are turned otherwise than the character's" + names_of(match);
  return {};
}

}  // namespace bch::detail::importing
