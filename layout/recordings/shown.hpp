// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Inline, so that checks of recordings link no reader for their messages.

namespace bch::detail::trajectory {

/// Returns text without control characters.
inline std::string one_line(std::string_view text) {
  std::string line(text);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  return line;
}

/// Returns text from a file for a message: in quotes, without control characters, not long.
inline std::string shown(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string line = one_line(text.substr(0, longest));
  if (text.size() > longest) line += "...";
  line.insert(line.begin(), '\'');
  return line += '\'';
}

}  // namespace bch::detail::trajectory
