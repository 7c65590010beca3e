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

#include "layout/base/text.hpp"

namespace bch::cli {

using detail::counted;
using detail::escaped;
using detail::grouped;
using detail::printable;
using detail::printable_line;

/// Writes a line of what is known: a name, and next to it, in a column of its own, the text, see printable_line().
inline std::string fact(std::string_view name, std::string_view text) {
  return fmt::format("{:<12}{}\n", name, printable_line(text));
}

inline std::string depth_name(std::uint32_t depth) {
  return depth == all_depths ? "all" : fmt::format("{}", depth);
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
