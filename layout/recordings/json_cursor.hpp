// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <string_view>

// Private to the readers of recordings: JSON of a line.

namespace bch::detail::trajectory {

/// Walks through JSON from its front, without making anything of it. All functions return whether what they take is there; where
/// it is not, the cursor may stand anywhere.
class JsonCursor {
 public:
  explicit JsonCursor(std::string_view text) : left_(text) {}

  /// Takes a character, and blanks before it.
  bool take(char c) {
    skip_blanks();
    if (left_.empty() || left_.front() != c) return false;
    left_.remove_prefix(1);
    return true;
  }
  /// Takes a string, without its quotes; what is escaped stays so.
  bool string(std::string_view& content);
  /// Takes a member's name and the colon behind it.
  bool name(std::string_view& content) { return string(content) && take(':'); }
  /// Takes a value of any kind, as text.
  bool value(std::string_view& text);
  bool is_at_end() {
    skip_blanks();
    return left_.empty();
  }

 private:
  std::string_view left_;

  void skip_blanks() {
    while (!left_.empty() && (left_.front() == ' ' || left_.front() == '\t')) left_.remove_prefix(1);
  }
  bool skip_nested();
};

/// Calls member(name, value) for all members of an object, which is taken.
template <class Member>
bool take_members(JsonCursor& json, Member member) {
  if (!json.take('{')) return false;
  if (json.take('}')) return true;
  do {
    std::string_view name, value;
    if (!json.name(name) || !json.value(value)) return false;
    member(name, value);
  } while (json.take(','));
  return json.take('}');
}

}  // namespace bch::detail::trajectory
