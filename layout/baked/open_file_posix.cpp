// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "layout/baked/open_file.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t max_at_once = std::size_t{1} << 30;  ///< bytes; Linux reads no more than 2 GiB

}  // namespace

OpenFile::OpenFile(const std::filesystem::path& file)
    // A pipe must not wait for a writer.
    : file_(file), descriptor_(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_ < 0) reject(std::strerror(errno));
  struct stat status;
  int error = fstat(descriptor_, &status) != 0 ? errno : 0;
  if (error == 0 && !S_ISREG(status.st_mode)) error = S_ISDIR(status.st_mode) ? EISDIR : ESPIPE;
  if (error == 0) {
    size_ = static_cast<std::size_t>(status.st_size);
    return;
  }
  close(descriptor_);
  reject(error == ESPIPE ? "not a regular file" : std::strerror(error));
}

OpenFile::~OpenFile() {
  close(descriptor_);
}

void OpenFile::read(std::span<std::byte> bytes) const {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t got = pread(descriptor_, bytes.data() + done, std::min(bytes.size() - done, max_at_once),
                              static_cast<off_t>(done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) reject(std::strerror(errno));
    if (got == 0)
      reject("it shrank from " + std::to_string(size_) + " to " + std::to_string(done) + " bytes meanwhile");
    done += static_cast<std::size_t>(got);
  }
}

std::shared_ptr<const void> OpenFile::map() const {
  void* const bytes = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE | MAP_POPULATE, descriptor_, 0);
  if (bytes == MAP_FAILED) reject(std::strerror(errno));
  return std::shared_ptr<const void>(bytes, [size = size_](void* at) { munmap(at, size); });
}

void OpenFile::reject(const std::string& reason) const {
  throw std::runtime_error(file_.string() + ": cannot be read: " + reason);
}

}  // namespace bch::detail
