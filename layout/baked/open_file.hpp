// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace bch::detail {

/// An open regular file.
/// Errors:  throws std::runtime_error naming the file and the reason, where it cannot be opened, read or mapped.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& file);
  ~OpenFile();
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  /// When it was opened.
  std::size_t size() const noexcept { return size_; }
  /// Reads the first bytes of the file, as many as there is room for and not more than size().
  void read(std::span<std::byte> bytes) const;
  /// Maps the bytes, of which there are some.
  std::shared_ptr<const void> map() const;

 private:
  [[noreturn]] void reject(const std::string& reason) const;

  const std::filesystem::path& file_;
  const int descriptor_;
  std::size_t size_ = 0;
};

}  // namespace bch::detail
