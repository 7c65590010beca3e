// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

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

/// Returns whether an output gets a file of its own, which takes the place of the one that has the name now; devices and pipes are
/// written to directly.
/// Errors:  throws InputError where the system does not say, or a folder has the name.
bool is_replaced(const std::string& file);

/// Represents a file that gets its name once it is complete. It grows beside the file that has the name now,
/// under a random name that an attacker cannot predict, and replaces that file in commit(). Without commit(),
/// the destructor or a signal (on Windows the system) removes it. The new file has the permissions of the one it replaces. Where the
/// name is a symbolic link to a file, that file is replaced.
/// Errors of all: throw InputError naming the file and the reason.
class OutputFile {
 public:
  explicit OutputFile(const std::string& file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);
  /// Gives the file its name. No function can be called after it.
  void commit();

 private:
  /// Returns a name of 64 random bits: two processes never choose the same one, and nobody can foresee it. Short, so that it fits wherever
  /// the file's own name does.
  static std::string unforeseeable_name();
  void check(bool good) const;

  std::string user_name_;  ///< as the user wrote it
  std::string name_;       ///< in the folder, behind symbolic links
  std::string temporary_;  ///< in the folder; empty where the output is not replaced
  Descriptor folder_, file_;
  std::optional<RemoveOnSignal> removed_;
};

/// Writes a file in pieces of a megabyte; without a name, it writes nothing.
class StreamedFile {
 public:
  explicit StreamedFile(const std::string& file, std::string_view begin = {}) : waiting_(begin) {
    if (!file.empty()) file_.emplace(file);
  }
  explicit operator bool() const { return file_.has_value(); }

  void add(std::string_view bytes) {
    if (!file_) return;
    waiting_ += bytes;
    if (waiting_.size() >= piece) write();
  }
  /// Gives the file its name. Nothing can be added after it.
  void commit() {
    if (!file_) return;
    write();
    file_->commit();
  }

 private:
  static constexpr std::size_t piece = std::size_t{1} << 20;

  void write() {
    file_->write(waiting_);
    waiting_.clear();
  }

  std::optional<OutputFile> file_;
  std::string waiting_;
};

}  // namespace bch::cli
