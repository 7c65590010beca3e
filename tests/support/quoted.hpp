// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include "tests/support/standard.hpp"

namespace bch::test {

/// Returns the text with double quotes in place of single ones, which are easier to read in a program.
inline std::string quoted(std::string text) {
  std::ranges::replace(text, '\'', '"');
  return text;
}

/// Returns a text with one place of it replaced, both quoted().
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(quoted(from));
  if (place == std::string::npos) throw std::logic_error("no " + from);
  return text.replace(place, from.size(), quoted(to));
}

}  // namespace bch::test
