// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

// Texts for people, from the standard library alone.

namespace bch::detail {

/// Writes a number in hexadecimal digits, at least `width`.
inline std::string hexadecimal(std::uint32_t value, std::size_t width) {
  char digits[8];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), value, 16).ptr;
  const std::string text(digits, end);
  return std::string(width - std::min(width, text.size()), '0') + text;
}

namespace utf8 {

struct Character {
  std::uint32_t value = 0;
  std::size_t bytes = 0;  ///< 0: the text does not begin with a character
};

inline std::uint32_t byte_at(std::string_view text, std::size_t place) {
  return static_cast<unsigned char>(text[place]);
}

/// Returns how many bytes a character has whose first byte this is; 0 for none.
inline std::size_t length_of(std::uint32_t first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

/// Returns the character that a text, which is not empty, begins with.
inline Character first_character(std::string_view text) {
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};  // of so many bytes
  const std::uint32_t first = byte_at(text, 0);
  const std::size_t length = length_of(first);
  if (length == 0 || length > text.size()) return {};
  std::uint32_t value = length == 1 ? first : first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_at(text, i) & 0xc0) != 0x80) return {};
    value = value << 6 | (byte_at(text, i) & 0x3f);
  }
  const bool surrogate = value >= 0xd800 && value < 0xe000;
  if (value < least[length] || value > 0x10ffff || surrogate) return {};
  return {value, length};
}

/// Returns whether a character is a control, separates lines or paragraphs, marks a direction, or is none of XML's.
inline bool is_written_out(std::uint32_t value) {
  struct Range {
    std::uint32_t first, last;
  };
  constexpr Range ranges[] = {{0x00, 0x1f},     {0x7f, 0x9f},     {0x61c, 0x61c},  {0x200e, 0x200f},
                              {0x2028, 0x202e}, {0x2066, 0x2069}, {0xfffe, 0xffff}};
  return std::any_of(std::begin(ranges), std::end(ranges),
                     [&](const Range& r) { return value >= r.first && value <= r.last; });
}

inline std::string printable(std::string_view text, bool keeps_line_feeds) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const auto [value, bytes] = first_character(text);
    if (bytes > 0 && ((keeps_line_feeds && value == '\n') || !is_written_out(value)))
      out += text.substr(0, bytes);
    else if (bytes > 1)
      out += "\\u" + hexadecimal(value, 4);
    else
      out += "\\x" + hexadecimal(byte_at(text, 0), 2);
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return out;
}

}  // namespace utf8

/// Makes text of any origin safe to show on a terminal or a page: what would control either is written out. That is control characters
/// (C0, DEL, C1) as "\x1b" or "\u0085"; marks that turn the direction of writing, that break lines or that are not characters as
/// "\u202e"; and bytes that are not UTF-8 as "\xff". Line feeds stay.
inline std::string printable(std::string_view text) {
  return utf8::printable(text, true);
}

/// Makes a name or a message printable as one line: as printable() does, and line feeds are written out as "\x0a".
inline std::string printable_line(std::string_view text) {
  return utf8::printable(text, false);
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

/// Writes a number with its digits in groups: 12345 as "12 345".
inline std::string grouped(std::uint64_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text.push_back(' ');
    text.push_back(digits[i]);
  }
  return text;
}

/// Writes a count with its noun: "1 clip", "2 clips".
inline std::string counted(std::uint64_t count, std::string_view noun) {
  return grouped(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

}  // namespace bch::detail
