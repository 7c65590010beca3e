// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fcntl.h>
#include <io.h>
#include <leaf_blocks.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "layout/baked/open_file.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t max_at_once = std::size_t{1} << 30;  ///< bytes; _read() reads no more than 2 GiB

}  // namespace

OpenFile::OpenFile(const std::filesystem::path& file)
    : file_(file), descriptor_(_wopen(file.c_str(), _O_RDONLY | _O_BINARY | _O_NOINHERIT)) {
  if (descriptor_ < 0) {
    const int error = errno;
    std::error_code none;
    reject(std::strerror(std::filesystem::is_directory(file, none) ? EISDIR : error));
  }
  struct _stat64 status;
  const int error = _fstat64(descriptor_, &status) != 0 ? errno : 0;
  if (error == 0 && (status.st_mode & _S_IFMT) == _S_IFREG) {
    size_ = static_cast<std::size_t>(status.st_size);
    return;
  }
  _close(descriptor_);
  reject(error == 0 ? "not a regular file" : std::strerror(error));
}

OpenFile::~OpenFile() {
  _close(descriptor_);
}

void OpenFile::read(std::span<std::byte> bytes) const {
  if (_lseeki64(descriptor_, 0, SEEK_SET) != 0) reject(std::strerror(errno));
  for (std::size_t done = 0; done < bytes.size();) {
    const int got = _read(descriptor_, bytes.data() + done,
                          static_cast<unsigned>((std::min)(bytes.size() - done, max_at_once)));
    if (got < 0) reject(std::strerror(errno));
    if (got == 0)
      reject("it shrank from " + std::to_string(size_) + " to " + std::to_string(done) + " bytes meanwhile");
    done += static_cast<std::size_t>(got);
  }
}

std::shared_ptr<const void> OpenFile::map() const {
  const auto require = [&](bool good) {
    if (!good) reject(std::system_category().message(static_cast<int>(GetLastError())));
  };
  const HANDLE mapping = CreateFileMappingW(reinterpret_cast<HANDLE>(_get_osfhandle(descriptor_)), nullptr,
                                            PAGE_READONLY, 0, 0, nullptr);
  require(mapping != nullptr);
  const void* const bytes = MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, size_);
  const DWORD error = GetLastError();
  CloseHandle(mapping);  // the view keeps it
  SetLastError(error);
  require(bytes != nullptr);
  return std::shared_ptr<const void>(bytes, [](const void* at) { UnmapViewOfFile(at); });
}

void OpenFile::reject(const std::string& reason) const {
  throw std::runtime_error(file_.string() + ": cannot be read: " + reason);
}

}  // namespace bch::detail
