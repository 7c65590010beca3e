// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "bench/interrupt.hpp"

namespace bch::cli {

/// A file that has its name only once it is whole: it grows beside what bears the name now, which stays as it was until
/// commit(). Without that the new one is removed, by the destructor or by a signal. What is not a regular file (a
/// device, a pipe) is written to directly. One at a time.
/// Errors of all: throw InputError naming the file and the reason.
class OutputFile {
 public:
  explicit OutputFile(const std::string& file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Whether write_at(), skip() and clear() can be called.
  bool is_regular() const noexcept { return !temporary_.empty(); }

  /// Behind what was written or skipped before.
  void write(std::string_view bytes);
  void skip(std::uint64_t bytes);
  /// Anywhere; write() does not notice. The system is asked to have the bytes on the disk soon.
  void write_at(std::uint64_t offset, std::string_view bytes);
  /// As it was at first: empty.
  void clear();

  /// Nothing can be called after it.
  void commit();

 private:
  void check(bool good) const;

  std::string name_;                 ///< as the user wrote it
  std::filesystem::path target_;     ///< where a symbolic link leads: the link stays, its target is replaced
  std::filesystem::path temporary_;  ///< empty where the target is not a regular file
  std::optional<RemovedOnSignal> removed_;
  int descriptor_ = -1;
};

/// Where the bytes of a file with this name would go: a symbolic link's target.
std::filesystem::path resolved(const std::string& file);
/// There, and not a regular file.
bool is_special(const std::filesystem::path& path);

}  // namespace bch::cli
