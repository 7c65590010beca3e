// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the bch authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "layout/baked/format.hpp"

namespace bch::detail::baked {

/// Returns the checksum of a file's first bytes.
std::uint64_t checksum(Preamble preamble);
std::uint64_t checksum(std::span<const std::byte> section_with_zeros);

/// Computes a section's checksum, 64 bits of XXH3, piece by piece. The code that reads a piece next finds it
/// in a near cache, and a large section is read from memory once.
class SectionChecksum {
 public:
  /// Takes a section, which has to outlive this.
  explicit SectionChecksum(std::span<const std::byte> section);
  ~SectionChecksum();

  /// Takes pieces until the byte at `place` is in one; nothing beyond the section's end.
  void max_extent(std::size_t place);
  /// Takes what is left. Returns: the checksum of the section and of `zeros` bytes of 0 after it, fewer than `alignment`.
  std::uint64_t finish(std::size_t zeros = 0);

 private:
  struct State;

  void take(std::size_t bytes);

  std::span<const std::byte> section_;
  std::size_t taken_ = 0;  ///< bytes
  std::unique_ptr<State> state_;
};

}  // namespace bch::detail::baked
