// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

// Private to the readers of recordings: the fields of a line.

namespace bch::detail::trajectory {

inline bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view trimmed(std::string_view text);
std::string lower_case(std::string_view text);

/// Returns what separates the fields of a line: a comma, else a semicolon, else blanks, which stands for tabs too.
char separator_of(std::string_view line);

/// Takes the fields of a line one by one. Of CSV, fields may be in quotes.
class Fields {
 public:
  Fields(std::string_view line, char separator)
      : left_(separator == ' ' ? trimmed(line) : line), separator_(separator) {
    at_end_ = separator == ' ' && left_.empty();
  }

  /// Takes a field, without its quotes and the blanks around it.
  /// Returns: whether there was one.
  bool next(std::string_view& field) {
    if (at_end_) return false;
    if (separator_ != ' ') return next_of_csv(field);
    std::size_t end = 0;
    while (end < left_.size() && !is_blank(left_[end])) ++end;
    field = left_.substr(0, end);
    while (end < left_.size() && is_blank(left_[end])) ++end;
    left_.remove_prefix(end);
    at_end_ = left_.empty();
    return true;
  }

  /// Returns whether the line ended in quotes, or with something behind them.
  bool is_broken() const { return broken_; }

 private:
  std::string_view left_;
  char separator_;
  bool at_end_ = false, broken_ = false;

  bool next_of_csv(std::string_view& field);
  std::size_t quoted_end() const;
};

/// Returns all fields of a line.
std::vector<std::string_view> fields_of(std::string_view line, char separator);

}  // namespace bch::detail::trajectory
