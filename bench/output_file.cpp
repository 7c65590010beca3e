// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "bench/output.hpp"

namespace bch::cli {
namespace fs = std::filesystem;

bool is_special(const fs::path& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  return fs::exists(status) && !fs::is_regular_file(status);
}

fs::path resolved(const std::string& file) {
  std::error_code failed;
  const fs::path target = fs::canonical(file, failed);
  return failed ? fs::path(file) : target;
}

OutputFile::OutputFile(const std::string& file) : name_(file), target_(resolved(file)) {
  if (is_special(target_)) {
    descriptor_ = open(target_.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    temporary_ = target_.string() + ".bch-" + std::to_string(getpid());
    removed_.emplace(temporary_);
    descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  }
  check(descriptor_ >= 0);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (is_regular()) unlink(temporary_.c_str());
}

void OutputFile::check(bool good) const {
  if (!good) reject_output(name_, errno);
}

void OutputFile::write(std::string_view bytes) {
  write_all(descriptor_, bytes, name_);
}

void OutputFile::skip(std::uint64_t bytes) {
  check(lseek(descriptor_, static_cast<off_t>(bytes), SEEK_CUR) >= 0);
}

void OutputFile::write_at(std::uint64_t offset, std::string_view bytes) {
  const auto begin = static_cast<off_t>(offset);
  const auto size = static_cast<off_t>(bytes.size());
  for (off_t at = begin; !bytes.empty();) {
    const ssize_t written = pwrite(descriptor_, bytes.data(), bytes.size(), at);
    if (written < 0 && errno == EINTR) continue;
    check(written >= 0);
    bytes.remove_prefix(static_cast<std::size_t>(written));
    at += written;
  }
#ifdef SYNC_FILE_RANGE_WRITE
  // Else all of it waits for commit(). Advice: errors are those of fsync().
  sync_file_range(descriptor_, begin, size, SYNC_FILE_RANGE_WRITE);
#endif
}

void OutputFile::clear() {
  check(ftruncate(descriptor_, 0) == 0);
  check(lseek(descriptor_, 0, SEEK_SET) == 0);
}

void OutputFile::commit() {
  // On the disk before it has the name: a crash must not leave a file of zeros there.
  if (is_regular()) check(fsync(descriptor_) == 0);
  const int descriptor = descriptor_;
  descriptor_ = -1;
  check(close(descriptor) == 0);
  if (!is_regular()) return;
  check(rename(temporary_.c_str(), target_.c_str()) == 0);
  temporary_.clear();
  removed_.reset();
}

}  // namespace bch::cli
