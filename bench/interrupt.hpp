// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <filesystem>

namespace bch::cli {

/// From now on SIGINT, SIGTERM and SIGHUP end the program at once, whatever it is doing, with exit code 128 +
/// signal, after the file under construction is removed. Signals that were ignored at the start stay ignored. SIGXFSZ is ignored.
void clean_up_on_signals();

/// The file that such a signal removes, while this lives. One at a time.
class RemovedOnSignal {
 public:
  /// Errors:  throws std::length_error on a path beyond PATH_MAX.
  explicit RemovedOnSignal(const std::filesystem::path& path);
  ~RemovedOnSignal();
  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal& operator=(const RemovedOnSignal&) = delete;
};

}  // namespace bch::cli
