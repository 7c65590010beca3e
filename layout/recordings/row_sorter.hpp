// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "layout/recordings/row.hpp"

// Private to the readers of recordings: rows sorted in bounded memory.

namespace bch::detail::trajectory {

/// Represents a file without a name in the folder for temporary files.
class TemporaryFile {
 public:
  /// Creates a file without a name in the folder for temporary files.
  /// Errors:  all functions throw TrajectoryError, naming the folder.
  TemporaryFile();
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void append(std::span<const Row> rows);
  /// Reads rows from the first'th on.
  void read(std::uint64_t first, std::span<Row> rows) const;

 private:
  int file_ = -1;

  [[noreturn]] static void fail(const char* what);
};

/// Holds rows by key, then id, then number. They are sorted piece by piece, and the pieces merged.
class RowSorter {
 public:
  /// Keeps rows of that many bytes in memory, at least 16 rows.
  explicit RowSorter(std::size_t memory);

  void add(std::span<const Row> rows);
  /// Returns all rows in order; it takes over the memory.
  std::unique_ptr<RowStream> finish() &&;

 private:
  std::size_t capacity_;
  std::vector<Row> rows_;
  std::vector<std::uint64_t> piece_ends_;  ///< in the file
  std::unique_ptr<TemporaryFile> file_;

  void write_piece();
};

}  // namespace bch::detail::trajectory
