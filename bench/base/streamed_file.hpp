// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bench/base/output_file.hpp"
#include "layout/baked/checksum.hpp"

namespace bch::cli {

/// Writes a file in pieces of a megabyte, and computes its checksum meanwhile; without a name, it writes nothing.
class StreamedFile {
 public:
  explicit StreamedFile(const std::string& file, std::string_view begin = {}) : name_(file), waiting_(begin) {
    if (!file.empty()) file_.emplace(file);
  }
  explicit operator bool() const { return file_.has_value(); }
  const std::string& name() const { return name_; }

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
  /// Returns size and checksum of what was committed.
  detail::baked::StreamChecksum checksum() const { return checksum_.value(); }

 private:
  static constexpr std::size_t piece = std::size_t{1} << 20;

  void write() {
    file_->write(waiting_);
    checksum_.add(waiting_);
    waiting_.clear();
  }

  std::string name_;
  std::optional<OutputFile> file_;
  std::string waiting_;
  detail::baked::RunningChecksum checksum_;
};

}  // namespace bch::cli
