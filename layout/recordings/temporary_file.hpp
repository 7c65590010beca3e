// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <span>

#include "layout/recordings/row.hpp"

// Private to the readers of recordings: rows that are more than the memory holds.

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

}  // namespace bch::detail::trajectory
