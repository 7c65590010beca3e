// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <utility>

#include "bench/base/output.hpp"
#include "bench/base/output_file.hpp"

namespace bch::cli {

namespace fs = std::filesystem;

Descriptor::~Descriptor() {
  if (number >= 0) close(number);
}

OutputFile::OutputFile(const std::string& file) : user_name_(file) {
  if (!is_replaced(file)) {
    file_.number = open(file.c_str(), O_WRONLY | O_CLOEXEC);
    check(file_.number >= 0);
    return;
  }
  struct stat there = {};
  const bool is_there = stat(file.c_str(), &there) == 0;
  check(!is_there || faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) == 0);
  const fs::path path = is_there ? fs::canonical(file) : fs::path(file);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const auto require_folder = [&](bool takes_files) {
    if (!takes_files) reject_output(file, errno, "folder " + folder.string() + ": ");
  };
  folder_.number = open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  require_folder(folder_.number >= 0);
  name_ = path.filename();
  const std::string temporary = unforeseeable_name();
  removed_.emplace(folder_.number, temporary);
  file_.number = openat(folder_.number, temporary.c_str(),
                        O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, is_there ? 0600 : 0666);
  require_folder(file_.number >= 0);
  temporary_ = temporary;
  // If the file system refuses the permissions, only the owner can access the file.
  if (is_there) static_cast<void>(fchmod(file_.number, there.st_mode & 0777));
}

OutputFile::~OutputFile() {
  if (!temporary_.empty()) unlinkat(folder_.number, temporary_.c_str(), 0);
}

void OutputFile::commit() {
  // On the disk before it has the name: a crash must not leave a file of zeros there.
  if (!temporary_.empty()) check(fsync(file_.number) == 0);
  check(close(std::exchange(file_.number, -1)) == 0);
  if (temporary_.empty()) return;
  check(renameat(folder_.number, temporary_.c_str(), folder_.number, name_.c_str()) == 0);
  temporary_.clear();
  removed_.reset();
}

}  // namespace bch::cli
