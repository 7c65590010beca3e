// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/import/text.hpp"

#include <algorithm>
#include <system_error>

#include "layout/base/decimal.hpp"

namespace bch::detail::importing {

std::string_view Lines::next() {
  const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
  const std::string_view line = text_.substr(at_, end - at_);
  at_ = std::min(end + (text_.substr(end).starts_with("\r\n") ? 2 : 1), text_.size());
  ++number_;
  return line;
}

std::string_view next_word(std::string_view& text) {
  constexpr std::string_view blanks = " \t\v\f\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(blanks));
  text.remove_prefix(word.size());
  return word;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const std::string_view word = next_word(line);
    if (word.empty()) return words;
    words.push_back(word);
  }
}

std::optional<double> number_of(std::string_view word) {
  double number = 0;
  const auto [end, error] = double_from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return number;
}

}  // namespace bch::detail::importing
