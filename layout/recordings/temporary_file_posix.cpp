// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "layout/recordings/temporary_file.hpp"
#include "layout/recordings/trajectory.hpp"

namespace bch::detail::trajectory {
namespace {

std::filesystem::path folder() {
  std::error_code error;
  std::filesystem::path path = std::filesystem::temp_directory_path(error);
  if (error) throw TrajectoryError("the folder for temporary files is not there: " + error.message());
  return path;
}

}  // namespace

TemporaryFile::TemporaryFile() {
  std::string name = (folder() / "bch-rows-XXXXXX").string();
  file_ = mkostemp(name.data(), O_CLOEXEC);
  if (file_ < 0) fail("no file can be made");
  unlink(name.c_str());
}

TemporaryFile::~TemporaryFile() {
  close(file_);
}

void TemporaryFile::fail(const char* what) {
  const std::string reason = std::strerror(errno);
  throw TrajectoryError(folder().string() + ": " + what + " for rows that have to be sorted: " + reason);
}

void TemporaryFile::append(std::span<const Row> rows) {
  const char* bytes = reinterpret_cast<const char*>(rows.data());
  for (std::size_t left = rows.size_bytes(); left > 0;) {
    const ssize_t written = write(file_, bytes, left);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("no more can be written");
    bytes += written;
    left -= static_cast<std::size_t>(written);
  }
}

void TemporaryFile::read(std::uint64_t first, std::span<Row> rows) const {
  char* bytes = reinterpret_cast<char*>(rows.data());
  auto at = static_cast<off_t>(first * sizeof(Row));
  for (std::size_t left = rows.size_bytes(); left > 0;) {
    const ssize_t got = pread(file_, bytes, left, at);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail("nothing can be read");
    bytes += got;
    at += got;
    left -= static_cast<std::size_t>(got);
  }
}

}  // namespace bch::detail::trajectory
