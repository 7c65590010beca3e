// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

#include <bch/hierarchy.hpp>

#include "bench/base/printable.hpp"

namespace bch::cli {

/// Writes a number with its digits in groups: 12345 as "12 345".
inline std::string grouped(std::uint64_t number) {
  const std::string digits = fmt::format("{}", number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text.push_back(' ');
    text.push_back(digits[i]);
  }
  return text;
}

/// Escapes text for HTML or SVG: see printable_line().
inline std::string escaped(std::string_view text) {
  std::string markup;
  for (const char c : printable_line(text)) {
    if (c == '&')
      markup += "&amp;";
    else if (c == '<')
      markup += "&lt;";
    else if (c == '>')
      markup += "&gt;";
    else if (c == '"')
      markup += "&quot;";
    else
      markup += c;
  }
  return markup;
}

/// Writes a line of what is known: a name, and beside it, in a column of its own, the text, see printable_line().
inline std::string fact(std::string_view name, std::string_view text) {
  return fmt::format("{:<12}{}\n", name, printable_line(text));
}

inline std::string depth_name(std::uint32_t depth) {
  return depth == all_depths ? "all" : fmt::format("{}", depth);
}

/// Writes a count with its noun: "1 clip", "2 clips".
inline std::string counted(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", grouped(count), noun, count == 1 ? "" : "s");
}

/// Converts a float to the double of the same shortest decimal: 0.1f becomes 0.1 instead of 0.10000000149.
inline double shortest(float value) {
  return std::stod(fmt::format("{}", value));
}

}  // namespace bch::cli
