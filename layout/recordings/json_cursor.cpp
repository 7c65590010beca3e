// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/json_cursor.hpp"

namespace bch::detail::trajectory {

bool JsonCursor::string(std::string_view& content) {
  if (!take('"')) return false;
  for (std::size_t end = 0; end < left_.size(); ++end) {
    if (left_[end] == '\\') {
      ++end;
    } else if (left_[end] == '"') {
      content = left_.substr(0, end);
      left_.remove_prefix(end + 1);
      return true;
    }
  }
  return false;
}

/// Takes an array or an object, whatever stands between its brackets.
bool JsonCursor::skip_nested() {
  std::size_t depth = 0;
  do {
    if (left_.empty()) return false;
    const char c = left_.front();
    std::string_view ignored;
    if (c == '"') {
      if (!string(ignored)) return false;
      continue;
    }
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    left_.remove_prefix(1);
  } while (depth > 0);
  return true;
}

bool JsonCursor::value(std::string_view& text) {
  skip_blanks();
  const std::string_view before = left_;
  if (left_.empty()) return false;
  if (left_.front() == '"') return string(text);
  if (left_.front() == '[' || left_.front() == '{') {
    if (!skip_nested()) return false;
  } else {
    const std::size_t end = left_.find_first_of(",}] \t");
    left_.remove_prefix(end == std::string_view::npos ? left_.size() : end);
  }
  text = before.substr(0, before.size() - left_.size());
  return !text.empty();
}

}  // namespace bch::detail::trajectory
