// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/fields.hpp"

#include <algorithm>

namespace bch::detail::trajectory {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

char separator_of(std::string_view line) {
  for (const char separator : {',', ';'})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

/// Where the quotes end that begin what is left; npos where they do not. Two quotes stand for one.
std::size_t Fields::quoted_end() const {
  std::size_t end = left_.find('"', 1);
  while (end != std::string_view::npos && end + 1 < left_.size() && left_[end + 1] == '"')
    end = left_.find('"', end + 2);
  return end;
}

bool Fields::next_of_csv(std::string_view& field) {
  while (!left_.empty() && is_blank(left_.front())) left_.remove_prefix(1);
  std::size_t after_quotes = 0;
  if (left_.starts_with('"')) {
    after_quotes = quoted_end();
    broken_ = broken_ || after_quotes == std::string_view::npos;
    if (broken_) return at_end_ = true, false;
    ++after_quotes;
  }
  const std::size_t end = std::min(left_.find(separator_, after_quotes), left_.size());
  field = trimmed(left_.substr(0, end));
  if (after_quotes > 0) {
    broken_ = broken_ || field.size() != after_quotes;
    field = field.substr(1, after_quotes - 2);
  }
  at_end_ = end == left_.size();
  left_.remove_prefix(at_end_ ? end : end + 1);
  return true;
}

std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> all;
  Fields fields(line, separator);
  for (std::string_view field; fields.next(field);) all.push_back(field);
  return all;
}

}  // namespace bch::detail::trajectory
