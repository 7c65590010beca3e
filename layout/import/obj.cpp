// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <algorithm>
#include <charconv>
#include <system_error>

#include "layout/base/number_class.hpp"
#include "layout/import/scene.hpp"
#include "layout/import/text.hpp"

namespace bch::detail::importing {
namespace {

/// Writes one line after the other.
class PlainObj {
 public:
  PlainObj(const std::filesystem::path& file, std::string_view text) : file_(file), lines_(text) {
    plain_.reserve(text.size());
  }

  std::string write() {
    while (!lines_.at_end()) write_line();
    return std::move(plain_);
  }

 private:
  const std::filesystem::path& file_;
  Lines lines_;
  std::string plain_;

  [[noreturn]] void reject(const std::string& reason) const {
    importing::reject(file_, lines_.place() + ": " + reason);
  }

  void write_line() {
    std::string line(lines_.next());
    if (is_comment(line)) return;
    while (line.ends_with('\\') && line.find('#') == std::string::npos && !lines_.at_end())
      line.replace(line.size() - 1, 1, " ").append(lines_.next());
    const std::vector<std::string_view> words = words_of(std::string_view(line).substr(0, line.find('#')));
    const std::string_view what = words.empty() ? "" : words[0];
    if (what == "v") {
      write_vertex(words);
    } else if (what == "f" || what == "fo" || what == "l" || what == "p") {
      write_face(words);
    } else if (what != "vt" && what != "vn") {
      // A backslash in the name of a file would join the next line to it.
      std::ranges::replace(line, '\\', '/');
      plain_ += line + '\n';
    }
  }

  /// A backslash at the end of a comment, such as that of a path, is a part of it.
  static bool is_comment(std::string_view line) {
    const std::size_t start = line.find_first_not_of(" \t");
    return start == std::string_view::npos || line[start] == '#';
  }

  static bool is_number(std::string_view word) {
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
    const std::optional<double> number = number_of(word);
    return number && is_finite(*number);
  }

  /// Three coordinates, and a fourth that divides them; further numbers are colours.
  void write_vertex(const std::vector<std::string_view>& words) {
    if (words.size() < 4) reject("a vertex of " + count(words.size() - 1, "coordinate") + ", not 3");
    plain_ += 'v';
    for (std::size_t i = 1; i < (words.size() == 5 ? 5 : 4); ++i) {
      const std::string_view word = words[i];
      if (!is_number(word)) reject("coordinate '" + std::string(word) + "' is not a finite number");
      plain_ += word[0] == '.' ? " 0" : " ";  // assimp counts numbers by their first characters
      plain_ += word;
    }
    plain_ += '\n';
  }

  /// Of each corner "vertex/texture/normal" the vertex.
  void write_face(const std::vector<std::string_view>& words) {
    plain_ += words[0];
    for (std::size_t i = 1; i < words.size(); ++i) {
      std::string_view word = words[i].substr(0, words[i].find('/'));
      if (word.starts_with('+')) word.remove_prefix(1);
      int vertex = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), vertex);
      if (error != std::errc() || end != word.data() + word.size() || vertex == 0)
        reject("corner '" + std::string(words[i]) + "' names no vertex");
      plain_ += ' ' + std::to_string(vertex);
    }
    plain_ += '\n';
  }
};

}  // namespace

std::string plain_obj(const std::filesystem::path& file, std::string_view text) {
  return PlainObj(file, text).write();
}

}  // namespace bch::detail::importing
