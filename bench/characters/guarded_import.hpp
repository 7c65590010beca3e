// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

#include <bch/import.hpp>

namespace bch::cli {

struct ImportLimits {
  std::chrono::milliseconds time{60'000};
  /// Bytes of address space beyond what this process has when the import begins. Builds with sanitizers, which need
  /// far more, set no such limit.
  std::size_t memory = std::size_t{2} << 30;
};

/// Imports a character as import_character() does, from a file that is not trusted: assimp crashes on some
/// malformed ones. A child process reads the file, within limits, and hands over the character; nothing of
/// assimp runs in this process.
/// Errors:  throws InputError on a file that crashes or exhausts the child, and ImportError as
///          import_character() does. One line each that names the file.
/// Threads: call before any other thread was started, because a child gets only the caller's.
ImportedCharacter guarded_import(const std::string& file, const ImportOptions& options);

/// Imports a character from `file` in the same way, where the child calls `read` to read it.
ImportedCharacter guarded_import(const std::string& file, const std::function<ImportedCharacter()>& read,
                                 const ImportLimits& limits = {});

}  // namespace bch::cli
