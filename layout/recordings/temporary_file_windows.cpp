// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>

#include <algorithm>
#include <random>
#include <string>

#include "layout/recordings/temporary_file.hpp"

namespace bch::detail::trajectory {
namespace {

unsigned at_once(std::size_t bytes) {
  return static_cast<unsigned>(std::min(bytes, std::size_t{1} << 30));
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

std::ptrdiff_t TemporaryFile::write_some(std::span<const std::byte> bytes) {
  return _write(file_, bytes.data(), at_once(bytes.size()));
}

/// All is appended before anything is read.
std::ptrdiff_t TemporaryFile::read_some(std::uint64_t at, std::span<std::byte> bytes) const {
  if (_lseeki64(file_, static_cast<std::int64_t>(at), SEEK_SET) < 0) return -1;
  return _read(file_, bytes.data(), at_once(bytes.size()));
}

}  // namespace bch::detail::trajectory
