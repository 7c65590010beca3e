// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
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

  static std::filesystem::path folder();
  [[noreturn]] static void fail(const char* what);

  // One call of the system: it returns how many bytes it took, or less than 0, and then errno says why.
  std::ptrdiff_t write_some(std::span<const std::byte> bytes);
  std::ptrdiff_t read_some(std::uint64_t at, std::span<std::byte> bytes) const;
};

}  // namespace bch::detail::trajectory
