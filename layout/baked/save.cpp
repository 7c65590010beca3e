// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#include <bch/files.hpp>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <random>
#include <system_error>

#include "layout/baked/image.hpp"

namespace bch {
namespace {

namespace fs = std::filesystem;

/// A file beside another one, which is removed unless it took that one's name.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : path_(target) {
    std::random_device random;
    path_ += '.' + std::to_string(random()) + ".part";
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  const fs::path& path() const noexcept { return path_; }

 private:
  fs::path path_;
};

}  // namespace

void save_baked(const fs::path& file, const ShapeSet& set, const ShapeOrigins& origins,
                std::span<const BakedClip> clips, std::span<const BakedBody> bodies) {
  const detail::BakedImage image(set, origins, clips, bodies);
  const TemporaryFile temporary(file);
  const auto require = [&](bool good) {
    if (!good) throw BakedFileError(file.string() + ": " + std::strerror(errno));
  };
  std::ofstream out(temporary.path(), std::ios::binary);
  require(out.is_open());
  for (const std::span<const std::byte> part : image.parts())
    out.write(reinterpret_cast<const char*>(part.data()), static_cast<std::streamsize>(part.size()));
  out.close();
  require(out.good());
  std::error_code error;
  fs::rename(temporary.path(), file, error);
  if (error) throw BakedFileError(file.string() + ": " + error.message());
}

}  // namespace bch
