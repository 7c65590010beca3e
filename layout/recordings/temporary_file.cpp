// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/recordings/temporary_file.hpp"

#include <cerrno>
#include <cstring>

#include "layout/recordings/trajectory.hpp"

namespace bch::detail::trajectory {

std::filesystem::path TemporaryFile::folder() {
  std::error_code error;
  std::filesystem::path path = std::filesystem::temp_directory_path(error);
  if (error) throw TrajectoryError("the folder for temporary files is not there: " + error.message());
  return path;
}

void TemporaryFile::fail(const char* what) {
  const std::string reason = std::strerror(errno);
  throw TrajectoryError(folder().string() + ": " + what + " for rows that have to be sorted: " + reason);
}

void TemporaryFile::append(std::span<const Row> rows) {
  for (std::span<const std::byte> left = std::as_bytes(rows); !left.empty();) {
    const std::ptrdiff_t written = write_some(left);
    if (written < 0) fail("no more can be written");
    left = left.subspan(static_cast<std::size_t>(written));
  }
}

void TemporaryFile::read(std::uint64_t first, std::span<Row> rows) const {
  std::uint64_t at = first * sizeof(Row);
  for (std::span<std::byte> left = std::as_writable_bytes(rows); !left.empty();) {
    const std::ptrdiff_t got = read_some(at, left);
    if (got <= 0) fail("nothing can be read");
    at += static_cast<std::uint64_t>(got);
    left = left.subspan(static_cast<std::size_t>(got));
  }
}

}  // namespace bch::detail::trajectory
