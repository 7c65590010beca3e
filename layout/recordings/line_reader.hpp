// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <fstream>
#include <string_view>
#include <vector>

#include "layout/recordings/row.hpp"

// Private to the readers of recordings: lines of text.

namespace bch::detail::trajectory {

/// Reads the lines of a file, which may end with LF or CR LF, the last with neither.
/// Errors:  all functions throw TrajectoryError, naming the line, on what is not text: NUL bytes, UTF-16, lines of more than
///          64 KiB.
class LineReader {
 public:
  explicit LineReader(const Places& places);

  /// Reads a line, which is there until the next is read.
  /// Returns: whether there was one.
  bool next(std::string_view& line);
  /// Returns the number of the line that was read last, from 1.
  std::uint64_t number() const { return number_; }
  /// Returns whether a line end stands behind that line; it may lack at the end of the file.
  bool has_end() const { return has_end_; }
  void rewind();

 private:
  const Places& places_;
  std::ifstream file_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< what is read but not yet given
  std::uint64_t number_ = 0;
  bool at_end_ = false, begun_ = false, has_nul_ = false, has_end_ = false;

  void fill();
  void begin_text();
  std::string_view take(std::size_t length, std::size_t and_end);
};

}  // namespace bch::detail::trajectory
