// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "layout/recordings/temporary_file.hpp"

namespace bch::detail::trajectory {

TemporaryFile::TemporaryFile() {
  std::string name = (folder() / "bch-rows-XXXXXX").string();
  file_ = mkostemp(name.data(), O_CLOEXEC);
  if (file_ < 0) fail("no file can be made");
  unlink(name.c_str());
}

TemporaryFile::~TemporaryFile() {
  close(file_);
}

std::ptrdiff_t TemporaryFile::write_some(std::span<const std::byte> bytes) {
  ssize_t written;
  do written = write(file_, bytes.data(), bytes.size());
  while (written < 0 && errno == EINTR);
  return written;
}

std::ptrdiff_t TemporaryFile::read_some(std::uint64_t at, std::span<std::byte> bytes) const {
  ssize_t got;
  do got = pread(file_, bytes.data(), bytes.size(), static_cast<off_t>(at));
  while (got < 0 && errno == EINTR);
  return got;
}

}  // namespace bch::detail::trajectory
