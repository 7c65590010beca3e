// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/comment_header.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "layout/recordings/fields.hpp"
#include "layout/recordings/numbers.hpp"

namespace bch::detail::trajectory {
namespace {

double rate_in(const Places& places, std::uint64_t line, std::string_view text) {
  text = trimmed(text);
  std::size_t end = text.find_first_of(" \t");
  std::string_view digits = text.substr(0, end);
  if (digits.ends_with("fps")) digits.remove_suffix(3);
  const std::optional<double> fps = number_from(digits);
  if (!fps) places.reject(line, "the frame rate " + shown(text) + " is not a number");
  if (!(*fps > 0 && *fps <= largest_fps))
    places.reject(line, "the frame rate " + shown(text) + " is not above 0 and at most 10000");
  return *fps;
}

/// The unit that a comment on coordinates names in words.
std::optional<double> unit_in(const std::string& comment) {
  for (const char open : {'(', '['}) {
    const std::size_t begin = comment.find(std::string(1, open) + "in ");
    if (begin == std::string::npos) continue;
    const std::size_t end = comment.find_first_of(")]", begin);
    if (end != std::string::npos) return metres_of(comment.substr(begin + 1, end - begin - 1));
  }
  return std::nullopt;
}

}  // namespace

void CommentHeader::read(const Places& places, std::uint64_t line, std::string_view comment) {
  any = true;
  const std::string text =
      lower_case(trimmed(comment.substr(std::min(comment.find_first_not_of('#'), comment.size()))));
  constexpr std::string_view rate = "framerate:";
  if (text.starts_with(rate) && !fps) fps = rate_in(places, line, std::string_view(text).substr(rate.size()));
  std::vector<ColumnName> found = column_names(text, '#');
  if (const std::size_t label = text.find(':'); label != std::string::npos) {  // "columns: id, frame, x, y"
    std::vector<ColumnName> behind = column_names(std::string_view(text).substr(label + 1), '#');
    if (has_all_roles(behind)) found = std::move(behind);
  }
  if (has_all_roles(found)) {
    names = std::move(found);
    names_line = line;
  } else if (text.starts_with("x") && !metres) {
    metres = unit_in(text);
  }
}

}  // namespace bch::detail::trajectory
