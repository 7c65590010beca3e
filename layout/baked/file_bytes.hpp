// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>

namespace bch::detail {

/// Represents a file's bytes, from a cache line on, as long as `memory` lives.
struct FileBytes {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> memory;
};

/// Examines the first bytes of a file, and its size, before the rest is read or mapped. It throws to refuse the file.
struct HeaderCheck {
  std::size_t bytes;  ///< as many as the file has, if it has fewer
  std::function<void(std::span<const std::byte> first, std::uint64_t size)> accept;
};

/// Both are for regular files.
/// Errors:  throw std::runtime_error naming the file and the reason; read_file() also on one that ends sooner than its
///          size promised; std::bad_alloc, read_file() also where the file is larger than all memory; what `check` throws.

FileBytes read_file(const std::filesystem::path& file, const HeaderCheck& check = {});

/// Maps a file without a copy: pages come from the file cache. While `memory` lives no process may write to
/// the file or make it shorter: bytes that were checked would change, and reading those that are gone ends
/// the process by SIGBUS. No kind of mapping prevents that. To replace the file (write another, rename it
/// over this) is fine: the mapping keeps the old one.
FileBytes map_file(const std::filesystem::path& file, const HeaderCheck& check = {});

}  // namespace bch::detail
