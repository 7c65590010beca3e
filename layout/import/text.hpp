// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Private to the importer: files of text, which are taken apart before, or in place of, assimp's readers.

namespace bch::detail::importing {

/// Hands out the lines of a text, however they end, and counts them.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}

  bool at_end() const { return at_ == text_.size(); }
  std::string_view next();
  /// Returns the number of the last line, from 1, as messages begin.
  std::string place() const { return "line " + std::to_string(number_); }

 private:
  std::string_view text_;
  std::size_t at_ = 0, number_ = 0;
};

/// Takes the next word off a text: what stands between blanks or ends of lines. Empty at the end.
std::string_view next_word(std::string_view& text);
std::vector<std::string_view> words_of(std::string_view line);

/// Returns the number that is all of a word, infinities and NaN included; none for other words and numbers too large.
std::optional<double> number_of(std::string_view word);

/// Returns an OBJ file's text as assimp reads it rightly: each vertex as its coordinates, each face as the numbers of its
/// vertices, without comments and lines that go on. Textures and normals are left out.
/// Errors:  throws ImportError on vertices and faces that are none.
std::string plain_obj(const std::filesystem::path& file, std::string_view text);

/// Compares the frames that a BVH file has with those that it says it has.
/// Returns: a note, if it has more; assimp reads as many as it says.
/// Errors:  throws ImportError if it has fewer, or channels that assimp misreads.
std::string check_bvh(const std::filesystem::path& file, std::string_view text);

}  // namespace bch::detail::importing
