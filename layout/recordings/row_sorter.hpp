// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "layout/recordings/row.hpp"
#include "layout/recordings/temporary_file.hpp"

// Private to the readers of recordings: rows sorted in bounded memory.

namespace bch::detail::trajectory {

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
