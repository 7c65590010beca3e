// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <optional>
#include <string>

#include "bench/base/interrupt.hpp"
#include "bench/base/output_file.hpp"

namespace bch::cli {

/// Keeps other processes from the same work: one of them can hold a lock file of that name at a time. The file is removed with
/// its owner, or by a signal. One that a killed process left is taken over. Where the file system knows no locks, nobody
/// is kept out.
class FileLock {
 public:
  /// Takes a folder that exists, and a name of at most RemovedOnSignal::longest_name bytes.
  /// Errors:  throws InputError where another process holds the lock, or the file cannot be made.
  FileLock(const std::string& folder, const std::string& name);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  std::string name_;
  Descriptor folder_, file_;
  std::optional<RemovedOnSignal> removed_;
};

}  // namespace bch::cli
