// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <random>
#include <utility>

#include "bench/base/exit_codes.hpp"
#include "bench/base/output.hpp"

namespace bch::cli {
namespace {

/// 64 random bits: two processes never choose the same name, and nobody can foresee it. Short, so that it fits wherever the
/// file's own name does.
std::string unforeseeable_name() {
  std::random_device random;
  return fmt::format(".bch-{:08x}{:08x}", random(), random());
}

}  // namespace

Descriptor::~Descriptor() {
  if (number >= 0) close(number);
}

OutputFile::OutputFile(const std::string& file) : user_name_(file) {
  const OutputPlace place = writable_place(file);
  if (place.is_special()) {
    file_.number = open(place.path.c_str(), O_WRONLY | O_CLOEXEC);
    check(file_.number >= 0);
    return;
  }
  folder_.number = open(place.folder().c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  check(folder_.number >= 0);
  name_ = place.path.filename();
  const std::string temporary = unforeseeable_name();
  removed_.emplace(folder_.number, temporary);
  file_.number = openat(folder_.number, temporary.c_str(),
                        O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, place.there ? 0600 : 0666);
  check(file_.number >= 0);
  temporary_ = temporary;
  // If the file system refuses the permissions, only the owner can access the file.
  if (place.there) static_cast<void>(fchmod(file_.number, place.there->st_mode & 0777));
}

OutputFile::~OutputFile() {
  if (is_regular()) unlinkat(folder_.number, temporary_.c_str(), 0);
}

void OutputFile::check(bool good) const {
  if (!good) reject_output(user_name_, errno);
}

void OutputFile::write(std::string_view bytes) {
  write_all(file_.number, bytes, user_name_);
}

void OutputFile::skip(std::uint64_t bytes) {
  check(lseek(file_.number, static_cast<off_t>(bytes), SEEK_CUR) >= 0);
}

void OutputFile::write_at(std::uint64_t offset, std::string_view bytes) {
  const auto begin = static_cast<off_t>(offset);
  const auto size = static_cast<off_t>(bytes.size());
  for (off_t at = begin; !bytes.empty();) {
    const ssize_t written = pwrite(file_.number, bytes.data(), bytes.size(), at);
    if (written < 0 && errno == EINTR) continue;
    check(written >= 0);
    bytes.remove_prefix(static_cast<std::size_t>(written));
    at += written;
  }
#ifdef SYNC_FILE_RANGE_WRITE
  // Else all of it waits for commit(). Advice: errors are those of fsync().
  sync_file_range(file_.number, begin, size, SYNC_FILE_RANGE_WRITE);
#endif
}

void OutputFile::clear() {
  check(ftruncate(file_.number, 0) == 0);
  check(lseek(file_.number, 0, SEEK_SET) == 0);
}

void OutputFile::commit() {
  // On the disk before it has the name: a crash must not leave a file of zeros there.
  if (is_regular()) check(fsync(file_.number) == 0);
  check(close(std::exchange(file_.number, -1)) == 0);
  if (!is_regular()) return;
  check(renameat(folder_.number, temporary_.c_str(), folder_.number, name_.c_str()) == 0);
  temporary_.clear();
  removed_.reset();
}

FileLock::FileLock(const std::string& folder, const std::string& name) : name_(name) {
  const std::string path = std::filesystem::path(folder) / name;
  folder_.number = open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (folder_.number < 0) reject_output(folder, errno);
  // Whoever held it before may have removed the file between these calls: then the lock is of a file without a name.
  struct stat opened, named;
  do {
    if (file_.number >= 0) close(std::exchange(file_.number, -1));
    file_.number =
        openat(folder_.number, name_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    if (file_.number < 0) reject_output(path, errno);
    if (flock(file_.number, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      throw InputError(path + ": another process is doing this part");
  } while (fstat(file_.number, &opened) != 0 ||
           fstatat(folder_.number, name_.c_str(), &named, AT_SYMLINK_NOFOLLOW) != 0 ||
           opened.st_ino != named.st_ino);
  removed_.emplace(folder_.number, name_);
}

FileLock::~FileLock() {
  // While it is locked: the file is nobody else's.
  if (removed_) unlinkat(folder_.number, name_.c_str(), 0);
}

}  // namespace bch::cli
