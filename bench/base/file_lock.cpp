// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "bench/base/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <utility>

#include "bench/base/exit_codes.hpp"
#include "bench/base/output.hpp"

namespace bch::cli {

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
