// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>

#include "layout/recordings/temporary_file.hpp"
#include "layout/recordings/trajectory.hpp"

namespace bch::detail::trajectory {
namespace {

constexpr std::size_t max_at_once = std::size_t{1} << 30;  ///< bytes

std::filesystem::path folder() {
  std::error_code error;
  std::filesystem::path path = std::filesystem::temp_directory_path(error);
  if (error) throw TrajectoryError("the folder for temporary files is not there: " + error.message());
  return path;
}

}  // namespace

TemporaryFile::TemporaryFile() {
  std::random_device random;
  const std::filesystem::path file = folder() / ("bch-rows-" + std::to_string(random()));
  file_ = _wopen(file.c_str(), _O_RDWR | _O_CREAT | _O_EXCL | _O_BINARY | _O_TEMPORARY | _O_NOINHERIT,
                 _S_IREAD | _S_IWRITE);
  if (file_ < 0) fail("no file can be made");
}

TemporaryFile::~TemporaryFile() {
  _close(file_);
}

void TemporaryFile::fail(const char* what) {
  const std::string reason = std::strerror(errno);
  throw TrajectoryError(folder().string() + ": " + what + " for rows that have to be sorted: " + reason);
}

void TemporaryFile::append(std::span<const Row> rows) {
  const char* bytes = reinterpret_cast<const char*>(rows.data());
  for (std::size_t left = rows.size_bytes(); left > 0;) {
    const int written = _write(file_, bytes, static_cast<unsigned>(std::min(left, max_at_once)));
    if (written < 0) fail("no more can be written");
    bytes += written;
    left -= static_cast<std::size_t>(written);
  }
}

/// All is appended before anything is read.
void TemporaryFile::read(std::uint64_t first, std::span<Row> rows) const {
  char* bytes = reinterpret_cast<char*>(rows.data());
  if (_lseeki64(file_, static_cast<std::int64_t>(first * sizeof(Row)), SEEK_SET) < 0)
    fail("nothing can be read");
  for (std::size_t left = rows.size_bytes(); left > 0;) {
    const int got = _read(file_, bytes, static_cast<unsigned>(std::min(left, max_at_once)));
    if (got <= 0) fail("nothing can be read");
    bytes += got;
    left -= static_cast<std::size_t>(got);
  }
}

}  // namespace bch::detail::trajectory
