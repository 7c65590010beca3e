// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include "tests/fuzz/target.hpp"

namespace bch::fuzz {

/// A file without a folder.
class MemoryFile {
 public:
  explicit MemoryFile(std::span<const char> bytes) : descriptor_(memfd_create("input", 0)) {
    require(descriptor_ >= 0, "a file in memory can be made");
    require(write(descriptor_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()),
            "a file in memory can be written");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

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
