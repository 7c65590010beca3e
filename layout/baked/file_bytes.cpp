// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include "layout/baked/file_bytes.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/sysinfo.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "layout/base/aligned_memory.hpp"

namespace bch::detail {
namespace {

constexpr std::size_t max_at_once = std::size_t{1} << 30;  ///< bytes; Linux reads no more than 2 GiB

/// An open regular file.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& file)
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
  ~OpenFile() { close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int descriptor() const noexcept { return descriptor_; }
  /// When it was opened.
  std::size_t size() const noexcept { return size_; }
  /// Reads the first bytes of the file, as many as there is room for and not more than size().
  void read(std::span<std::byte> bytes) const {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t got = pread(descriptor_, bytes.data() + done, std::min(bytes.size() - done, max_at_once),
                                static_cast<off_t>(done));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) reject(std::strerror(errno));
      if (got == 0)
        reject("it shrank from " + std::to_string(size_) + " to " + std::to_string(done) +
               " bytes meanwhile");
      done += static_cast<std::size_t>(got);
    }
  }
  [[noreturn]] void reject(const std::string& reason) const {
    throw std::runtime_error(file_.string() + ": cannot be read: " + reason);
  }

 private:
  const std::filesystem::path& file_;
  const int descriptor_;
  std::size_t size_ = 0;
};

/// Bytes of memory and of its extension on disk: what no process can have more of.
std::uint64_t all_memory() {
  struct sysinfo system;
  if (sysinfo(&system) != 0) return std::numeric_limits<std::uint64_t>::max();
  return (std::uint64_t{system.totalram} + system.totalswap) * system.mem_unit;
}

void accept(const OpenFile& from, const HeaderCheck& look) {
  if (!look.accept) return;
  std::vector<std::byte> first(std::min(look.bytes, from.size()));
  from.read(first);
  look.accept(first, from.size());
}

}  // namespace

FileBytes read_file(const std::filesystem::path& file, const HeaderCheck& look) {
  const OpenFile from(file);
  accept(from, look);
  // A system that promises more memory than it has would end some process later.
  if (from.size() > all_memory()) throw std::bad_alloc();
  const std::shared_ptr<void> memory(allocate_aligned(from.size()),
                                     [size = from.size()](void* bytes) { free_aligned(bytes, size); });
  const std::span bytes(static_cast<std::byte*>(memory.get()), from.size());
  from.read(bytes);
  return {bytes, memory};
}

FileBytes map_file(const std::filesystem::path& file, const HeaderCheck& look) {
  const OpenFile from(file);
  accept(from, look);
  if (from.size() == 0) return {};
  void* const bytes = mmap(nullptr, from.size(), PROT_READ, MAP_PRIVATE | MAP_POPULATE, from.descriptor(), 0);
  if (bytes == MAP_FAILED) from.reject(std::strerror(errno));
  return {{static_cast<const std::byte*>(bytes), from.size()},
          std::shared_ptr<const void>(bytes, [size = from.size()](void* at) { munmap(at, size); })};
}

}  // namespace bch::detail
