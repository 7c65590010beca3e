// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace bch::cli {
namespace {

struct Utf8Character {
  std::uint32_t value = 0;
  std::size_t bytes = 0;  ///< 0: the text does not begin with a character
};

std::uint32_t byte_at(std::string_view text, std::size_t place) {
  return static_cast<unsigned char>(text[place]);
}

/// How many bytes a character has whose first byte this is; 0 for none.
std::size_t length_of(std::uint32_t first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

/// The character in UTF-8 that a text, which is not empty, begins with.
Utf8Character first_character(std::string_view text) {
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

struct Range {
  std::uint32_t first, last;
};

/// Controls, line and paragraph separators, marks of direction, and what XML has no character for.
constexpr Range written_out[] = {{0x00, 0x1f},     {0x7f, 0x9f},     {0x61c, 0x61c},  {0x200e, 0x200f},
                                 {0x2028, 0x202e}, {0x2066, 0x2069}, {0xfffe, 0xffff}};

bool is_written_out(std::uint32_t value) {
  return std::ranges::any_of(written_out,
                             [&](const Range& r) { return value >= r.first && value <= r.last; });
}

std::string printable(std::string_view text, bool keeps_line_feeds) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const auto [value, bytes] = first_character(text);
    if (bytes > 0 && ((keeps_line_feeds && value == '\n') || !is_written_out(value)))
      out += text.substr(0, bytes);
    else if (bytes > 1)
      out += fmt::format("\\u{:04x}", value);
    else
      out += fmt::format("\\x{:02x}", byte_at(text, 0));
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text) {
  return printable(text, true);
}

std::string printable_line(std::string_view text) {
  return printable(text, false);
}

}  // namespace bch::cli
