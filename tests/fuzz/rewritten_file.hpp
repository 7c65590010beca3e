// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include "tests/fuzz/target.hpp"

namespace bch::fuzz {

/// A file in a folder, for libraries that want one, which gets one content after the other.
class RewrittenFile {
 public:
  RewrittenFile() : path_(folder() / ("bch-fuzz-" + std::to_string(getpid()))) {}
  ~RewrittenFile() { std::filesystem::remove(path_); }
  RewrittenFile(const RewrittenFile&) = delete;
  RewrittenFile& operator=(const RewrittenFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

  void write(std::span<const char> bytes) const {
    std::ofstream stream(path_, std::ios::binary | std::ios::trunc);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    require(stream.flush().good(), "a file can be written");
  }

 private:
  std::filesystem::path path_;

  static std::filesystem::path folder() {
    const std::filesystem::path memory = "/dev/shm";
    return std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
  }
};

}  // namespace bch::fuzz
