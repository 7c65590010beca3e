// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "layout/baked/shape_origins.hpp"
#include "layout/shape_set/shape_set.hpp"

namespace bch {

/// A baked file that cannot be read or believed. The message is one line that names the file and, where it applies,
/// the section, the place in it and the value.
class BakedFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct BakedShapes {
  ShapeSet set;
  ShapeOrigins origins;
};

enum class FileAccess {
  read,  ///< into memory of our own: right whatever happens to the file meanwhile
  map,   ///< no copy; for files that no process writes to or shortens while the set lives, see file_bytes.hpp
};

/// A set from a baked file (baked_format.hpp), which it then stands on: nothing is parsed or copied. Checksums and
/// content are checked first, so that a file made in bad faith, too, can give wrong answers at worst.
/// Cost:    reading or mapping, a pass for the checksums and one for the content.
/// Errors:  throws BakedFileError, std::bad_alloc.
BakedShapes load_baked(const std::filesystem::path& file, FileAccess access = FileAccess::read);

/// Loads a set from bytes in memory. They begin on a cache line and stay there, unchanged, while `memory`
/// lives. `name` is what errors call them.
BakedShapes load_baked(std::span<const std::byte> bytes, const std::string& name,
                       std::shared_ptr<const void> memory);

}  // namespace bch
