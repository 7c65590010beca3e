// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <cerrno>
#include <filesystem>
#include <utility>

#include "bench/base/output.hpp"
#include "bench/base/output_file.hpp"

namespace bch::cli {

namespace fs = std::filesystem;

namespace {

/// Says whether the system removes an open file when it is closed, also by the end of the program.
bool set_removed(int file, bool is_removed) {
  FILE_DISPOSITION_INFO info{is_removed};
  return SetFileInformationByHandle(reinterpret_cast<HANDLE>(_get_osfhandle(file)), FileDispositionInfo,
                                    &info, sizeof info) != 0;
}

}  // namespace

Descriptor::~Descriptor() {
  if (number >= 0) _close(number);
}

RemoveOnSignal::~RemoveOnSignal() = default;

OutputFile::OutputFile(const std::string& file) : user_name_(file) {
  if (!is_replaced(file)) {
    file_.number = _wopen(fs::path(file).c_str(), _O_WRONLY | _O_BINARY | _O_NOINHERIT);
    check(file_.number >= 0);
    return;
  }
  const bool is_there = fs::exists(file);
  check(!is_there || _waccess(fs::path(file).c_str(), 2) == 0);
  const fs::path path = is_there ? fs::canonical(file) : fs::absolute(file);
  const fs::path temporary = path.parent_path() / unforeseeable_name();
  const HANDLE made = CreateFileW(temporary.c_str(), GENERIC_WRITE | DELETE, FILE_SHARE_DELETE, nullptr,
                                  CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr);
  if (made == INVALID_HANDLE_VALUE)
    reject_output(file, fs::exists(path.parent_path()) ? EACCES : ENOENT,
                  "folder " + path.parent_path().string() + ": ");
  file_.number = _open_osfhandle(reinterpret_cast<intptr_t>(made), _O_BINARY | _O_NOINHERIT);
  set_removed(file_.number, true);
  name_ = path.string();
  temporary_ = temporary.string();
}

OutputFile::~OutputFile() = default;

void OutputFile::commit() {
  if (!temporary_.empty()) {
    check(_commit(file_.number) == 0);
    set_removed(file_.number, false);
  }
  check(_close(std::exchange(file_.number, -1)) == 0);
  if (temporary_.empty()) return;
  std::error_code error;
  fs::rename(temporary_, name_, error);
  if (!error) return;
  fs::remove(temporary_);
  reject_output(user_name_, error.default_error_condition().value());
}

}  // namespace bch::cli
