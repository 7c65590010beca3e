// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <string>

#include "layout/import.hpp"

namespace bch::cli {

/// import_character() for files that nobody vouches for: assimp crashes on some malformed ones. A child
/// process reads the file first, within limits of memory and time; only what it survives is read here.
/// Errors:  throws InputError on a file that crashes or exhausts the child, else like import_character().
/// Threads: call before any other thread was started, because a child gets only the caller's.
ImportedCharacter guarded_import(const std::string& file, const ImportOptions& options);

}  // namespace bch::cli
