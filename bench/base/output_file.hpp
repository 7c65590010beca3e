// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bench/base/interrupt.hpp"

namespace bch::cli {

/// Owns a file descriptor that is closed with its owner.
struct Descriptor {
  int number = -1;

  Descriptor() = default;
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

/// Represents a file that gets its name once it is complete. It grows beside the file that has the name now,
/// under a random name that an attacker cannot predict, and replaces that file in commit(). Without commit(),
/// the destructor or a signal removes it. The new file has the permissions of the one it replaces. Where the
/// name is a symbolic link, the file that it leads to is replaced. Devices and pipes are written to directly.
/// Errors of all: throw InputError naming the file and the reason.
class OutputFile {
 public:
  explicit OutputFile(const std::string& file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Returns whether write_at(), skip() and clear() can be called.
  bool is_regular() const noexcept { return !temporary_.empty(); }

  /// Appends behind what was written or skipped before.
  void write(std::string_view bytes);
  void skip(std::uint64_t bytes);
  /// Writes at any offset; the position of write() stays. The system is asked to have the bytes on the disk
  /// soon.
  void write_at(std::uint64_t offset, std::string_view bytes);
  /// Makes the file empty again, as it was at first.
  void clear();

  /// Gives the file its name. No function can be called after it.
  void commit();

 private:
  void check(bool good) const;

  std::string user_name_;  ///< as the user wrote it
  std::string name_;       ///< in the folder, behind symbolic links
  std::string temporary_;  ///< in the folder; empty where the output is not a regular file
  Descriptor folder_, file_;
  std::optional<RemovedOnSignal> removed_;
};

}  // namespace bch::cli
