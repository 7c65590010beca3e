// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <locale>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

#include <bch/hierarchy.hpp>

namespace bch::cli {

/// Makes text of any origin safe to show on a terminal or a page: what would control either is written out.
/// That is control characters (C0, DEL, C1) as "\x1b" or "\u0085"; marks that turn the direction of writing,
/// that break lines or that are not characters as "\u202e"; and bytes that are not UTF-8 as "\xff". Line
/// feeds stay.
std::string printable(std::string_view text);

/// Makes a name or a message printable as one line: as printable() does, and line feeds are written out as
/// "\x0a".
std::string printable_line(std::string_view text);

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

/// Writes a line of what is known: a name, and next to it, in a column of its own, the text, see printable_line().
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

/// Parses the whole text as a number in decimal or scientific notation, whatever the locale; "inf" and "nan"
/// are numbers here, which callers have to reject by range. A number too large for a double is the largest
/// one, a number too small is nearly 0.
/// Returns: nothing for anything else.
inline std::optional<double> parse_number(std::string_view text) {
  // from_chars knows no plus sign, which people and spreadsheets write.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::invalid_argument || stop != text.data() + text.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    std::istringstream stream{std::string(text)};
    stream.imbue(std::locale::classic());
    stream >> value;
  }
  return value;
}

}  // namespace bch::cli
